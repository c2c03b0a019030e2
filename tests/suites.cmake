# Writes ctest entries for one GoogleTest program: one entry per suite, and one entry per test for
# the suites in APART, whose tests are long and run beside each other. Those in FIRST start before
# all others. Where ONLY names suites, the
# others have no entry.
#   cmake -DPROGRAM=path -DNAME=cli_test -DAPART="Suite Other" -DFIRST="" -DONLY="" -DPROPERTIES="..." -DOUT=file
#         -P suites.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed
                COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
string(REPLACE ";" "\\;" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
separate_arguments(apart UNIX_COMMAND "${APART}")
separate_arguments(first UNIX_COMMAND "${FIRST}")
separate_arguments(only UNIX_COMMAND "${ONLY}")
set(script "")

function(add_entry name filter cost)
  string(APPEND script "add_test([==[${NAME}/${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${NAME}/${name}]==] PROPERTIES COST ${cost} ${PROPERTIES})\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

foreach(line ${lines})
  string(REGEX REPLACE " *#.*" "" line "${line}") # the value of a parameter
  if(line MATCHES "^([^ ]+)\\.$")
    set(suite ${CMAKE_MATCH_1})
    string(REGEX REPLACE "/[0-9]+$" "" plain ${suite})   # the number of a type
    string(REGEX REPLACE "^.*/" "" plain ${plain})       # the name of the instantiation
    set(split OFF)
    if(NOT ONLY STREQUAL "" AND NOT plain IN_LIST only)
      continue()
    elseif(plain IN_LIST apart)
      set(split ON)
    elseif(plain IN_LIST first)
      add_entry(${suite} "${suite}.*" 100)
    else()
      add_entry(${suite} "${suite}.*" 1)
    endif()
  elseif(line MATCHES "^  ([^ ]+)$" AND split)
    add_entry(${suite}.${CMAKE_MATCH_1} "${suite}.${CMAKE_MATCH_1}" 10)
  endif()
endforeach()
file(WRITE ${OUT} "${script}")
