// Tests failures of a store: invalid files, access rights, interference by other processes, kills,
// and full disks.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <span>

#include "core/error.hpp"
#include "record/store.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using Mode = Store::Mode;
using Perms = std::filesystem::perms;

constexpr Perms read_only_folder = Perms::owner_read | Perms::owner_exec | Perms::group_read |
                                   Perms::group_exec | Perms::others_read | Perms::others_exec;

template <typename Expected>
std::string refusal(const std::filesystem::path& file, Mode mode) {
  try {
    const Store store(file, mode);
    return "was opened";
  } catch (const Expected& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another type: ") + error.what();
  }
}

// Tests of files that are not stores

TEST_F(StoreTest, NotASqliteFile) {
  std::ofstream(file_) << std::string(5000, 'x');
  for (const Mode mode : {Mode::read, Mode::append}) {
    EXPECT_THAT(refusal<core::InputError>(file_, mode),
                AllOf(StartsWith(file_.string()), HasSubstr("not an SQLite file")));
  }
}

TEST_F(StoreTest, ShortTextFile) {
  std::ofstream(file_) << "hello";
  EXPECT_THAT(refusal<core::InputError>(file_, Mode::append), HasSubstr("not an SQLite file"));
}

TEST_F(StoreTest, AStoreOfAnotherProgram) {
  {
    const SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    SQLite::Statement(other, "CREATE TABLE t (x)").exec();
  }
  for (const Mode mode : {Mode::read, Mode::append}) {
    EXPECT_THAT(refusal<core::InputError>(file_, mode), HasSubstr("not a Triptych store"));
  }
}

// The fuzzer's seed must have the current schema. With any other schema, the fuzzer would get no
// further than the version check. The schema seldom changes. To regenerate the seed, run `triptych
// run`, and VACUUM the store with a page size of 512 bytes.
TEST(StoreSeed, OfTheFuzzerHasThisSchemaAndARecord) {
  const Store store(
      std::filesystem::path(TRIPTYCH_SOURCE_FOLDER) / "tests/fuzz/seeds/stores/one_record",
      Mode::read);
  ASSERT_EQ(store.runs().size(), 1U);
  const std::vector<Record> records = store.records(store.runs()[0].id);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(store.decoded_image(records[0].image).pixel_count(), 1U);
}

TEST_F(StoreTest, OtherSchemaVersion) {
  make_store(file_);
  for (const auto& [version, hint] : {std::pair{"99", "newer"}, {"1", "measure again"}}) {
    {
      SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
      database.exec(std::string("PRAGMA user_version = ") + version);
    }
    for (const Mode mode : {Mode::read, Mode::append}) {
      EXPECT_THAT(
          refusal<core::InputError>(file_, mode),
          AllOf(HasSubstr(std::string("schema version ") + version),
                HasSubstr("requires schema version 7"), HasSubstr(hint), HasSubstr("--store")));
    }
  }
}

// A trigger could hide what a driver did wrong, a view could show other records, and an index or a
// changed table could do either.
TEST_F(StoreTest, UnknownDatabaseObjectsAreRejected) {
  const std::vector<std::pair<std::string, std::string>> attacks{
      {"CREATE TRIGGER hide AFTER INSERT ON device_fault BEGIN DELETE FROM device_fault; END",
       "contains the trigger hide"},
      {"ALTER TABLE record RENAME TO kept; CREATE VIEW record AS SELECT * FROM kept",
       "measure again and store the results in another file"},
      {"CREATE VIEW x AS SELECT * FROM record", "contains the view x"},
      {"CREATE INDEX x ON record (outcome) WHERE outcome = 'measured'", "contains the index x"},
      {"DROP INDEX run_of_plan", "index run_of_plan is missing"},
      {"DROP TABLE device_fault; CREATE TABLE device_fault (seq INTEGER PRIMARY KEY, device, kind "
       "DEFAULT 'x', subject, detail, last_words)",
       "measure again and store the results in another file"}};
  int number = 0;
  for (const auto& [attack, expected] : attacks) {
    const auto file = folder_ / ("s" + std::to_string(number++));
    make_store(file);
    EXPECT_NO_THROW(Store(file, Mode::read));
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(attack);
    for (const Mode mode : {Mode::read, Mode::append}) {
      EXPECT_THAT(refusal<core::InputError>(file, mode),
                  AllOf(StartsWith(file.string()), HasSubstr(expected)));
    }
  }
  const auto file = folder_ / "other";
  make_store(file);
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("CREATE TABLE notes (text)");
  EXPECT_NO_THROW(Store(file, Mode::append));
}

