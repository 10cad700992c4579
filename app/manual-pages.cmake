# The manual pages, from the program's own help: novelview(1) and novelview-COMMAND(1) for each command
# that it names. usage: cmake -DPROGRAM=.. -DHELP2MAN=.. -DVERSION=.. -DFOLDER=.. -P manual-pages.cmake
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
execute_process(COMMAND "${PROGRAM}" --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "^.*\nSubcommands:\n" "\n" help "${help}")
string(REGEX MATCHALL "\n  [a-z][a-z-]* " words "${help}")
list(TRANSFORM words STRIP)
if(NOT words)
  message(FATAL_ERROR "${PROGRAM} --help names no command")
endif()
foreach(command "" ${words})
  string(JOIN "-" page novelview ${command})
  string(TOUPPER "${page}" title)
  # help2man takes "novelview run" for novelview with a word.
  execute_process(
    COMMAND "${HELP2MAN}" --no-info --section=1 "--version-string=novelview ${VERSION}"
      "--name=novel views of an object from calibrated photographs" "${PROGRAM} ${command}"
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ".TH NOVELVIEW " ".TH ${title} " text "${text}")
  string(REGEX REPLACE "\nnovelview .- " "\n${page} \\\\- " text "${text}")
  file(WRITE "${FOLDER}/${page}.1" "${text}")
endforeach()
