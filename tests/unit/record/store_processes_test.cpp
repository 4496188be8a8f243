// Tests stores that several processes use at the same time.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "core/error.hpp"
#include "record/store.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

// Time limit of the test's own connection. The connection must wait, because a second process
// (LateWriter) may access the file at any time, even during a commit.
constexpr int time_limit_ms = 10'000;

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using Mode = Store::Mode;

TEST_F(StoreTest, ABusyStoreIsReportedAfterWaiting) {
  make_store(file_);
  SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE, time_limit_ms);
  other.exec("BEGIN IMMEDIATE");
  Store store(file_, Mode::append, milliseconds(200));
  const auto start = std::chrono::steady_clock::now();
  try {
    store.add_run(sample_run("x"));
    FAIL() << "the run was written to a locked store";
  } catch (const core::IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another process"));
  }
  EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(150));
  EXPECT_THAT(store.runs(), SizeIs(1)) << "reading must not need a lock";
  other.exec("COMMIT");
  EXPECT_NO_THROW(store.add_run(sample_run("x")));
}

TEST_F(StoreTest, BusyForAShortTimeIsNotAnError) {
  make_store(file_);
  SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE);
  other.exec("BEGIN IMMEDIATE");
  std::thread release([&] {
    std::this_thread::sleep_for(milliseconds(200));
    other.exec("COMMIT");
  });
  Store store(file_, Mode::append);
  EXPECT_NO_THROW(store.add_run(sample_run("x")));
  release.join();
}

// CTest starts the devices of a plan in parallel, and all of them must add to the same run.
TEST_F(StoreTest, OnlyOneOfManyProcessesBeginsTheRun) {
  { const Store empty(file_, Mode::append); }
  std::array<std::string, 8> ids;
  std::vector<std::thread> processes;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    processes.emplace_back([&, i] {
      Store store(file_, Mode::append);
      ids.at(i) = store.latest_run_or_add(sample_run(fmt::format("run-{}", i))).id;
    });
  }
  for (std::thread& each : processes) each.join();
  const Store store(file_, Mode::read);
  ASSERT_THAT(store.runs(), SizeIs(1));
  EXPECT_THAT(ids, testing::Each(store.runs().front().id));
}

TEST_F(StoreTest, ReaderWhileAWriterIsActive) {
  Store writer(file_, Mode::append);
  writer.add_run(sample_run());
  const Store reader(file_, Mode::read);
  EXPECT_THAT(reader.records("run-1"), SizeIs(0));
  writer.add_record(sample_record());
  EXPECT_THAT(reader.records("run-1"), SizeIs(1));
}

bool append_ten(const std::filesystem::path& file, const std::string& run) {
  try {
    Store store(file, Mode::append);
    store.add_run(sample_run(run));
    for (int n = 0; n < 10; ++n) store.add_record(sample_record(std::to_string(n), "d", run));
    return true;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return false;
  }
}

TEST_F(StoreTest, SeveralProcessesCreateOneStore) {
  constexpr int processes = 6;
  std::vector<pid_t> children;
  for (int i = 0; i < processes; ++i) {
    const pid_t child = fork();
    if (child == 0) std::_Exit(append_ten(file_, std::to_string(i)) ? 0 : 1);
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const Store store(file_, Mode::read);
  EXPECT_THAT(store.runs(), SizeIs(processes));
  for (const record::Run& each : store.runs()) EXPECT_THAT(store.records(each.id), SizeIs(10));
}

// A child process that appends to the store as soon as it is signalled. It is forked before the
// parent opens its connection, because a connection must not be used across a fork.
class LateWriter {
 public:
  explicit LateWriter(const std::filesystem::path& file) {
    if (pipe(ends_.data()) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ != 0) return;
    char begin = 0;
    std::_Exit(read(ends_[0], &begin, 1) == 1 && append_ten(file, "late") ? 0 : 1);
  }
  ~LateWriter() {
    for (const int end : ends_) close(end);
  }
  LateWriter(const LateWriter&) = delete;
  LateWriter& operator=(const LateWriter&) = delete;

  // Starts the writer, and waits long enough for it to get as far as it can.
  void begin() const {
    ASSERT_EQ(write(ends_[1], "x", 1), 1);
    std::this_thread::sleep_for(milliseconds(300));
  }
  void expect_done() const {
    int status = -1;
    waitpid(child_, &status, 0);
    EXPECT_EQ(status, 0);
  }

 private:
  std::array<int, 2> ends_{};
  pid_t child_ = 0;
};

// Another process has created the file and is about to enable write-ahead logging. If a second
// process also tries to enable it, SQLite rejects the attempt at once instead of waiting.
TEST_F(StoreTest, SwitchedToTheLogByAnotherProcess) {
  make_store(file_);
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA journal_mode = DELETE");
  const LateWriter late(file_);
  SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE);
  other.exec("BEGIN IMMEDIATE");
  late.begin();
  other.exec("COMMIT");
  late.expect_done();
  EXPECT_THAT(Store(file_, Mode::read).records("late"), SizeIs(10));
}

TEST_F(StoreTest, CreatedByAnotherProcessBeforeTheLock) {
  const std::filesystem::path model = folder_ / "model.sqlite";
  make_store(model);
  const LateWriter late(file_);
  // This takes a RESERVED lock: others can still read the blank file, but must wait before they
  // write.
  SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                         time_limit_ms);
  other.exec("BEGIN IMMEDIATE");
  late.begin();
  SQLite::Database from(model.string());
  SQLite::Statement tables(from, "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (tables.executeStep()) other.exec(tables.getColumn(0).getString());
  for (const char* const pragma : {"application_id", "user_version"}) {
    const std::string name = std::string("PRAGMA ") + pragma;
    other.exec(name + " = " + from.execAndGet(name).getString());
  }
  other.exec("COMMIT");
  late.expect_done();
  EXPECT_THAT(Store(file_, Mode::read).records("late"), SizeIs(10));
}

}  // namespace
}  // namespace triptych::record