TEST_F(StoreTest, MissingFile) {
  EXPECT_THAT(refusal<core::IoError>(file_, Mode::read), HasSubstr("no such file"));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "reading must not create a file";
  EXPECT_THAT(refusal<core::IoError>(folder_ / "no" / "x.sqlite", Mode::append),
              HasSubstr("check that its folder exists"));
  EXPECT_THAT(refusal<core::IoError>(folder_, Mode::append), HasSubstr("is a folder"));
}

TEST_F(StoreTest, EmptyFileIsFilledByAppending) {
  std::ofstream(file_).flush();
  EXPECT_THAT(refusal<core::InputError>(file_, Mode::read), HasSubstr("empty"));
  EXPECT_NO_THROW(make_store(file_));
}

TEST_F(StoreTest, DamagedFile) {
  make_store(file_);
  {
    std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(4096);
    stream << std::string(8192, '\x7f');
  }
  try {
    const Store store(file_, Mode::read);
    static_cast<void>(store.runs());
    static_cast<void>(store.records("run-1"));
    FAIL() << "a damaged file was read";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("damaged"));
  }
}

// The index uses the pages of another index, so all queries through it return nothing, without
// reporting an error.
TEST_F(StoreTest, DamagedIndex) {
  make_store(file_);
  EXPECT_NO_THROW(Store(file_, Mode::read).require_whole());
  {
    SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA writable_schema = ON");
    database.exec(
        "UPDATE sqlite_schema SET rootpage = (SELECT rootpage FROM sqlite_schema WHERE name = "
        "'clock_of_device') WHERE name = 'run_of_plan'");
  }
  const Store store(file_, Mode::read);
  EXPECT_FALSE(store.latest_run(sample_run().plan).has_value());
  EXPECT_THAT([&] { store.require_whole(); },
              ThrowsMessage<core::InputError>(AllOf(HasSubstr("damaged"), HasSubstr(".recover"))));
}

TEST_F(StoreTest, DamagedColumn) {
  make_store(file_);
  {
    SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
    database.exec("UPDATE run SET system = '{\"a\": '");
  }
  EXPECT_THAT(
      [&] { static_cast<void>(Store(file_, Mode::read).runs()); },
      ThrowsMessage<core::InputError>(AllOf(StartsWith(file_.string()), HasSubstr("is damaged"))));
}

// SQLite limits values to 10⁹ bytes. Computing the seal of a string of that size would still take
// minutes and several times as much memory.
TEST_F(StoreTest, AStringOfManyMegabytesIsRejected) {
  make_store(file_);
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE record SET detail = CAST(zeroblob(70000000) AS TEXT)");
  const Store store(file_, Mode::read);
  EXPECT_THAT([&] { static_cast<void>(store.records(sample_run().id)); },
              ThrowsMessage<core::InputError>(HasSubstr("a string of 70000000 bytes")));
}

TEST_F(StoreTest, AnInvalidImageIsReported) {
  Store store(file_, Mode::append);
  store.add_image("0123", std::as_bytes(std::span("not an image")));
  EXPECT_THAT(
      [&] { static_cast<void>(store.decoded_image("0123")); },
      ThrowsMessage<core::InputError>(AllOf(
          StartsWith(file_.string()), HasSubstr("image '0123': cannot be read as an EXR image"))));
}

// Access rights

TEST_F(StoreTest, ReadOnlyFile) {
  make_store(file_);
  std::filesystem::permissions(file_, Perms::owner_read | Perms::others_read);
  EXPECT_THAT(as_nobody([&] { return refusal<core::IoError>(file_, Mode::append); }),
              HasSubstr("read-only"));
}

TEST_F(StoreTest, ReadModeCannotWrite) {
  make_store(file_);
  Store store(file_, Mode::read);
  EXPECT_THROW(store.add_run(sample_run("x")), core::IoError);
}

TEST_F(StoreTest, ReadOnlyFolder) {
  make_store(file_);
  std::filesystem::permissions(file_, Perms::owner_all | Perms::others_all);
  std::filesystem::permissions(folder_, read_only_folder);
  EXPECT_THAT(as_nobody([&] { return refusal<core::IoError>(folder_ / "new", Mode::append); }),
              HasSubstr("its folder exists and is writable"));
  EXPECT_THAT(as_nobody([&]() -> std::string {
                Store store(file_, Mode::append);
                store.add_run(sample_run("x"));
                return "was written";
              }),
              AllOf(StartsWith(file_.string()), HasSubstr("folder is read-only")));
  EXPECT_EQ(as_nobody([&] {
              const Store store(file_, Mode::read);
              return store.records("run-1").at(0).reason.detail;
            }),
            "a reason");
}

// Leaves a store whose records exist only in its write-ahead log.
void leave_log(const std::filesystem::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    Store store(file, Mode::append);
    store.add_run(sample_run());
    store.add_record(sample_record());
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
}

