# The layers (floors) of the source code. A room (library) may link only rooms on lower floors.
set(TRIPTYCH_FLOORS
  core=0 scene=1 record=1 estimation=1 technique=2 reference=2 accuracy=2 judge=3 measure=3
  comparison=4 reduction=4 report=5 backend=4 suite=4 view=6 app=6)

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

# The files of a target are compiled in batches (unity builds), because most of the compilation time is spent on headers and
# templates. Therefore a name in an anonymous namespace must be unique within its target. If this option is off, every file is
# compiled separately. This shows whether each file includes everything that it uses, and it is the fastest way to compile a
# change of one file.
option(TRIPTYCH_UNITY "Compile the files of a target in batches" ON)
set(TRIPTYCH_UNITY_BATCH 24 CACHE STRING "The number of files in a batch")
function(triptych_batch target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${TRIPTYCH_UNITY} UNITY_BUILD_BATCH_SIZE ${TRIPTYCH_UNITY_BATCH})
  # A batch includes all its files. GCC warns if a member's type is in an anonymous namespace in an included file, which is
  # harmless here.
  if(TRIPTYCH_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# Rooms that contain no loops over voxels, particles or pixels, and no code that runs in a timed frame. Optimization beyond -O2
# would not make them faster, but would take longer to compile.
set(TRIPTYCH_COLD record judge comparison reduction report)
function(triptych_cold target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
endfunction()

# triptych_room(NAME SOURCES file... [ROOMS room...] [PUBLIC lib...] [PRIVATE lib...])
# Adds a static library triptych_NAME, which can include headers only from its own room and from the given rooms.
function(triptych_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;ROOMS;PUBLIC;PRIVATE" ${ARGN})
  triptych_floor(${name} own)
  add_library(triptych_${name} STATIC ${arg_SOURCES})
  target_include_directories(triptych_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(triptych_${name} PRIVATE triptych_options fmt::fmt nlohmann_json::nlohmann_json)
  triptych_batch(triptych_${name})
  if(name IN_LIST TRIPTYCH_COLD)
    triptych_cold(triptych_${name})
  endif()
  foreach(room IN LISTS arg_ROOMS)
    triptych_floor(${room} other)
    if(NOT other LESS own)
      message(FATAL_ERROR "room '${name}' (floor ${own}) must not use '${room}' (floor ${other}); it may use only rooms on lower floors")
    endif()
    target_link_libraries(triptych_${name} PUBLIC triptych_${room})
  endforeach()
  target_link_libraries(triptych_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# All time limits of tests are multiplied by this factor. It is larger than 1 under an emulator, for example
# (cmake/arm64.cmake).
set(TRIPTYCH_PATIENCE 1 CACHE STRING "Factor by which the time limits of tests are multiplied")
# triptych_patience(SECONDS OUT) sets OUT to SECONDS multiplied by TRIPTYCH_PATIENCE.
function(triptych_patience seconds out)
  math(EXPR patience "${seconds} * ${TRIPTYCH_PATIENCE}")
  set(${out} ${patience} PARENT_SCOPE)
endfunction()

# Compiles the code of a test without optimization, because most tests spend little time in their own code. With the argument
# OPTIMIZED, the code is compiled with -O1. This is used for tests that draw or compute reference images. Otherwise they would
# take longer, because the linker may keep the unoptimized template instances from a test instead of those from a room.
function(triptych_test_code target)
  triptych_batch(${target})
  set(level -O0)
  if("OPTIMIZED" IN_LIST ARGN)
    set(level -O1)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# triptych_test(NAME SOURCES file... ROOMS room... [LABELS label...] [LIBS lib...] [EACH])
# Adds a GoogleTest program. CTest runs each of its test suites as one test or, with EACH, each of its tests.
function(triptych_test name)
  cmake_parse_arguments(arg "EACH" "" "SOURCES;ROOMS;LABELS;LIBS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE triptych_options GTest::gmock triptych_test_main ${arg_LIBS})
  foreach(room IN LISTS arg_ROOMS)
    target_link_libraries(${name} PRIVATE triptych_${room})
  endforeach()
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  set(optimized "")
  if("device" IN_LIST arg_LABELS OR "reference" IN_LIST arg_ROOMS)
    set(optimized OPTIMIZED)
  endif()
  triptych_test_code(${name} ${optimized})
  triptych_patience(600 timeout)
  set(properties "TIMEOUT ${timeout} SKIP_RETURN_CODE 77")
  # Processes that share PoCL's kernel cache crash, so only one OpenCL test runs at a time. These tests begin first, because they
  # would otherwise run alone at the end.
  if("opencl" IN_LIST arg_LABELS)
    string(APPEND properties " RESOURCE_LOCK pocl_cache COST 300")
  endif()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_tests.cmake CONTENT
"set(TRIPTYCH_NAME ${name})
set(TRIPTYCH_PROGRAM \"$<TARGET_FILE:${name}>\")
set(TRIPTYCH_LABELS \"${arg_LABELS}\")
set(TRIPTYCH_PROPERTIES ${properties})
set(TRIPTYCH_EACH ${arg_EACH})
include(\"${PROJECT_SOURCE_DIR}/cmake/discover_tests.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_tests.cmake)
endfunction()
