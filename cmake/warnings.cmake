# Every target of the project links triptych_options, which sets warnings and sanitizers.
# -Wrestrict is off, because GCC 12 reports overlapping copies in std::string that do not exist (GCC bug 105651). The warning
# about members that are missing in a designated initializer is off, because such members have documented default values. In a
# batch of files (cmake/room.cmake), a local variable may have the same name as a constant in another file. Therefore -Wshadow
# is limited to local variables that shadow other local variables.
add_library(triptych_options INTERFACE)
target_compile_options(triptych_options INTERFACE
  -Wall -Wextra -Wpedantic
  $<IF:$<AND:$<BOOL:${TRIPTYCH_UNITY}>,$<CXX_COMPILER_ID:GNU>>,-Wshadow=local,-Wshadow> -Wconversion -Wsign-conversion -Wold-style-cast
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough
  $<$<BOOL:${TRIPTYCH_WARNINGS_AS_ERRORS}>:-Werror>)
# The compiler must not contract a*b+c to a fused operation, so that results are bit-identical on every x86-64 machine. Code
# that needs a fused operation calls it explicitly.
target_compile_options(triptych_options INTERFACE -ffp-contract=off)
# Some libraries need threads.
target_compile_options(triptych_options INTERFACE -pthread)
if(TRIPTYCH_SANITIZE)
  target_compile_options(triptych_options INTERFACE -fsanitize=${TRIPTYCH_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(triptych_options INTERFACE -fsanitize=${TRIPTYCH_SANITIZE})
endif()
