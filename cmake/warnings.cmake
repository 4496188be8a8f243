# The one target that every target of ours links: warnings and sanitizers.
# (GCC 12 sees overlapping copies in std::string that are not there, bug 105651: no -Wrestrict.
# Members left out of a designated initializer have their documented default, hence no warning for them.)
add_library(triptych_options INTERFACE)
target_compile_options(triptych_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough
  $<$<BOOL:${TRIPTYCH_WARNINGS_AS_ERRORS}>:-Werror>)
# Contraction of a*b+c is left to the code that asks for it: the same bits on every x86-64 machine.
target_compile_options(triptych_options INTERFACE -ffp-contract=off)
# Some libraries ask for it. What is parsed once for all targets has to be parsed alike.
target_compile_options(triptych_options INTERFACE -pthread)
if(TRIPTYCH_SANITIZE)
  target_compile_options(triptych_options INTERFACE -fsanitize=${TRIPTYCH_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(triptych_options INTERFACE -fsanitize=${TRIPTYCH_SANITIZE})
endif()
