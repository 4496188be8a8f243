# Runs in each build. Writes `#define TRIPTYCH_DEVICE_CODE "…"` to OUTPUT if the hash of the device code has changed: of all kernels and
# shaders that are compiled into the program, as they are embedded, which is SPIR-V for Vulkan.
# Variables set by the caller: LIST, a file with one path per line; OUTPUT.
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
