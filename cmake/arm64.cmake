# Cross compiling for arm64 (preset arm64, ci/arm64): Debian's crossbuild-essential-arm64, against the libraries of a Debian
# root of that processor, which TRIPTYCH_ARM64_ROOT names. Generators of code are those of this machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

set(TRIPTYCH_ARM64_ROOT "$ENV{TRIPTYCH_ARM64_ROOT}" CACHE PATH "A Debian root of arm64 with the libraries' packages")
if(NOT EXISTS "${TRIPTYCH_ARM64_ROOT}/usr/lib/aarch64-linux-gnu")
  message(FATAL_ERROR "TRIPTYCH_ARM64_ROOT is '${TRIPTYCH_ARM64_ROOT}', which is no Debian root of arm64: ci/arm64 makes one")
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

# What the build itself runs of what it made. Tests run within the root, where the kernel knows what to do: not by
# CMAKE_CROSSCOMPILING_EMULATOR, which would stand before them, too.
find_program(TRIPTYCH_QEMU NAMES qemu-aarch64-static qemu-aarch64 REQUIRED)
set(TRIPTYCH_PATIENCE 20 CACHE STRING "How many times longer than usual a test may take")
set(TRIPTYCH_RUN_BUILT "${TRIPTYCH_QEMU}" -L "${TRIPTYCH_ARM64_ROOT}")
