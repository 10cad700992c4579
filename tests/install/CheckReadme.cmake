# The C++ example of vtkfilters/README.md is, word for word, the program that is built here.
file(READ "${CMAKE_CURRENT_LIST_DIR}/main.cxx" program)
file(READ "${CMAKE_CURRENT_LIST_DIR}/../../vtkfilters/README.md" readme)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" program "${program}")
string(FIND "${readme}" "```cpp\n${program}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "vtkfilters/README.md does not show tests/install/main.cxx")
endif()

# Links between the pages lead somewhere.
get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
foreach(page README.md app/README.md data/README.md pipeline/README.md pipeline/python/README.md
    tests/README.md vtkfilters/README.md)
  file(READ "${source}/${page}" text)
  get_filename_component(folder "${source}/${page}" DIRECTORY)
  string(REGEX MATCHALL "\\([A-Za-z./]+\\.(md|h|png)[)#]" links "${text}")
  foreach(link ${links})
    string(REGEX REPLACE "[()#]" "" file "${link}")
    if(NOT EXISTS "${folder}/${file}")
      message(SEND_ERROR "${page} refers to ${file}, which does not exist")
    endif()
  endforeach()
endforeach()
