# The floors of the house: a room may link only rooms of lower floors.
set(TRIPTYCH_FLOORS
  core=0 scene=1 record=1 estimation=1 technique=2 reference=2 accuracy=2 judge=3 measure=3
  report=4 comparison=4 reduction=4 backend=4 suite=4 app=5)

function(triptych_floor room out)
  string(REGEX REPLACE "^(backend|suite)_.*" "\\1" kind "${room}")
  foreach(entry IN LISTS TRIPTYCH_FLOORS)
    if(entry MATCHES "^${kind}=([0-9]+)$")
      set(${out} ${CMAKE_MATCH_1} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "room '${room}' has no floor; add it to TRIPTYCH_FLOORS in cmake/room.cmake")
endfunction()

# What nearly every file includes: parsing it was half of the time of a build.
set(TRIPTYCH_COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map> <memory> <optional> <ranges> <set> <span>
  <string> <string_view> <variant> <vector> <fmt/format.h> <nlohmann/json.hpp>)

# Rooms that compute pictures are optimised as far as the compiler can. The others wait for them; a quarter of a
# build's time is saved by -O1 there.
set(TRIPTYCH_COMPUTING_ROOMS core scene technique reference)
function(triptych_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# triptych_parsed_headers(NAME header...): parsed once for all targets that say REUSE_FROM NAME. They must be
# optimised alike, else the compiler refuses what was parsed.
function(triptych_parsed_headers name)
  file(WRITE ${CMAKE_BINARY_DIR}/${name}.cpp "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE triptych_options fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE ${TRIPTYCH_COMMON_HEADERS} ${ARGN})
endfunction()
triptych_parsed_headers(triptych_headers_computing)
triptych_parsed_headers(triptych_headers)
triptych_optimise_less(triptych_headers)

# triptych_room(NAME SOURCES file... [ROOMS room...] [PUBLIC lib...] [PRIVATE lib...] [HEADERS header...])
# A static library triptych_NAME that sees the headers of the rooms it names and no others above it. HEADERS are
# parsed once beside the common ones.
function(triptych_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;ROOMS;PUBLIC;PRIVATE;HEADERS" ${ARGN})
  triptych_floor(${name} own)
  add_library(triptych_${name} STATIC ${arg_SOURCES})
  target_include_directories(triptych_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(triptych_${name} PRIVATE triptych_options fmt::fmt nlohmann_json::nlohmann_json)
  if(name IN_LIST TRIPTYCH_COMPUTING_ROOMS)
    target_precompile_headers(triptych_${name} REUSE_FROM triptych_headers_computing)
  else()
    triptych_optimise_less(triptych_${name})
    if(arg_HEADERS)
      target_precompile_headers(triptych_${name} PRIVATE ${TRIPTYCH_COMMON_HEADERS} ${arg_HEADERS})
    else()
      target_precompile_headers(triptych_${name} REUSE_FROM triptych_headers)
    endif()
  endif()
  foreach(room IN LISTS arg_ROOMS)
    triptych_floor(${room} other)
    if(NOT other LESS own)
      message(FATAL_ERROR "room '${name}' (floor ${own}) may not use '${room}' (floor ${other})")
    endif()
    target_link_libraries(triptych_${name} PUBLIC triptych_${room})
  endforeach()
  target_link_libraries(triptych_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# Tests that are emulated (cmake/arm64.cmake) take longer by this factor.
set(TRIPTYCH_PATIENCE 1 CACHE STRING "How many times longer than usual a test may take")
# triptych_patience(SECONDS OUT)
function(triptych_patience seconds out)
  math(EXPR patience "${seconds} * ${TRIPTYCH_PATIENCE}")
  set(${out} ${patience} PARENT_SCOPE)
endfunction()

# triptych_test(NAME SOURCES file... ROOMS room... [LABELS label...] [LIBS lib...])
# One GoogleTest program; its cases are found by CTest.
function(triptych_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;ROOMS;LABELS;LIBS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE triptych_options GTest::gmock GTest::gtest_main ${arg_LIBS})
  foreach(room IN LISTS arg_ROOMS)
    target_link_libraries(${name} PRIVATE triptych_${room})
  endforeach()
  triptych_optimise_less(${name})
  if(NOT TARGET triptych_headers_test)
    triptych_parsed_headers(triptych_headers_test <gmock/gmock.h> <gtest/gtest.h>)
    target_link_libraries(triptych_headers_test PRIVATE GTest::gmock)
    triptych_optimise_less(triptych_headers_test)
  endif()
  target_precompile_headers(${name} REUSE_FROM triptych_headers_test)
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  triptych_patience(60 discovery)
  triptych_patience(300 timeout)
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT ${discovery}
                       PROPERTIES TIMEOUT ${timeout})
  # gtest_discover_tests cannot hand on a list, so the labels are set on the tests that it found. Processes that share
  # PoCL's kernel cache crash, so one of them at a time.
  set(lock "")
  if("opencl" IN_LIST arg_LABELS)
    set(lock " RESOURCE_LOCK pocl_cache")
  endif()
  set(labels_file ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
  file(WRITE ${labels_file}
    "if(${name}_TESTS)\n"
    "  set_tests_properties(\${${name}_TESTS} PROPERTIES LABELS \"${arg_LABELS}\"${lock})\n"
    "endif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${labels_file})
endfunction()
