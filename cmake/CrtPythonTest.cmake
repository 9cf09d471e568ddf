include_guard()
include(CrtPreload)

# crt_add_python_test(name test [NAME=VALUE...]) adds a test that runs test.py of the folder, with
# the Python package, the libcrt of this build and some variables of the environment. It is skipped
# without a Python that has NumPy.
function(crt_add_python_test name test)
  crt_get_preload(preload)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E env ${ARGN}
    ${CMAKE_COMMAND} -DTEST=${test} -DLIBRARY=$<TARGET_FILE:crt_capi>
    -DPACKAGE=${PROJECT_SOURCE_DIR}/python -DPRELOAD=${preload}
    -P ${PROJECT_SOURCE_DIR}/tests/python/run_test.cmake
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED: ")
endfunction()
