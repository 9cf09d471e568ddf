# Builds SOURCE with libcrt from the folder LIBRARIES, and runs it as example_test.cmake does all
# examples. CrtPreload.cmake explains PRELOAD.
find_program(RUSTC rustc PATHS /usr/bin NO_DEFAULT_PATH)
find_program(RUSTC rustc)
if(NOT RUSTC)
  message("SKIPPED: there is no rustc (Debian: rustc)")
  return()
endif()

set(built ${FOLDER}.program)
execute_process(COMMAND ${RUSTC} -D warnings -O ${SOURCE} -o ${built} -L ${LIBRARIES}
  RESULT_VARIABLE failure ERROR_VARIABLE said)
if(NOT failure EQUAL 0)
  message(FATAL_ERROR "${SOURCE} could not be built:\n${said}")
endif()
set(PROGRAM ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${LIBRARIES} LD_PRELOAD=${PRELOAD} ${built})
include(${CMAKE_CURRENT_LIST_DIR}/../example_test.cmake)
