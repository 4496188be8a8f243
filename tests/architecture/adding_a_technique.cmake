# Adds a technique to a copy of the sources, following docs/adding-a-technique.md. As long as a file is missing, CMake must fail
# and name the file. When all files exist, the generated table of the backend's techniques must compile.
# The caller sets the variables SOURCE, COMPILER, and FOLDER (whose contents are deleted).
set(copy ${FOLDER}/source)
file(REMOVE_RECURSE ${FOLDER})
file(COPY ${SOURCE}/CMakeLists.txt ${SOURCE}/cmake ${SOURCE}/src ${SOURCE}/backends ${SOURCE}/suites
     DESTINATION ${copy})

function(configure code said)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${copy} -B ${FOLDER}/build -G Ninja -DCMAKE_BUILD_TYPE=Debug -DTRIPTYCH_UNITY=OFF
            -DCMAKE_CXX_COMPILER=${COMPILER} -DTRIPTYCH_BUILD_TESTS=OFF
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  set(${code} ${result} PARENT_SCOPE)
  set(${said} "${output}" PARENT_SCOPE)
endfunction()

function(expect_refused what)
  configure(code said)
  if(code EQUAL 0)
    message(FATAL_ERROR "CMake succeeded, but it should have failed with: ${what}")
  endif()
  string(FIND "${said}" "${what}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "expected '${what}' in the output: ${said}")
  endif()
endfunction()

set(catalogue ${copy}/src/technique/catalogue.json)
file(READ ${catalogue} text)
string(REPLACE "\"techniques\": [" "\"techniques\": [
    {\"id\": \"again\", \"suite\": \"volume\", \"work\": \"compute\", \"draws_image\": true, \"needs\": \"nothing\",
     \"apis\": [\"opencl\", \"gl\"], \"summary\": \"The raycaster once more\"}," text "${text}")
file(WRITE ${catalogue} "${text}")
expect_refused("write backends/gl/again.cpp")

foreach(api gl opencl)
  file(READ ${copy}/backends/${api}/raycast.cpp file)
  string(REPLACE "prepare_raycast(" "prepare_again(" file "${file}")
  string(REPLACE "VolumeTechnique raycast(" "VolumeTechnique again(" file "${file}")
  file(WRITE ${copy}/backends/${api}/again.cpp "${file}")
endforeach()
expect_refused("give the reason in backends/vulkan/unsupported.txt")

file(APPEND ${copy}/backends/vulkan/unsupported.txt "again: it exists only for this test\n")
configure(code said)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "CMake failed: ${said}")
endif()
foreach(object again device)
  execute_process(COMMAND ninja -C ${FOLDER}/build backends/opencl/CMakeFiles/triptych_backend_opencl.dir/${object}.cpp.o
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