TEST_F(StoreTest, ReadOnlyFolderWithALogLeftBehind) {
  leave_log(file_);
  ASSERT_GT(std::filesystem::file_size(file_.string() + "-wal"), 0U);
  std::filesystem::remove(file_.string() + "-shm");
  std::filesystem::permissions(folder_, read_only_folder);
  // The newest records are in the log. Failing is better than silently returning only older
  // records.
  EXPECT_THAT(as_nobody([&] { return refusal<core::IoError>(file_, Mode::read); }),
              HasSubstr("log cannot be replayed"));
}

TEST_F(StoreTest, FileRemovedWhileOpen) {
  for (const std::string ending : {"", "-wal"}) {
    Store store(file_, Mode::append);
    store.add_run(sample_run());
    std::filesystem::remove(file_.string() + ending);
    try {
      store.add_record(sample_record());
      FAIL() << "the record was lost without an error";
    } catch (const core::IoError& error) {
      EXPECT_THAT(error.what(),
                  AllOf(StartsWith(file_.string() + ending), HasSubstr("removed or renamed")));
    }
  }
}

TEST_F(StoreTest, AFileNeedsAName) {
  for (const Mode mode : {Mode::read, Mode::append}) {
    EXPECT_THAT(refusal<core::InputError>("", mode), HasSubstr("the name of the store is empty"));
  }
}

// Tests of killed writers and full disks

TEST_F(StoreTest, KilledWriterLosesAtMostTheRecordInFlight) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    Store store(file_, Mode::append);
    store.add_run(sample_run());
    for (int i = 0;; ++i) {
      store.add_record(sample_record(std::to_string(i)));
      // Reports to the parent process that record i is stored.
      if (write(ends[1], &i, sizeof i) != sizeof i) std::_Exit(1);
    }
  }
  close(ends[1]);
  int last = -1;
  while (last < 50 && read(ends[0], &last, sizeof last) == sizeof last) {
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  while (read(ends[0], &last, sizeof last) == sizeof last) {
  }
  close(ends[0]);
  ASSERT_GE(last, 50);

  Store store(file_, Mode::append);
  const auto records = store.records("run-1");
  EXPECT_GE(records.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_LE(records.size(), static_cast<std::size_t>(last) + 2);
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].configuration, std::to_string(i));
    EXPECT_EQ(records[i].wall_ns, sample_record().wall_ns) << "the record is incomplete";
    EXPECT_EQ(records[i].factors, sample_record().factors);
  }
  EXPECT_NO_THROW(store.add_record(sample_record("after")));
}

// Adds records until one is rejected, then reports whether all records before it are intact.
std::string fill(const std::filesystem::path& file) {
  int added = 0;
  try {
    Store store(file, Mode::append);
    store.add_run(sample_run());
    Record record = sample_record();
    record.benchmark_json = std::string(20'000, 'x');
    for (; added < 10'000; ++added) {
      record.configuration = std::to_string(added);
      store.add_record(record);
    }
    return "never full";
  } catch (const core::IoError& error) {
    const Store store(file, Mode::read);
    if (store.records("run-1").size() != static_cast<std::size_t>(added)) return "records lost";
    return error.what();
  }
}

// The writer is killed, and the store is copied without its log. In the copy, an earlier run that
// passed must not be mistaken for the latest run.
TEST_F(StoreTest, ACopyWithoutItsLogStillContainsTheLatestPlan) {
  make_store(file_);
  Store store(file_, Mode::append);
  record::Run later = sample_run();
  later.id = "later";
  store.add_run(later);
  store.begin("later", {.devices = {"gl:x"}}, std::vector<std::string>{"step=1"});
  const auto copy = folder_ / "copy";
  std::filesystem::copy_file(file_, copy);
  const Store copied(copy, Mode::read);
  const auto latest = copied.latest_run(later.plan);
  ASSERT_TRUE(latest);
  EXPECT_EQ(latest->id, "later");
  EXPECT_EQ(copied.planned(*latest), std::vector<std::string>{"step=1"});
}

TEST_F(StoreTest, FileSizeLimit) {
  const std::string answer = in_child([&] {
    limit_files(1'000'000);
    return fill(file_);
  });
  EXPECT_THAT(answer, AllOf(StartsWith(file_.string()), HasSubstr("I/O error")));
}

TEST_F(StoreTest, FullDisk) {
  const std::string answer = in_child([&]() -> std::string {
    if (!mount_small_disk(folder_)) return "cannot mount";
    return fill(file_);
  });
  if (answer == "cannot mount")
    GTEST_SKIP() << "mounting a small disk is not permitted on this machine";
  EXPECT_THAT(answer, AllOf(StartsWith(file_.string()), HasSubstr("disk is full")));
}

}  // namespace
}  // namespace triptych::record
