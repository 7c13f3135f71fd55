# Settings of our own targets; nothing here reaches a consumer.
if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  set(CMAKE_CXX_EXTENSIONS OFF)
  find_program(BITSHADE_CCACHE ccache)
  if(BITSHADE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${BITSHADE_CCACHE})
  endif()
endif()

option(BITSHADE_WERROR "Treat warnings in our own code as errors" OFF)
add_library(bitshade_warnings INTERFACE)
target_compile_options(bitshade_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${BITSHADE_WERROR}>:-Werror>
  # g++ 12 sees overlaps in "literal" + std::string that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

set(BITSHADE_SANITIZE "" CACHE STRING "Sanitizers for our own targets, e.g. address,undefined")
if(BITSHADE_SANITIZE)
  add_compile_options(-fsanitize=${BITSHADE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${BITSHADE_SANITIZE})
endif()
