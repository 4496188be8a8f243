# CTest runs this script each time that tests are run. The script adds the tests of one GoogleTest program to CTest.
#
# By default, it adds one test for each test suite. The tests of a suite then run in one process, because opening a device,
# building pipelines and computing reference images take longer than most tests. Tests whose names begin with "Real" need real
# data files and are added separately, so that CTest shows whether they were skipped.
#
# Variables set by the caller: TRIPTYCH_NAME, TRIPTYCH_PROGRAM, TRIPTYCH_LABELS, TRIPTYCH_PROPERTIES, and TRIPTYCH_EACH, which
# is true if each test is to be added separately.
macro(triptych_add_test test filter)
  add_test("${TRIPTYCH_NAME}.${test}" "${TRIPTYCH_PROGRAM}" "--gtest_filter=${filter}")
  set_tests_properties("${TRIPTYCH_NAME}.${test}" PROPERTIES LABELS "${TRIPTYCH_LABELS}" ${TRIPTYCH_PROPERTIES})
endmacro()
execute_process(COMMAND "${TRIPTYCH_PROGRAM}" --gtest_list_tests TIMEOUT 600
                OUTPUT_VARIABLE triptych_lines RESULT_VARIABLE triptych_result)
# Removes the comments in which GoogleTest prints the parameters of parameterized tests. A semicolon or a bracket in a comment
# would break the conversion of the lines to a CMake list.
string(REGEX REPLACE " *#[^\n]*" "" triptych_lines "${triptych_lines}")
string(REPLACE "\n" ";" triptych_lines "${triptych_lines}")
set(triptych_suite "")
foreach(triptych_line IN LISTS triptych_lines)
  if(triptych_line MATCHES "^([^ ]+)\\.$")
    set(triptych_suite "${CMAKE_MATCH_1}")
    if(NOT TRIPTYCH_EACH)
      triptych_add_test("${triptych_suite}" "${triptych_suite}.*-${triptych_suite}.Real*")
    endif()
  elseif(triptych_line MATCHES "^  (.+)$" AND (TRIPTYCH_EACH OR triptych_line MATCHES "^  Real"))
    string(STRIP "${triptych_line}" triptych_line)
    triptych_add_test("${triptych_suite}.${triptych_line}" "${triptych_suite}.${triptych_line}")
  endif()
endforeach()
if(triptych_suite STREQUAL "" OR NOT triptych_result EQUAL 0)
  # If the tests could not be listed, adds a test that always fails, and whose output contains the reason.
  add_test("${TRIPTYCH_NAME}.cannot_list_its_tests" sh -c "\"$0\" --gtest_list_tests; exit 1" "${TRIPTYCH_PROGRAM}")
endif()
