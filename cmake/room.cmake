# The floors of the house: a room may link only rooms of lower floors.
set(TRIPTYCH_FLOORS
  core=0 scene=1 record=1 technique=2 reference=2 judge=2 analysis=3 measure=3 report=4 comparison=4 backend=4 suite=4 app=5)

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

# What nearly every file includes, parsed once per target: half of the time of a build.
set(TRIPTYCH_COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map> <memory> <optional> <ranges> <set> <span>
  <string> <string_view> <variant> <vector> <fmt/format.h> <nlohmann/json.hpp>)

# Rooms that compute pictures are optimised as far as the compiler can. The others wait for them; a quarter of a
# build's time is saved by -O1 there.
set(TRIPTYCH_COMPUTING_ROOMS core scene technique reference)
function(triptych_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# triptych_room(NAME SOURCES file... [ROOMS room...] [PUBLIC lib...] [PRIVATE lib...])
# A static library triptych_NAME that sees the headers of the rooms it names and no others above it.
function(triptych_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;ROOMS;PUBLIC;PRIVATE" ${ARGN})
  triptych_floor(${name} own)
  add_library(triptych_${name} STATIC ${arg_SOURCES})
  target_include_directories(triptych_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(triptych_${name} PRIVATE triptych_options fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(triptych_${name} PRIVATE ${TRIPTYCH_COMMON_HEADERS})
  if(NOT name IN_LIST TRIPTYCH_COMPUTING_ROOMS)
    triptych_optimise_less(triptych_${name})
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
  target_precompile_headers(${name} PRIVATE ${TRIPTYCH_COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 300)
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
