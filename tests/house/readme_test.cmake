# README.md quotes examples/cpp/hello.cpp word for word.
file(READ ${SOURCE_DIR}/README.md readme)
file(READ ${SOURCE_DIR}/examples/cpp/hello.cpp hello)
string(FIND "${readme}" "```cpp\n${hello}```\n" place)
if(place EQUAL -1)
  message(FATAL_ERROR "The first C++ code in README.md is not examples/cpp/hello.cpp: copy it there.")
endif()
