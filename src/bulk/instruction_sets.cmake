# One source an instruction set, compiled with that set's flags alone. What these sources instantiate is
# parameterised by lanes that no other source names, so that the one-definition rule holds.
target_include_directories(bitshade_bulk PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
find_package(Threads REQUIRED)
target_link_libraries(bitshade_bulk PRIVATE Threads::Threads)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  target_compile_definitions(bitshade_bulk PRIVATE BITSHADE_X86_64=1)
  file(GLOB bulk_avx2 CONFIGURE_DEPENDS bulk/*_avx2.cpp texture/*_avx2.cpp)
  file(GLOB bulk_avx512 CONFIGURE_DEPENDS bulk/*_avx512.cpp texture/*_avx512.cpp)
  set_source_files_properties(${bulk_avx2} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma;-mf16c")
  # g++ 12 warns of its own header's deliberately undefined vectors (GCC bug 105593).
  set_source_files_properties(${bulk_avx512} PROPERTIES COMPILE_OPTIONS
    "-mavx512f;-mavx512bw;-mavx512dq;-mavx512vl;-mfma;-mf16c;$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-uninitialized>")
else()
  get_target_property(sources bitshade_bulk SOURCES)
  list(FILTER sources EXCLUDE REGEX "_(sse2|avx2|avx512)\\.cpp$")
  set_target_properties(bitshade_bulk PROPERTIES SOURCES "${sources}")
endif()
