# Runs in every build. Writes `#define TRIPTYCH_DEVICE_CODE "…"` to OUTPUT if the hash has changed since the previous build. The
# hash covers all kernels and shaders in the form in which they are embedded in the program, which is SPIR-V for Vulkan.
# Variables set by the caller: LIST (a file with one path per line), OUTPUT.
file(STRINGS "${LIST}" files)
set(hashes "")
foreach(file IN LISTS files)
  cmake_path(GET file FILENAME name)
  file(SHA256 "${file}" hash)
  list(APPEND hashes "${name} ${hash}")
endforeach()
list(SORT hashes)
string(SHA256 hash "${hashes}")
string(SUBSTRING "${hash}" 0 12 hash)
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define TRIPTYCH_DEVICE_CODE \"${hash}\"\n")
