# This runs the command CRT with ARGUMENTS and writes what it prints to the file OUTPUT.
execute_process(COMMAND ${CRT} ${ARGUMENTS} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${OUTPUT} "${text}")
