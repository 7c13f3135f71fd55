# Installs bitshade into a scratch prefix, then configures, builds and runs a project that knows
# nothing of the source tree.
set(prefix ${BUILD_DIR}/package/prefix)
set(consumer ${BUILD_DIR}/package/consumer)
file(REMOVE_RECURSE ${prefix} ${consumer})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${out}")
  endif()
endfunction()

set(flags "")
if(FLAGS)
  set(flags -D CMAKE_CXX_FLAGS=-fsanitize=${FLAGS})
endif()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${consumer} -G ${GENERATOR} ${flags}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${consumer})
run(${consumer}/consumer)
