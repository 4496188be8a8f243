# CTest runs this script each time that tests are run. The script calls the program to list the devices of this machine. For
# every plan and device, it then registers one test that measures, and one test for each check of the results. The large plans
# are measured on one device per driver, or on every device if the environment variable TRIPTYCH_EVERY_DEVICE is set. If the
# program has not been built or cannot list the devices, the script registers a test that fails.
# Variables set by the caller: TRIPTYCH_PROGRAM, TRIPTYCH_PLANS, TRIPTYCH_LARGE_PLANS, TRIPTYCH_TEST_FOLDER.
if(NOT EXISTS "${TRIPTYCH_PROGRAM}")
  add_test(triptych.not_built "${TRIPTYCH_PROGRAM}")
  return()
endif()
set(triptych_tests "${TRIPTYCH_TEST_FOLDER}/tests.cmake")
set(triptych_large ${TRIPTYCH_LARGE_PLANS})
if("$ENV{TRIPTYCH_EVERY_DEVICE}" STREQUAL "")
  list(TRANSFORM triptych_large PREPEND "--one-per-driver=")
endif()
execute_process(
  COMMAND "${TRIPTYCH_PROGRAM}" ctest ${TRIPTYCH_PLANS} ${triptych_large}
          --out "${triptych_tests}" --folder "${TRIPTYCH_TEST_FOLDER}"
  RESULT_VARIABLE triptych_result ERROR_VARIABLE triptych_error)
if(triptych_result EQUAL 0)
  include("${triptych_tests}")
else()
  message("triptych ctest: ${triptych_error}")
  add_test(triptych.no_device_listed "${TRIPTYCH_PROGRAM}" devices)
endif()
