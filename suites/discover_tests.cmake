# CTest reads this file when tests are run. It asks the program for the devices of this machine. For every plan and device it
# then registers one test that measures, and one test for each check of the results.
# Variables set by the caller: TRIPTYCH_PROGRAM, TRIPTYCH_PLANS, TRIPTYCH_LARGE_PLANS, TRIPTYCH_TEST_FOLDER.
# The large plans are measured on one device of each driver, or on every device if TRIPTYCH_EVERY_DEVICE is in the environment.
# If the program has not been built or cannot list devices, a test is registered that fails.
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
