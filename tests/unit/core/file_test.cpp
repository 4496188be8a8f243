#include "core/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <iterator>
#include <span>
#include <string>

#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string text_of(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(File, ComesBackAsWritten) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  const std::string content("zero \0 inside", 13);
  write_file(content, file);
  EXPECT_EQ(text_of(file), content);
  write_file(std::string_view{}, file);
  EXPECT_EQ(text_of(file), "");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(File, SeveralFilesAreReplacedTogetherOrNotAtAll) {
  const TemporaryFolder folder;
  const auto a = folder.write("a", "old a");
  const auto b = folder.write("b", "old b");
  const std::string text = "new";
  const auto bytes = std::as_bytes(std::span(text));
  EXPECT_THAT(
      [&] {
        write_files({{a, bytes}, {b, bytes}, {folder.path() / "no" / "c", bytes}});
      },
      ThrowsMessage<IoError>(HasSubstr("no/c: cannot write: No such file")));
  EXPECT_EQ(text_of(a), "old a");
  EXPECT_EQ(text_of(b), "old b");
  EXPECT_EQ(files_in(folder.path()), 2);
  write_files({{a, bytes}, {b, bytes}});
  EXPECT_EQ(text_of(a), "new");
  EXPECT_EQ(text_of(b), "new");
  EXPECT_EQ(files_in(folder.path()), 2);
}

TEST(File, ReadsFilesThatStateNoSize) {
  EXPECT_THAT(text_of("/proc/self/status"), HasSubstr("Name:"));
}

TEST(File, ReportsWhyItCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { (void)read_file(folder.path() / "none"); },
              ThrowsMessage<IoError>(HasSubstr("none: cannot read: No such file")));
  EXPECT_THAT([&] { (void)read_file(folder.path()); },
              ThrowsMessage<IoError>(HasSubstr("Is a directory")));
}

TEST(File, PipesAndDevicesAreNotWaitedFor) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& file : {pipe, std::filesystem::path("/dev/zero")}) {
    EXPECT_THAT([&] { (void)read_file(file); },
                ThrowsMessage<IoError>(HasSubstr("is a pipe or a device, not a regular file")));
  }
}

TEST(File, TextsHaveALargestSize) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.txt", std::string(10, 'x'));
  EXPECT_EQ(read_text(file, 10), std::string(10, 'x'));
  EXPECT_THAT([&] { (void)read_text(file, 9); },
              ThrowsMessage<InputError>(HasSubstr("a.txt: is too large; the limit is 9 bytes")));
  // The limit also applies to files that report no size.
  EXPECT_THAT([&] { (void)read_text("/proc/self/status", 100); },
              ThrowsMessage<InputError>(HasSubstr("is too large")));
}

TEST(File, ReportsWhyItCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { write_file("x", folder.path() / "no" / "where"); },
              ThrowsMessage<IoError>(HasSubstr("No such file or directory")));
  EXPECT_THAT([&] { write_file("x", folder.path()); },
              ThrowsMessage<IoError>(HasSubstr("Is a directory")));
}

TEST(File, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full does not exist";
  EXPECT_THAT([] { write_file("x", "/dev/full"); },
              ThrowsMessage<IoError>(HasSubstr("No space left on device")));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

// While an object exists, no file may become larger than `bytes`. This simulates a full disk, even
// for root.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(File, FailedWriteLeavesTheOldContentAndNothingElse) {
  const TemporaryFolder folder;
  const auto file = folder.write("kept", "old");
  const std::string large(100000, 'x');
  {
    const FileSizeLimit limit(4096);
    EXPECT_THAT([&] { write_file(large, file); },
                ThrowsMessage<IoError>(HasSubstr("kept: cannot write: File too large")));
  }
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(files_in(folder.path()), 1);
  write_file(large, file);
  EXPECT_EQ(text_of(file), large);
}

TEST(File, WritesThroughALink) {
  const TemporaryFolder folder;
  const auto target = folder.write("target", "old");
  std::filesystem::create_symlink(target, folder.path() / "link");
  write_file("new", folder.path() / "link");
  EXPECT_EQ(text_of(target), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
}

}  // namespace
}  // namespace triptych::core
