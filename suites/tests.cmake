# Registers the tests of the suites. Each time that CTest runs, it calls the program to get the list of tests.
set(test_folder ${PROJECT_BINARY_DIR}/suite_tests)
file(MAKE_DIRECTORY ${test_folder})
file(GENERATE OUTPUT ${test_folder}/discover.cmake CONTENT
"set(TRIPTYCH_PROGRAM [=[$<TARGET_FILE:triptych>]=])
set(TRIPTYCH_TEST_FOLDER [=[${test_folder}]=])
include([=[${PROJECT_SOURCE_DIR}/suites/discover_tests.cmake]=])
")
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY TEST_INCLUDE_FILES
             ${test_folder}/discover.cmake)
