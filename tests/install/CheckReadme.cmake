# The C++ example of README.md is, word for word, the program that is built here.
file(READ "${CMAKE_CURRENT_LIST_DIR}/main.cxx" program)
file(READ "${CMAKE_CURRENT_LIST_DIR}/../../README.md" readme)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" program "${program}")
string(FIND "${readme}" "```cpp\n${program}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md does not show tests/install/main.cxx")
endif()
