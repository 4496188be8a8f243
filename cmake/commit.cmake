# Runs in every build. Writes `#define TRIPTYCH_COMMIT "…"` to OUTPUT if the commit has changed since the previous build. The
# string ends in "+" if files differ from the commit. It is empty if the sources are not a git checkout.
# Variables set by the caller: SOURCE, OUTPUT.
set(commit "")
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-toplevel
                OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
# If the sources were unpacked inside another project's checkout, git would find that project's commit, which says nothing about
# these sources.
if(top STREQUAL SOURCE)
  execute_process(COMMAND git -C "${SOURCE}" describe --always --exclude=* --abbrev=12 --dirty=+
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define TRIPTYCH_COMMIT \"${commit}\"\n")
