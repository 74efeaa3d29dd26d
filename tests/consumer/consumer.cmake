# A user's project, outside the tree: lagen is installed to a fresh prefix and found there (or added as a
# sub-folder), headers are generated, compiled and run; a changed model makes its header again, and nothing else does.
#   cmake -D source=.. -D build=.. -D compiler=.. -P consumer.cmake
cmake_minimum_required(VERSION 3.25)

set(work "${build}/consumer_test")
file(REMOVE_RECURSE "${work}")
file(MAKE_DIRECTORY "${work}")
file(COPY "${source}/tests/consumer/" DESTINATION "${work}/project" PATTERN "consumer.cmake" EXCLUDE)
file(COPY_FILE "${source}/models/heavy_top.toml" "${work}/project/heavy_top.toml")

# Runs a command; its output is in `output`. What fails is shown.
macro(must)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}\n${output}\n${errors}")
  endif()
endmacro()

must(${CMAKE_COMMAND} --install "${build}" --prefix "${work}/prefix")
set(man share/man/man1/lagen.1)
set(completions share/bash-completion/completions/lagen share/zsh/site-functions/_lagen)
foreach(file bin/lagen include/lagen/kernel.hpp share/lagen/models/heavy_top.toml share/lagen/models/new/tangent.toml
             share/lagen/program/lagen_run/driver.hpp lib/python3/dist-packages/lagen/__init__.py share/doc/lagen/README.md share/doc/lagen/docs/mechanics.md
             ${man} ${completions})
  if(NOT EXISTS "${work}/prefix/${file}")
    message(FATAL_ERROR "consumer: the installation lacks ${file}")
  endif()
endforeach()
if(EXISTS "${work}/prefix/include/lagen/driver.hpp" OR EXISTS "${work}/prefix/include/lagen_run")
  message(FATAL_ERROR "consumer: the program of `lagen run` is among the public headers")
endif()
must("${work}/prefix/bin/lagen" --version)

# The manual page and the completions know each command and each option that `--help` shows.
set(program "${work}/prefix/bin/lagen")
must(bash -n "${work}/prefix/share/bash-completion/completions/lagen")
must("${program}" --help)
string(REGEX MATCHALL "\n  [a-z]+" commands "${output}")
list(LENGTH commands count)
if(count LESS 10)
  message(FATAL_ERROR "consumer: ${count} commands in lagen --help")
endif()
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  must("${program}" ${command} --help)
  string(REGEX MATCHALL "--[a-z][a-z-]+" options "${output}")
  foreach(page ${man} ${completions})
    file(READ "${work}/prefix/${page}" text)
    string(REPLACE "\\-" "-" text "${text}") # hyphens of the manual page
    foreach(word ${command} ${options})
      string(FIND "${text}" "${word}" found)
      if(found EQUAL -1)
        message(FATAL_ERROR "consumer: ${page} lacks ${word}, which `lagen ${command} --help` shows")
      endif()
    endforeach()
  endforeach()
endforeach()
find_program(zsh zsh)
if(zsh)
  must(${zsh} -n "${work}/prefix/share/zsh/site-functions/_lagen")
endif()

# A model of one's own, to start from.
execute_process(COMMAND "${program}" new swing WORKING_DIRECTORY "${work}" COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET ERROR_QUIET)
must("${program}" check "${work}/swing.toml")

set(common -G Ninja -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Debug)
must(${CMAKE_COMMAND} -S "${work}/project" -B "${work}/found" ${common} -D CMAKE_PREFIX_PATH=${work}/prefix)
must(${CMAKE_COMMAND} --build "${work}/found")
must("${work}/found/app")
string(STRIP "${output}" first)
if(NOT first MATCHES "^top energy [0-9.]+ status ok$")
  message(FATAL_ERROR "consumer: the app printed \"${first}\"")
endif()

# Another model of the same stem would make the same header.
file(MAKE_DIRECTORY "${work}/project/other")
file(COPY_FILE "${work}/project/heavy_top.toml" "${work}/project/other/heavy_top.toml")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${work}/project" -B "${work}/same" ${common} -D CMAKE_PREFIX_PATH=${work}/prefix -D SAME=ON
  RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " sentence "${errors}") # CMake breaks lines where paths are long
if(result EQUAL 0 OR NOT sentence MATCHES "rename one of the two models")
  message(FATAL_ERROR "consumer: two models of one stem were not refused: ${result}\n${errors}")
endif()

# Nothing to do the second time; a touched model makes the header again.
must(${CMAKE_COMMAND} --build "${work}/found")
if(NOT output MATCHES "no work to do")
  message(FATAL_ERROR "consumer: a second build was not empty:\n${output}")
endif()
file(READ "${work}/project/heavy_top.toml" text)
string(REGEX REPLACE "(\ntitle *= *)\"[^\n]*\"" "\\1\"A changed title\"" changed "${text}")
if(changed STREQUAL text)
  message(FATAL_ERROR "consumer: heavy_top.toml has no title to change")
endif()
file(WRITE "${work}/project/heavy_top.toml" "${changed}")
must(${CMAKE_COMMAND} --build "${work}/found")
if(NOT output MATCHES "lagen generate heavy_top.hpp")
  message(FATAL_ERROR "consumer: a changed model did not make its header again:\n${output}")
endif()
file(READ "${work}/found/lagen_generated/heavy_top.hpp" header)
if(NOT header MATCHES "A changed title")
  message(FATAL_ERROR "consumer: the header does not show the changed title")
endif()

# As a sub-folder, with the generator of this build in place of a second build of it.
must(${CMAKE_COMMAND} -S "${work}/project" -B "${work}/added" ${common} -D LAGEN_SOURCE=${source}
     -D LAGEN_BUILD_GENERATOR=OFF -D LAGEN_EXECUTABLE=${work}/prefix/bin/lagen)
must(${CMAKE_COMMAND} --build "${work}/added")
must("${work}/added/app")
string(STRIP "${output}" second)
if(NOT second STREQUAL first)
  message(FATAL_ERROR "consumer: found and added lagen disagree: \"${first}\" and \"${second}\"")
endif()
