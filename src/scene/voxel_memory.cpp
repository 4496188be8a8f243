#include "scene/voxel_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace triptych::scene {
namespace {

// Returns the folder for the files. The default is not /tmp, because many systems keep /tmp in
// memory.
std::string folder_of_files() {
  const char* named = std::getenv("TMPDIR");
  return named != nullptr && *named != '\0' ? named : "/var/tmp";
}

[[noreturn]] void refuse(const std::string& folder, std::size_t bytes, int code) {
  throw core::IoError(
      fmt::format("{}: cannot create a file of {} MiB for voxels ({}); free space there, or set "
                  "TMPDIR to another folder",
                  folder, bytes >> 20U, std::strerror(code)));
}

// Creates a temporary file without a name.
int unnamed_file(const std::string& folder, std::size_t bytes) {
  std::string name = folder + "/triptych-voxels-XXXXXX";
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) refuse(folder, bytes, errno);
  ::unlink(name.c_str());
  return file;
}

// Maps an unnamed file. Its disk space is allocated in advance, because otherwise a full disk would
// later cause a SIGBUS.
void* map_file(std::size_t bytes) {
  const std::string folder = folder_of_files();
  const int file = unnamed_file(folder, bytes);
  int code = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
  void* voxels = MAP_FAILED;
  if (code == 0) {
    voxels = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (voxels == MAP_FAILED) code = errno;
  }
  ::close(file);
  if (code != 0) refuse(folder, bytes, code);
  return voxels;
}

}  // namespace

void* allocate_voxels(std::size_t bytes) {
  if (bytes >= least_bytes_in_a_file) return map_file(bytes);
  void* voxels = std::calloc(std::max<std::size_t>(bytes, 1), 1);
  if (voxels == nullptr) throw std::bad_alloc();
  return voxels;
}

void free_voxels(void* voxels, std::size_t bytes) noexcept {
  if (bytes >= least_bytes_in_a_file) {
    ::munmap(voxels, bytes);
  } else {
    std::free(voxels);
  }
}

}  // namespace triptych::scene
