# Runs the unittest module TEST by a Python that has NumPy, with the package in PACKAGE and the
# libcrt LIBRARY. CrtPreload.cmake explains PRELOAD.
set(python)
foreach(candidate /usr/bin/python3 python3)
  execute_process(COMMAND ${candidate} -c "import sys, numpy; sys.exit(sys.version_info < (3, 10))"
    RESULT_VARIABLE failure OUTPUT_QUIET ERROR_QUIET)
  if(NOT python AND failure EQUAL 0)
    set(python ${candidate})
  endif()
endforeach()
if(NOT python)
  message("SKIPPED: there is no Python 3.10 or later with NumPy"
    " (Debian: python3 and python3-numpy)")
  return()
endif()

set(environment CRT_LIBRARY=${LIBRARY} PYTHONPATH=${PACKAGE} PYTHONDONTWRITEBYTECODE=1)
if(PRELOAD)
  # Python itself leaves memory behind at its end.
  list(APPEND environment LD_PRELOAD=${PRELOAD} ASAN_OPTIONS=detect_leaks=0)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env ${environment} ${python} -m unittest -v ${TEST}
  RESULT_VARIABLE failure)
if(NOT failure EQUAL 0)
  message(FATAL_ERROR "${TEST} failed")
endif()
