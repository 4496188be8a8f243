// If the disk runs out of space during a merge, no incomplete store may remain that looks complete.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "record/merge/merge.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class MergeFailure : public StoreTest {
 protected:
  // Creates a shard, which is a store with a part of a plan's records. The row of its device is so
  // large that it needs pages of its own, which are written last.
  fs::path shard(int number, std::size_t record_bytes = 100) {
    fs::path file = folder_ / fmt::format("shard-{}", number);
    Store store(file, Store::Mode::append);
    const record::Run run = sample_run(fmt::format("run-{}", number));
    store.add_run(run);
    Device device = sample_device();
    device.limits["formats"] = std::string(50'000, 'x');
    store.add_device(run.id, device, {sample_clock()});
    Record record = sample_record(std::to_string(number), device.id, run.id);
    record.benchmark_json = std::string(record_bytes, 'x');
    store.add_record(record);
    return file;
  }

  // Returns the reason why the merge failed, or an empty string if it succeeded.
  static std::string merge(const std::vector<fs::path>& files, const fs::path& out) {
    try {
      static_cast<void>(merge_stores(files, out));
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  static std::set<std::string> files_in(const fs::path& folder) {
    std::set<std::string> files;
    for (const auto& each : fs::directory_iterator(folder)) {
      files.insert(each.path().filename().string());
    }
    return files;
  }
};

// Repeats the merge with every possible amount of free disk space, so that each page in turn is the
// first one that does not fit.
TEST_F(MergeFailure, AFullDiskLeavesNoFile) {
  constexpr std::size_t page = 4096;
  const std::vector<fs::path> files{shard(1), shard(2)};
  const fs::path out = folder_ / "out";
  ASSERT_EQ(merge(files, out), "");
  const std::vector<std::byte> expected = core::read_file(out);
  fs::remove(out);
  const std::set<std::string> before = files_in(folder_);
  for (std::size_t bytes = 100'000; bytes <= expected.size(); bytes += page / 2) {
    SCOPED_TRACE(bytes);
    const std::string answer = in_child([&] {
      limit_files(bytes);
      return merge(files, out);
    });
    if (fs::exists(out)) {
      EXPECT_EQ(answer, "");
      EXPECT_TRUE(core::read_file(out) == expected) << "the merged store is incomplete";
      fs::remove(out);
    } else {
      EXPECT_THAT(answer, AllOf(StartsWith(out.string() + ": cannot be read or written"),
                                HasSubstr("whether the disk is full"), Not(HasSubstr("safe"))));
    }
    EXPECT_EQ(files_in(folder_), before);
  }
}

TEST_F(MergeFailure, FullDiskIsReported) {
  const std::vector<fs::path> files{shard(1, 1'000'000), shard(2, 1'000'000)};
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  const std::string answer = in_child([&]() -> std::string {
    if (!mount_small_disk(disk)) return "cannot mount";
    const std::string why = merge(files, disk / "out");
    return files_in(disk).empty() ? why : "left something behind: " + why;
  });
  if (answer == "cannot mount")
    GTEST_SKIP() << "mounting a small disk is not permitted on this machine";
  EXPECT_EQ(answer, (disk / "out").string() + ": the disk is full; nothing was merged");
}

}  // namespace
}  // namespace triptych::record
