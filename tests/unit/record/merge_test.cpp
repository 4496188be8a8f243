// Tests merging of stores: the order of the stores does not affect the result, the result contains
// everything that was measured, and incompatible stores are rejected.

#include "record/merge/merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/random.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;
using Mode = Store::Mode;
using Files = std::vector<fs::path>;

std::string configuration(int number) {
  return fmt::format("camera=random:{},data=b,technique=raycast", number);
}

Record record_of(int number, double wall_ns = 1) {
  Record record = sample_record(configuration(number));
  record.wall_ns = {wall_ns};
  return record;
}

Record failed(int number, Outcome outcome = Outcome::crashed) {
  Record record = record_of(number);
  record.outcome = outcome;
  return record;
}

class Merge : public StoreTest {
 protected:
  // Creates a shard (a store with a part of a plan's records) whose run began at the given second.
  fs::path shard(int second, const std::vector<Record>& records,
                 const Device& device = sample_device()) {
    fs::path file = folder_ / fmt::format("shard-{}.sqlite", second);
    Store store(file, Mode::append);
    record::Run run = sample_run(fmt::format("run-{:03}", second));
    run.started_at = fmt::format("2024-05-01T12:00:{:02}Z", second);
    run.system["host"] = fmt::format("node{}", second % 3);
    run.plan_hash = "text";
    run.configurations = records.size();
    store.add_run(run);
    ClockTrust clock = sample_clock();
    clock.ratio = 1 + 0.001 * second;
    store.add_device(run.id, device, {clock});
    for (Record each : records) {
      each.run = run.id;
      store.add_record(each);
    }
    return file;
  }

  [[nodiscard]] MergeResult merge(const Files& files, const std::string& out = "out") const {
    return merge_stores(files, folder_ / out);
  }

  // Merges the files into a new store named `out`, and returns the hash of its content.
  [[nodiscard]] std::string hash_of_merged(const Files& files, const std::string& out) const {
    for (const char* part : {"", "-wal", "-shm"}) fs::remove(folder_ / (out + part));
    static_cast<void>(merge(files, out));
    return core::content_hash(core::read_file(folder_ / out));
  }

  [[nodiscard]] std::vector<Record> merged_records() const {
    const Store store(folder_ / "out", Mode::read);
    return store.records(store.latest_run("fake/quick").value().id);
  }

  void expect_refused(const Files& files, const testing::Matcher<std::string>& message) const {
    EXPECT_THAT([&] { static_cast<void>(merge(files)); }, ThrowsMessage<core::InputError>(message));
    for (const auto& each : fs::directory_iterator(folder_)) {
      EXPECT_THAT(each.path().filename().string(), testing::Not(HasSubstr("out")))
          << "a temporary file was left";
    }
  }
};

// Returns all fields except the run. Two records that differ only in the run produce equal strings.
std::string text_of(Record record) {
  record.run = "";
  return core::Json(record).dump();
}

TEST_F(Merge, ContainsEverythingFromItsInputs) {
  const Files files{shard(1, {record_of(3), record_of(1)}), shard(2, {record_of(2)})};
  {
    Store store(files[1], Mode::append);
    store.add_image("0123", bytes_of("an image"));
    store.set_truth({"scene", "1", bytes_of("an image"), bytes_of("a bound")});
    EXPECT_EQ(store.begin_record("run-002", configuration(7), "null:scripted"), 1);
  }
  const MergeResult result = merge(files);
  ASSERT_THAT(result.plans, SizeIs(1));
  EXPECT_THAT(result.plans[0].counts.records, ElementsAre(Pair("null:scripted", 3)));

  Store store(folder_ / "out", Mode::append);
  EXPECT_NO_THROW(store.require_whole());
  const std::vector<record::Run> runs = store.runs();
  ASSERT_THAT(runs, SizeIs(1));
  EXPECT_EQ(runs[0].id, "run-001");
  EXPECT_EQ(runs[0].started_at, "2024-05-01T12:00:01Z");
  EXPECT_EQ(runs[0].system.at("host"), "node1 | node2");
  EXPECT_EQ(runs[0].configurations, 3U);
  EXPECT_EQ(runs[0].plan_hash, "text");
  const std::vector<Record> records = store.records("run-001");
  ASSERT_THAT(records, SizeIs(3));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(text_of(records[static_cast<std::size_t>(i)]), text_of(record_of(i + 1)));
  }
  const auto devices = store.devices("run-001");
  ASSERT_THAT(devices, SizeIs(1));
  EXPECT_EQ(devices[0].device, sample_device());
  EXPECT_EQ(store.image("0123"), bytes_of("an image"));
  EXPECT_EQ(store.truth("scene", "1")->bound, bytes_of("a bound"));
  EXPECT_EQ(store.begin_record("run-001", configuration(7), "null:scripted"), 2)
      << "configurations in flight must remain in flight";
}

