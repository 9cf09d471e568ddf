# README.md quotes examples/cpp/hello.cpp word for word, and its first script has no errors.
file(READ ${SOURCE_DIR}/README.md readme)

file(READ ${SOURCE_DIR}/examples/cpp/hello.cpp hello)
string(FIND "${readme}" "```cpp\n${hello}```\n" place)
if(place EQUAL -1)
  message(FATAL_ERROR
    "The first C++ code in README.md is not examples/cpp/hello.cpp: copy it there.")
endif()

if(CRT)
  string(FIND "${readme}" "```crt\n" start)
  string(SUBSTRING "${readme}" ${start} -1 script)
  string(SUBSTRING "${script}" 7 -1 script)
  string(FIND "${script}" "```\n" end)
  string(SUBSTRING "${script}" 0 ${end} script)
  file(WRITE ${FOLDER}/first.crt "${script}")
  execute_process(COMMAND ${CRT} check ${FOLDER}/first.crt RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "The first script in README.md has errors.")
  endif()
endif()
