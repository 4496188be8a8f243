#include "scene/voxel_memory.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::scene {
namespace {

// Limits the process memory that RLIMIT_DATA covers.
class DataLimit {
 public:
  explicit DataLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_DATA, &before_);
    const rlimit lower{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_DATA, &lower);
  }
  ~DataLimit() { ::setrlimit(RLIMIT_DATA, &before_); }
  DataLimit(const DataLimit&) = delete;
  DataLimit& operator=(const DataLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(VoxelMemory, IsZeroedAndCopiesLikeAVector) {
  VoxelBytes bytes(1000);
  EXPECT_EQ(std::ranges::count(bytes, std::byte{0}), 1000);
  bytes[7] = std::byte{3};
  VoxelBytes copy = bytes;
  EXPECT_EQ(copy, bytes);
  copy.resize(2000);
  EXPECT_EQ(copy[7], std::byte{3});
  EXPECT_EQ(copy[1999], std::byte{0});
  copy.push_back(std::byte{9});
  EXPECT_EQ(copy.back(), std::byte{9});
}

TEST(VoxelMemory, LargeMemoryIsNotProcessData) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "built with a sanitizer";
#endif
  const DataLimit limit(least_bytes_in_a_file / 2);
  EXPECT_THROW(VoxelBytes(least_bytes_in_a_file - 1), std::bad_alloc);
  VoxelBytes many(least_bytes_in_a_file);
  many.front() = std::byte{1};
  many.back() = std::byte{2};
  EXPECT_EQ(many.back(), std::byte{2});
}

TEST(VoxelMemory, LeavesNoFile) {
  const test::TemporaryFolder folder;
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  const VoxelBytes many(least_bytes_in_a_file);
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VoxelMemory, AFullDiskIsReportedWithItsFolderAndAdvice) {
  const auto message = [](const char* folder, std::size_t bytes) -> std::string {
    ::setenv("TMPDIR", folder, 1);
    std::string said;
    try {
      const VoxelBytes many(bytes);
    } catch (const core::IoError& error) {
      said = error.what();
    }
    ::unsetenv("TMPDIR");
    return said;
  };
  EXPECT_EQ(message("/no/such/folder", least_bytes_in_a_file),
            "/no/such/folder: cannot create a file of 512 MiB for voxels (No such file or "
            "directory); free space there, or set TMPDIR to another folder");
  const test::TemporaryFolder folder;
  // No file system can hold a file of this size.
  const std::string full = message(folder.path().c_str(), std::size_t{1} << 60U);
  EXPECT_NE(full.find("; free space there"), std::string::npos) << full;
}

}  // namespace
}  // namespace triptych::scene