// The shards overlap and belong to two devices. Some records were measured twice, and some failed
// once.
TEST_F(Merge, AnyOrderAndGroupingMakesTheSameBytes) {
  Device second = sample_device("null:scripted#2");
  Files files;
  core::Random random(31);
  for (int i = 0; i < 7; ++i) {
    std::vector<Record> records;
    for (int number = 0; number < 40; ++number) {
      if (random.uniform() < 0.5) continue;
      records.push_back(random.uniform() < 0.1 ? failed(number) : record_of(number, i % 3));
      records.back().device = i == 3 ? second.id : "null:scripted";
      if (random.uniform() < 0.3) records.back().injected = "";
    }
    files.push_back(shard(i, records, i == 3 ? second : sample_device()));
    Store store(files.back(), Mode::append);
    store.add_image(fmt::format("{}", i % 4), bytes_of(fmt::format("encoded by {}", i)));
    store.set_truth({"scene", "1", bytes_of(fmt::format("{}", i)), bytes_of("bound")});
  }
  const std::string expected = hash_of_merged(files, "out");
  for (int i = 0; i < 8; ++i) {
    for (std::size_t j = files.size(); j > 1; --j) {
      std::swap(files[j - 1],
                files[static_cast<std::size_t>(random.uniform() * static_cast<double>(j))]);
    }
    EXPECT_EQ(hash_of_merged(files, "all"), expected) << "merged in another order";
    const auto cut = files.begin() + 1 + i % 5;
    static_cast<void>(hash_of_merged({files.begin(), cut}, "left"));
    static_cast<void>(hash_of_merged({cut, files.end()}, "right"));
    EXPECT_EQ(hash_of_merged({folder_ / "right", folder_ / "left"}, "all"), expected)
        << "merged in groups";
    EXPECT_EQ(hash_of_merged({folder_ / "out", files[0], files[0], folder_ / "left"}, "all"),
              expected)
        << "again";
  }
}

TEST_F(Merge, PrefersMeasuredRecords) {
  const Files files{
      shard(1, {failed(1), record_of(2, 5), failed(3), record_of(4)}),
      shard(2, {record_of(1), record_of(2, 6), failed(3, Outcome::hung), record_of(4)})};
  const RecordCounts counts = merge(files).plans.at(0).counts;
  EXPECT_EQ(counts.remeasured, 1U);
  EXPECT_EQ(counts.not_chosen, 2U);
  EXPECT_EQ(counts.repeated, 1U);
  EXPECT_EQ(counts.configurations, 4U);
  EXPECT_EQ(merged_records().at(0).outcome, Outcome::measured);
}

// A record with an injected fault does not show how the device behaves, so a record without a fault
// is preferred, even if it failed.
TEST_F(Merge, PrefersRecordsWithoutInjectedFaults) {
  const auto clean = [](Record record) {
    record.injected = "";
    return record;
  };
  const Files files{shard(1, {record_of(1, 5), clean(record_of(2)), record_of(3)}),
                    shard(2, {clean(record_of(1, 6)), record_of(2, 7), record_of(4)}),
                    shard(3, {clean(failed(3)), record_of(4, 8)})};
  const RecordCounts counts = merge(files).plans.at(0).counts;
  EXPECT_EQ(counts.injected, 3U);
  EXPECT_EQ(counts.not_chosen, 1U) << "only configuration 4 has two records with a fault";
  EXPECT_EQ(counts.remeasured, 0U);
  const std::vector<Record> records = merged_records();
  ASSERT_THAT(records, SizeIs(4));
  EXPECT_EQ(text_of(records[0]), text_of(clean(record_of(1, 6))));
  EXPECT_EQ(text_of(records[1]), text_of(clean(record_of(2))));
  EXPECT_EQ(text_of(records[2]), text_of(clean(failed(3))));
  const std::string expected = core::content_hash(core::read_file(folder_ / "out"));
  EXPECT_EQ(hash_of_merged({files[2], files[1], files[0]}, "out"), expected);
}

