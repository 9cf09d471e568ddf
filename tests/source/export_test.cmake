# Renders SCRIPT with the command CRT and the SETTINGS, and again by its program: PROGRAM, or in
# Python the one that is written here, with the package in PACKAGE and the libcrt LIBRARY. Both
# pictures must have the same bytes. CrtPreload.cmake explains PRELOAD.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
set(wanted ${FOLDER}/script.png)
set(made ${FOLDER}/program.png)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failure OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT failure EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed: ${command}\n${output}")
  endif()
endfunction()

run(${CRT} render -q ${SCRIPT} -o ${wanted} --reproducible ${SETTINGS})
if(LANGUAGE STREQUAL "python")
  execute_process(COMMAND /usr/bin/python3 -c
    "import sys, numpy; sys.exit(sys.version_info < (3, 10))"
    RESULT_VARIABLE failure OUTPUT_QUIET ERROR_QUIET)
  if(NOT failure EQUAL 0)
    message("SKIPPED: there is no Python 3.10 or later with NumPy"
      " (Debian: python3 and python3-numpy)")
    return()
  endif()
  run(${CRT} export -q ${SCRIPT} -o ${FOLDER}/program.py ${SETTINGS})
  set(environment CRT_LIBRARY=${LIBRARY} PYTHONPATH=${PACKAGE} PYTHONDONTWRITEBYTECODE=1)
  if(PRELOAD)
    list(APPEND environment LD_PRELOAD=${PRELOAD} ASAN_OPTIONS=detect_leaks=0)
  endif()
  run(${CMAKE_COMMAND} -E env ${environment} /usr/bin/python3 ${FOLDER}/program.py ${made})
elseif(LANGUAGE STREQUAL "script")
  run(${CRT} export -q ${SCRIPT} -o ${FOLDER}/plain.crt ${SETTINGS})
  run(${CRT} render -q ${FOLDER}/plain.crt -o ${made} --reproducible)
else()
  run(${PROGRAM} ${made})
endif()

file(SHA256 ${wanted} wanted_hash)
file(SHA256 ${made} made_hash)
if(NOT wanted_hash STREQUAL made_hash)
  message(FATAL_ERROR "the program renders another picture than its script: ${made}, ${wanted}")
endif()
