# Builds SOURCE with libcrt from the folder LIBRARIES, and runs it as example_test.cmake does all examples.
find_program(RUSTC rustc PATHS /usr/bin NO_DEFAULT_PATH)
find_program(RUSTC rustc)
if(NOT RUSTC)
  message("SKIPPED: there is no rustc (Debian: rustc)")
  return()
endif()

set(PROGRAM ${FOLDER}.program)
string(REPLACE "|" ";" arguments "${LINK_ARGUMENTS}")
list(TRANSFORM arguments PREPEND -Clink-arg=)
execute_process(COMMAND ${RUSTC} -D warnings -O ${SOURCE} -o ${PROGRAM} -L ${LIBRARIES}
  -Clinker=${LINKER} ${arguments} RESULT_VARIABLE failure ERROR_VARIABLE said)
if(NOT failure EQUAL 0)
  message(FATAL_ERROR "${SOURCE} could not be built:\n${said}")
endif()
include(${CMAKE_CURRENT_LIST_DIR}/../example_test.cmake)