TEST_F(Merge, DifferentVersionsOfAPlanAreRejected) {
  const Files files{shard(1, {record_of(1)}), shard(2, {record_of(2)})};
  record::Run run = sample_run("run-002");
  run.plan_hash = "another";
  Store(files[1], Mode::append).add_run(run);
  expect_refused(
      files, AllOf(HasSubstr("shard-2.sqlite: contains results for plan fake/quick with the hash"),
                   HasSubstr("shard-1.sqlite"), HasSubstr("measure the others again")));
  run.plan_hash = "text";
  run.checks = {Check::timing};
  Store(files[1], Mode::append).add_run(run);
  expect_refused(files, AllOf(HasSubstr("the checks timing"), HasSubstr("--timed")));
}

TEST_F(Merge, DifferentDriversOfOneDeviceAreRejected) {
  Device newer = sample_device();
  newer.driver_version = "2.0";
  expect_refused({shard(1, {record_of(1)}), shard(2, {record_of(2)}, newer)},
                 AllOf(HasSubstr("shard-2.sqlite: device null:scripted differs from"),
                       HasSubstr("driver 2.0"), HasSubstr("separately")));
}

TEST_F(Merge, DifferentDataWithOneNameAreRejected) {
  Record other = record_of(2);
  other.data_hash = "other";
  const fs::path first = shard(1, {record_of(1)});
  expect_refused({first, shard(2, {other})},
                 AllOf(HasSubstr("shard-2.sqlite: contains results for different input data"),
                       HasSubstr("data=b"), HasSubstr("content hash other"), HasSubstr("4567")));
  other.configuration = configuration(1);
  expect_refused({first, shard(3, {other})},
                 HasSubstr("contains results for different input data"));
}

TEST_F(Merge, DataHashesMayDifferIfFactorsChangeTheVoxels) {
  int each = 0;
  for (const char* factor : {"voxel", "colour", "window", "mapping"}) {
    Record other = record_of(8);
    other.data_hash = "other";
    other.factors[factor] = "another";
    each += 2;
    EXPECT_NO_THROW(
        static_cast<void>(merge({shard(each, {record_of(9)}), shard(each + 1, {other})})))
        << factor;
    for (const char* part : {"out", "out-wal", "out-shm"}) fs::remove(folder_ / part);
  }
}

