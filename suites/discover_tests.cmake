# CTest runs this script each time that tests are run. The script calls the program to list the devices of this machine. For
# every plan and device, it then registers one test that measures, and one test for each check of the results. If the program
# has not been built or cannot list the devices, the script registers a test that fails.
#
# Every device measures the quick plans. To save time, the other plans are measured on only one device per driver, and each of
# the plans `stress` and `accuracy` only with OpenGL or only with OpenCL. Vulkan and OpenGL share the source code of their
# shaders, and the tests in tests/contract compare all three with the reference. If the environment variable
# TRIPTYCH_EVERY_DEVICE is set, as in the nightly run, every device measures every plan.
# Variables set by the caller: TRIPTYCH_PROGRAM, TRIPTYCH_TEST_FOLDER.
if(NOT EXISTS "${TRIPTYCH_PROGRAM}")
  add_test(triptych.not_built "${TRIPTYCH_PROGRAM}")
  return()
endif()
set(triptych_all volume/quick particles/quick)
set(triptych_drivers volume/real particles/real volume/cost particles/cost)
set(triptych_gl volume/stress particles/accuracy)
set(triptych_opencl volume/accuracy particles/stress)
if("$ENV{TRIPTYCH_EVERY_DEVICE}" STREQUAL "")
  list(TRANSFORM triptych_drivers PREPEND "--one-per-driver=")
  list(TRANSFORM triptych_gl PREPEND "--one-per-driver=")
  list(TRANSFORM triptych_opencl PREPEND "--one-per-driver=")
  list(APPEND triptych_gl --device "gl:*")
  list(APPEND triptych_opencl --device "opencl:*")
endif()
# triptych_register(NAME ARGUMENT...) writes the tests to NAME.cmake and includes this file.
macro(triptych_register name)
  execute_process(
    COMMAND "${TRIPTYCH_PROGRAM}" ctest ${ARGN}
            --out "${TRIPTYCH_TEST_FOLDER}/${name}.cmake" --folder "${TRIPTYCH_TEST_FOLDER}"
    RESULT_VARIABLE triptych_result ERROR_VARIABLE triptych_error)
  if(triptych_result EQUAL 0)
    include("${TRIPTYCH_TEST_FOLDER}/${name}.cmake")
  else()
    message("triptych ctest: ${triptych_error}")
    add_test(triptych.no_device_listed "${TRIPTYCH_PROGRAM}" devices)
  endif()
endmacro()
triptych_register(tests ${triptych_all} ${triptych_drivers})
triptych_register(gl_tests ${triptych_gl})
triptych_register(opencl_tests ${triptych_opencl})
