# Stops with one clear error message if the compiler is too old, instead of with a thousand compiler errors.
foreach(oldest GNU=12 Clang=16)
  string(REPLACE "=" ";" oldest ${oldest})
  list(GET oldest 0 name)
  list(GET oldest 1 version)
  if(CMAKE_CXX_COMPILER_ID STREQUAL name AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS version)
    message(FATAL_ERROR "${name} ${CMAKE_CXX_COMPILER_VERSION} is too old; GCC 12, Clang 16 or later is required")
  endif()
endforeach()
