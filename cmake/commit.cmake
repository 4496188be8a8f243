# Run in each build: writes OUTPUT, `#define TRIPTYCH_COMMIT "…"`, where the commit is another than it says.
# With "+" where files differ from it; empty where the sources are no checkout.
# Set before: SOURCE, OUTPUT.
set(commit "")
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-toplevel
                OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
# Sources unpacked within somebody's checkout are none of its commits.
if(top STREQUAL SOURCE)
  execute_process(COMMAND git -C "${SOURCE}" describe --always --exclude=* --abbrev=12 --dirty=+
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define TRIPTYCH_COMMIT \"${commit}\"\n")
