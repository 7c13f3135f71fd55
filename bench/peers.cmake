# What the benchmarks are measured against: hand-written loops and other people's
# libraries, each in its own source with its own flags.
find_package(Eigen3 REQUIRED)
find_package(Imath REQUIRED)
find_package(Boost REQUIRED)
find_library(MPFR_LIBRARY mpfr REQUIRED)
find_library(GMP_LIBRARY gmp REQUIRED)

file(GLOB bench_support_sources CONFIGURE_DEPENDS support/*.cpp raw/*.cpp peers/*.cpp)
add_library(bench_support STATIC ${bench_support_sources})
target_include_directories(bench_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_features(bench_support PUBLIC cxx_std_20)
target_link_libraries(bench_support
  PUBLIC benchmark::benchmark
  PRIVATE bitshade_warnings Eigen3::Eigen Imath::Imath Boost::headers ${MPFR_LIBRARY} ${GMP_LIBRARY})

set(bench_avx2 -mavx2 -mfma -mf16c -ffp-contract=off)
set(bench_avx512 ${bench_avx2} -mavx512f -mavx512bw -mavx512dq -mavx512vl
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
file(GLOB bench_avx2_sources CONFIGURE_DEPENDS raw/*_avx2.cpp)
file(GLOB bench_avx512_sources CONFIGURE_DEPENDS raw/*_avx512.cpp)
set_source_files_properties(${bench_avx2_sources} peers/float16.cpp peers/imath.cpp peers/eigen.cpp
  PROPERTIES COMPILE_OPTIONS "${bench_avx2}")
set_source_files_properties(${bench_avx512_sources} PROPERTIES COMPILE_OPTIONS "${bench_avx512}")

# real<...> in a consumer's program: the whole program has one set of flags.
foreach(set avx2 avx512)
  add_executable(bench_arithmetic_${set} arithmetic/arithmetic.cpp)
  target_compile_options(bench_arithmetic_${set} PRIVATE ${bench_${set}})
  target_link_libraries(bench_arithmetic_${set} PRIVATE bitshade_bulk bench_support bitshade_warnings)
endforeach()