TEST_F(Merge, AnotherSchemaIsRejected) {
  const Files files{shard(1, {record_of(1)}), shard(2, {record_of(2)})};
  SQLite::Database(files[1].string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 3");
  expect_refused(files, AllOf(HasSubstr("shard-2.sqlite"), HasSubstr("schema version 3")));
}

TEST_F(Merge, ExistingFilesAreNotReplaced) {
  const Files files{shard(1, {record_of(1)}), shard(2, {record_of(2)})};
  const auto before = core::read_file(files[0]);
  EXPECT_THAT([&] { static_cast<void>(merge(files, "shard-1.sqlite")); },
              ThrowsMessage<core::InputError>(HasSubstr("already exists")));
  EXPECT_EQ(core::read_file(files[0]), before);
  core::write_file("a log", folder_ / "gone-wal");
  EXPECT_THAT([&] { static_cast<void>(merge(files, "gone")); },
              ThrowsMessage<core::InputError>(HasSubstr("log of a store that no longer exists")));
}

TEST_F(Merge, TheLatestRunOfEachPlanCounts) {
  const fs::path file = shard(1, {record_of(1)});
  {
    Store store(file, Mode::append);
    record::Run newer = sample_run("run-000");  // runs are ordered by time, regardless of their ids
    newer.plan_hash = "text";
    newer.configurations = 2;
    store.add_run(newer);
    store.add_device("run-000", sample_device(), {});
    Record record = record_of(2);
    record.run = "run-000";
    store.add_record(record);
    store.add_run(sample_run("run-other", "fake/other"));
  }
  EXPECT_THAT(gaps_of(Store(file, Mode::read)), SizeIs(1));
  const MergeResult result = merge({file});
  EXPECT_EQ(result.older_runs, 1U);
  EXPECT_THAT(result.plans, SizeIs(2));
  EXPECT_EQ(merged_records().at(0).configuration, configuration(2));
  EXPECT_THAT(merged_records(), SizeIs(1));
}

TEST_F(Merge, ReportsWhatAShardLacks) {
  const fs::path file = shard(1, {record_of(1), record_of(2)});
  EXPECT_THAT(gaps_of(Store(file, Mode::read)), IsEmpty());
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("DELETE FROM record WHERE seq = 1");
  const std::vector<Gap> gaps = gaps_of(Store(file, Mode::read));
  ASSERT_THAT(gaps, SizeIs(1));
  EXPECT_EQ(gaps[0].device, "null:scripted");
  EXPECT_EQ(gaps[0].records, 1U);
  EXPECT_EQ(gaps[0].configurations, 2U);
}

// The merged run must also list the planned configurations of each shard.
TEST_F(Merge, ReportsConfigurationsThatWereNeverBegun) {
  const fs::path file = shard(1, {record_of(1)});
  {
    Store store(file, Mode::append);
    const std::vector<std::string> planned{configuration(1), configuration(2)};
    store.begin(store.runs().back().id,
                {.host = "a",
                 .found = {"null:other", "null:scripted"},
                 .devices = {"null:other", "null:scripted"}},
                planned);
  }
  std::vector<Gap> gaps = gaps_of(Store(file, Mode::read));
  ASSERT_THAT(gaps, SizeIs(2));
  EXPECT_EQ(gaps[0].device, "null:other");
  EXPECT_THAT(gaps[0].missing, SizeIs(2));
  EXPECT_EQ(gaps[1].missing, std::vector{configuration(2)});
  static_cast<void>(merge({file}));
  gaps = gaps_of(Store(folder_ / "out", Mode::read));
  ASSERT_THAT(gaps, SizeIs(2));
  EXPECT_EQ(gaps[1].missing, std::vector{configuration(2)});
}

// If a plan has fewer configurations than shards, some shards are empty.
TEST_F(Merge, AnEmptyShardIsAGap) {
  const fs::path file = folder_ / "empty.sqlite";
  Store store(file, Mode::append);
  record::Run run = sample_run();
  run.configurations = 0;
  store.add_run(run);
  store.begin(run.id, {.host = "a", .found = {"null:scripted"}, .devices = {"null:scripted"}}, {});
  const std::vector<Gap> gaps = gaps_of(store);
  ASSERT_THAT(gaps, SizeIs(1));
  EXPECT_EQ(gaps[0].configurations, 0U);
}

// A merge keeps the seals (checksums) of records. If a value was changed in a shard, the error must
// be detected in the merged store.
TEST_F(Merge, SealsRemainValid) {
  const fs::path file = shard(1, {record_of(1)});
  static_cast<void>(merge({file}));
  EXPECT_NO_THROW(static_cast<void>(merged_records()));
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("UPDATE sample SET ns = 7");
  fs::remove(folder_ / "out");
  static_cast<void>(merge({file}));
  EXPECT_THAT([&] { static_cast<void>(merged_records()); },
              ThrowsMessage<core::InputError>(HasSubstr("was changed after it was written")));
}

// Merges more stores than may be open at the same time.
TEST_F(Merge, HundredsOfStoresAreMergedInGroups) {
  Files files;
  std::vector<Record> all;
  for (int i = 0; i < 130; ++i) {
    files.push_back(shard(i, {record_of(i), record_of(i + 1)}));
    all.push_back(record_of(i));
  }
  all.push_back(record_of(130));
  const RecordCounts counts = merge(files).plans.at(0).counts;
  EXPECT_EQ(counts.configurations, 131U);
  EXPECT_EQ(counts.repeated, 129U);
  std::vector<std::string> found;
  for (const Record& each : merged_records()) found.push_back(text_of(each));
  std::vector<std::string> expected;
  for (const Record& each : all) expected.push_back(text_of(each));
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  Record other = record_of(500);
  other.data_hash = "other";
  files.push_back(shard(999, {other}));
  for (const char* part : {"out", "out-wal", "out-shm"}) fs::remove(folder_ / part);
  expect_refused(files, AllOf(HasSubstr("shard-999.sqlite"), testing::Not(HasSubstr(".part"))));
}

}  // namespace
}  // namespace triptych::record
