# Bison 3.8 declares noexcept the constructor of its parser's stack, which allocates. Where memory
# runs out the program would end. This script removes the word from HEADER, the header that Bison
# has written.
file(READ "${HEADER}" text)
string(REPLACE "stack (size_type n = 200) YY_NOEXCEPT" "stack (size_type n = 200)" text "${text}")
if(NOT text MATCHES "stack \\(size_type n = 200\\)")
  message(FATAL_ERROR "${HEADER}: this version of Bison declares its stack differently")
endif()
file(WRITE "${HEADER}" "${text}")
