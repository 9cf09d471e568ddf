# Runs PROGRAM with ARGUMENTS in an empty FOLDER. It must end with STATUS (0 by default) and
# write what the regular expressions EXPECT ask for, in this order, to its output or its errors. It
# must leave PICTURES there, which CHECK_PICTURE checks. Lists have bars between their items.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
string(REPLACE "|" ";" arguments "${ARGUMENTS}")
execute_process(COMMAND ${PROGRAM} ${arguments} WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL "0${STATUS}")
  message(FATAL_ERROR "${PROGRAM} ended with ${status}:\n${output}")
endif()

if(EXPECT)
  string(REPLACE "|" ".*" expected "${EXPECT}")
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "The output of ${PROGRAM} does not match ${expected}:\n${output}")
  endif()
endif()

string(REPLACE "|" ";" pictures "${PICTURES}")
foreach(picture ${pictures})
  execute_process(COMMAND ${CHECK_PICTURE} ${picture} WORKING_DIRECTORY ${FOLDER}
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${FOLDER}/${picture} is not the picture that ${PROGRAM} should have left")
  endif()
endforeach()
