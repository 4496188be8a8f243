#include "record/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/json.hpp"
#include "samples.hpp"
#include "store_fixture.hpp"

namespace triptych::record {
namespace {

using core::Json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Mode = Store::Mode;

std::vector<std::string> ids_of(const std::vector<Run>& runs) {
  std::vector<std::string> ids;
  for (const Run& each : runs) ids.push_back(each.id);
  return ids;
}

TEST_F(StoreTest, EverythingComesBackFromTheFile) {
  {
    Store store(file_, Mode::append);
    store.add_run(sample_run());
    store.add_device("run-1", sample_device(), {sample_clock()});
    store.add_record(sample_record());
    store.add_image("0123", bytes_of("an image"));
    store.set_truth({"scene", "1", bytes_of("truth"), bytes_of("bound")});
  }
  const Store store(file_, Mode::read);
  EXPECT_EQ(Json(store.runs()), Json(std::vector{sample_run()}));
  const auto devices = store.devices("run-1");
  ASSERT_THAT(devices, SizeIs(1));
  EXPECT_EQ(devices.front().device, sample_device());
  EXPECT_THAT(devices.front().clocks, ElementsAre(sample_clock()));
  EXPECT_EQ(Json(store.records("run-1")), Json(std::vector{sample_record()}));
  EXPECT_EQ(store.image("0123"), bytes_of("an image"));
  const auto truth = store.truth("scene", "1");
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->image, bytes_of("truth"));
  EXPECT_EQ(truth->bound, bytes_of("bound"));
}

TEST_F(StoreTest, VisitingRecordsMatchesReadingAll) {
  Store store(file_, Mode::append);
  store.add_run(sample_run());
  store.add_run(sample_run("run-2"));
  Record second = sample_record("camera=b,data=b,technique=raycast");
  second.wall_ns.pop_back();
  second.counters = {};
  second.same_as = {};
  second.factors["skip"] = "none";
  store.add_record(sample_record());
  store.add_record(sample_record("camera=a", "null:scripted", "run-2"));
  store.add_record(second);
  std::vector<Record> visited;
  store.visit_records("run-1", [&](const Record& each) { visited.push_back(each); });
  EXPECT_EQ(Json(visited), Json(store.records("run-1")));
  EXPECT_THAT(visited, SizeIs(2));
  EXPECT_THAT(store.names("run-1", "factor"), ElementsAre("camera", "data", "skip", "step"));
  EXPECT_THAT(store.names("run-2", "factor"), ElementsAre("camera", "data", "step"));
  EXPECT_THAT(store.names("run-3", "cost"), IsEmpty());
}

TEST_F(StoreTest, MissingRows) {
  Store store(file_, Mode::append);
  EXPECT_THAT(store.runs(), IsEmpty());
  EXPECT_FALSE(store.latest_run("fake/quick"));
  EXPECT_THAT(store.devices("run-1"), IsEmpty());
  EXPECT_THAT(store.records("run-1"), IsEmpty());
  EXPECT_FALSE(store.has_record("run-1", "a", "b"));
  EXPECT_THROW(static_cast<void>(store.image("0123")), core::InputError);
  EXPECT_FALSE(store.truth("scene", "1"));
  EXPECT_THROW(store.add_record(sample_record()), core::InputError) << "its run does not exist";
  EXPECT_THROW(store.add_device("run-1", sample_device(), {}), core::InputError);
}

TEST_F(StoreTest, AttemptsAreCountedUntilThereIsARecord) {
  Store store(file_, Mode::append);
  EXPECT_THROW((void)store.begin_record("run-1", "a", "gl:a"), core::InputError);
  store.add_run(sample_run());
  const Record made = sample_record();
  const auto begin = [&] { return store.begin_record("run-1", made.configuration, made.device); };
  EXPECT_EQ(begin(), 1);
  EXPECT_EQ(store.begin_record("run-1", made.configuration, "gl:another"), 1);
  EXPECT_EQ(begin(), 2);
  store.unbegin_record("run-1", made.configuration, made.device);
  EXPECT_EQ(begin(), 2);
  EXPECT_FALSE(store.has_record("run-1", made.configuration, made.device));
  store.add_record(made);
  EXPECT_EQ(begin(), 1);
}

TEST_F(StoreTest, NonFiniteNumbers) {
  Store store(file_, Mode::append);
  store.add_run(sample_run());
  Record record = sample_record();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  record.wall_ns = {1, nan, 3, std::numeric_limits<double>::infinity()};
  record.device_ns = {};
  record.prepare_ns = nan;
  store.add_record(record);
  const Record back = store.records("run-1").at(0);
  ASSERT_THAT(back.wall_ns, SizeIs(4));
  EXPECT_TRUE(std::isnan(back.wall_ns[1]));
  EXPECT_TRUE(std::isinf(back.wall_ns[3]));
  EXPECT_THAT(back.device_ns, IsEmpty());
  EXPECT_TRUE(std::isnan(back.prepare_ns));
}

TEST_F(StoreTest, TextOfAnyBytes) {
  Store store(file_, Mode::append);
  store.add_run(sample_run());
  Record record = sample_record();
  record.reason.detail = std::string("a'b\"c\n\0d\xff", 9);
  store.add_record(record);
  EXPECT_EQ(store.records("run-1").at(0).reason, record.reason);
  Device device = sample_device();
  device.limits["x"] = "\xff";
  EXPECT_NO_THROW(store.add_device("run-1", device, {}));
}

TEST_F(StoreTest, RunsInTheOrderTheyWereAdded) {
  Store store(file_, Mode::append);
  store.add_run(sample_run("b"));
  store.add_run(sample_run("a"));
  store.add_run(sample_run("c", "fake/other"));
  EXPECT_THAT(ids_of(store.runs()), ElementsAre("b", "a", "c"));
  EXPECT_EQ(store.latest_run("fake/quick")->id, "a");
  EXPECT_EQ(store.latest_run("fake/other")->id, "c");

  // If a run is resumed, it is added again, but keeps its position and its records.
  store.add_record(sample_record("x", "d", "b"));
  record::Run again = sample_run("b");
  again.system["resumed"] = "yes";
  store.add_run(again);
  EXPECT_THAT(ids_of(store.runs()), ElementsAre("b", "a", "c"));
  EXPECT_EQ(store.runs().at(0).system.at("resumed"), "yes");
  EXPECT_THAT(store.records("b"), SizeIs(1));
}

TEST_F(StoreTest, RecordsAreSortedByDeviceThenAsAdded) {
  Store store(file_, Mode::append);
  store.add_run(sample_run());
  store.add_run(sample_run("run-2"));
  store.add_record(sample_record("z", "gl:b"));
  store.add_record(sample_record("z", "gl:a"));
  store.add_record(sample_record("y", "gl:b"));
  store.add_record(sample_record("x", "gl:a"));
  store.add_record(sample_record("x", "gl:a", "run-2"));
  std::vector<std::string> order;
  for (const Record& each : store.records("run-1")) {
    order.push_back(each.device + " " + each.configuration);
  }
  EXPECT_THAT(order, ElementsAre("gl:a z", "gl:a x", "gl:b z", "gl:b y"));
  EXPECT_TRUE(store.has_record("run-1", "y", "gl:b"));
  EXPECT_FALSE(store.has_record("run-1", "y", "gl:a"));
  EXPECT_FALSE(store.has_record("run-2", "y", "gl:b"));
}

TEST_F(StoreTest, SameKeyReplacesTheWholeRecord) {
  Store store(file_, Mode::append);
  store.add_run(sample_run());
  store.add_record(sample_record());
  Record second = sample_record();
  second.wall_ns = {1};
  second.device_ns.clear();
  second.counters.clear();
  second.factors = {{"data", "other"}};
  store.add_record(second);
  EXPECT_EQ(Json(store.records("run-1")), Json(std::vector{second}));

  store.add_device("run-1", sample_device(), {sample_clock(), sample_clock()});
  Device newer = sample_device();
  newer.driver_version = "2";
  store.add_device("run-1", newer, {sample_clock()});
  ASSERT_THAT(store.devices("run-1"), SizeIs(1));
  EXPECT_EQ(store.devices("run-1").front().device.driver_version, "2");
  EXPECT_THAT(store.devices("run-1").front().clocks, SizeIs(1));

  store.set_truth({"s", "1", bytes_of("old"), bytes_of("old")});
  store.set_truth({"s", "1", bytes_of("new"), bytes_of("new")});
  EXPECT_EQ(store.truth("s", "1")->image, bytes_of("new"));
  EXPECT_FALSE(store.truth("s", "2"));

  store.add_image("h", bytes_of("first"));
  store.add_image("h", bytes_of("second"));
  EXPECT_EQ(store.image("h"), bytes_of("first")) << "a hash names one content";
}

TEST_F(StoreTest, EmptyImage) {
  Store store(file_, Mode::append);
  store.add_image("h", {});
  EXPECT_THAT(store.image("h"), IsEmpty());
}

TEST_F(StoreTest, StoresCanBeMoved) {
  Store first(file_, Mode::append);
  first.add_run(sample_run());
  Store second(std::move(first));
  EXPECT_THAT(second.runs(), SizeIs(1));
  Store third(folder_ / "other.sqlite", Mode::append);
  third = std::move(second);
  third.add_run(sample_run("run-2"));
  EXPECT_THAT(third.runs(), SizeIs(2));
}

// docs/store.md documents these columns for users' own queries.
TEST_F(StoreTest, DocumentedColumnsExist) {
  {
    Store store(file_, Mode::append);
    store.add_run(sample_run());
    store.add_device("run-1", sample_device(), {sample_clock()});
    store.add_record(sample_record());
    Record skipped = sample_record("other");
    skipped.outcome = Outcome::skipped;
    skipped.wall_ns.clear();
    skipped.device_ns.clear();
    store.add_record(skipped);
  }
  SQLite::Database database(file_.string());
  SQLite::Statement row(database,
                        "SELECT r.outcome, r.clock, r.frames, r.median_ns, r.median_wall_ns, "
                        "f.value FROM record r JOIN factor f ON f.record = r.seq "
                        "WHERE r.configuration <> 'other' AND f.name = 'step'");
  ASSERT_TRUE(row.executeStep());
  EXPECT_EQ(row.getColumn(0).getString(), "measured");
  EXPECT_EQ(row.getColumn(1).getString(), "device");
  EXPECT_EQ(row.getColumn(2).getInt(), 4);
  EXPECT_DOUBLE_EQ(row.getColumn(3).getDouble(), 7.5);
  EXPECT_DOUBLE_EQ(row.getColumn(4).getDouble(), 7.875);
  EXPECT_EQ(row.getColumn(5).getString(), "0.5");
  SQLite::Statement none(database, "SELECT median_ns FROM record WHERE configuration = 'other'");
  ASSERT_TRUE(none.executeStep());
  EXPECT_TRUE(none.getColumn(0).isNull())
      << "without samples, the median must be absent rather than zero";
  EXPECT_EQ(
      database.execAndGet("SELECT json_extract(limits, '$.max_image_3d') FROM device").getString(),
      "2048");
}

}  // namespace
}  // namespace triptych::record
