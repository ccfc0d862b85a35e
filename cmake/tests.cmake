# SPDX-License-Identifier: GPL-3.0-or-later
# The functions that tests are registered with.

include(GoogleTest)

# clerestory_test(NAME SOURCES file... LIBRARIES library...)
#
# A GoogleTest program in build/<preset>/tests; each TEST becomes a test of ctest. GoogleTest's headers, the larger part of what
# compiling a test costs, are compiled once a program, and the tests themselves, which do little, are optimised lightly.
function(clerestory_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE
    clerestory::flags
    clerestory_test_support
    ${arg_LIBRARIES}
    GTest::gmock
    GTest::gtest_main)
  target_precompile_headers(${name} PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name}
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 120
    PROPERTIES TIMEOUT 900)
endfunction()

# script_test(NAME SCRIPT argument...)
#
# A Python script that succeeds with exit status 0; 77 means skipped.
function(script_test name script)
  add_test(NAME ${name} COMMAND ${CLERESTORY_PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
endfunction()

# cli_test(NAME name
#          ARGS argument...     # of the command clerestory, which runs in a scratch folder of its own
#          EXIT status
#          [INPUTS file...]     # copied into the scratch folder first; relative to tests/cli/inputs, or with @...@
#          [MATCHES regex...]   # each is found in what it prints on stdout
#          [ERR regex...]       # each is found in what it prints on stderr
#          [ERR_LINES n]        # stderr has so many lines
#          [FILES glob...]      # each matches a file that is there afterwards
#          [ABSENT glob...]     # none matches a file that is there afterwards
#          [LEAVES_NOTHING])    # nothing in the scratch folder was added, changed or removed
#
# One promise of the command line. In INPUTS, ARGS and FILES, @SAMPLES@, @SOURCE@ and @VALIDATION@ stand for
# the samples, the project's root and the reference data; where the latter is missing, the test is skipped.
# Regular expressions are Python's, with ^ and $ at lines. A semicolon cannot be written in any value.
function(cli_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "LEAVES_NOTHING" "NAME;EXIT;ERR_LINES" "ARGS;INPUTS;MATCHES;ERR;FILES;ABSENT")
  if(arg_UNPARSED_ARGUMENTS OR NOT DEFINED arg_NAME OR NOT DEFINED arg_EXIT)
    message(FATAL_ERROR "cli_test(${arg_NAME}): NAME and EXIT are needed, not understood: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(checks --exit=${arg_EXIT})
  if(DEFINED arg_ERR_LINES)
    list(APPEND checks --stderr-lines=${arg_ERR_LINES})
  endif()
  if(arg_LEAVES_NOTHING)
    list(APPEND checks --leaves-nothing)
  endif()
  foreach(pair IN ITEMS INPUTS=input MATCHES=stdout ERR=stderr FILES=file ABSENT=absent)
    string(REPLACE "=" ";" pair ${pair})
    list(GET pair 0 keyword)
    list(GET pair 1 check)
    foreach(value IN LISTS arg_${keyword})
      list(APPEND checks "--${check}=${value}")
    endforeach()
  endforeach()
  add_test(NAME cli.${arg_NAME} COMMAND ${CLERESTORY_PYTHON} -B ${PROJECT_SOURCE_DIR}/tests/cli/run_cli_test.py
    --program=$<TARGET_FILE:clerestory>
    --source=${PROJECT_SOURCE_DIR}
    --scratch=${PROJECT_BINARY_DIR}/tests/cli/${arg_NAME}
    ${checks}
    -- ${arg_ARGS})
  set_tests_properties(cli.${arg_NAME} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
endfunction()
