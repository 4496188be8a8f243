# Toolchain file for cross-compiling to arm64 (preset arm64, ci/arm64). It uses Debian's crossbuild-essential-arm64 and the
# libraries in the arm64 Debian system in TRIPTYCH_ARM64_ROOT. Code generators run on the build machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

set(TRIPTYCH_ARM64_ROOT "$ENV{TRIPTYCH_ARM64_ROOT}" CACHE PATH "Root folder of an arm64 Debian system that contains the required libraries")
if(NOT EXISTS "${TRIPTYCH_ARM64_ROOT}/usr/lib/aarch64-linux-gnu")
  message(FATAL_ERROR "TRIPTYCH_ARM64_ROOT is '${TRIPTYCH_ARM64_ROOT}', which is not an arm64 Debian system; ci/arm64 creates one")
endif()
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TRIPTYCH_ARM64_ROOT)
set(CMAKE_SYSROOT "${TRIPTYCH_ARM64_ROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${TRIPTYCH_ARM64_ROOT}")
set(ENV{PKG_CONFIG_LIBDIR}
    "${TRIPTYCH_ARM64_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${TRIPTYCH_ARM64_ROOT}/usr/share/pkgconfig")

# The command with which the build runs programs that it has built. CMAKE_CROSSCOMPILING_EMULATOR is not set, because CTest
# would use it as well. The tests do not need it, because they run inside the arm64 system, where the kernel itself starts QEMU.
find_program(TRIPTYCH_QEMU NAMES qemu-aarch64-static qemu-aarch64 REQUIRED)
set(TRIPTYCH_PATIENCE 20 CACHE STRING "Factor by which the time limits of tests are multiplied")
set(TRIPTYCH_RUN_BUILT "${TRIPTYCH_QEMU}" -L "${TRIPTYCH_ARM64_ROOT}")
