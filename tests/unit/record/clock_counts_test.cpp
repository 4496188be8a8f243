#include "record/clock_counts.hpp"

#include <gmock/gmock.h>

#include "store_fixture.hpp"

namespace triptych::record {
namespace {

using testing::Pair;
using testing::UnorderedElementsAre;

class ClockCountsTest : public StoreTest {
 protected:
  ClockCountsTest() : store(file_, Store::Mode::append) {}

  void add(const std::string& run, const std::string& configuration, bool trusted) {
    Record record = sample_record(configuration, "null:scripted", run);
    record.device_clock_trusted = trusted;
    store.add_record(record);
  }

  Store store;
};

TEST_F(ClockCountsTest, CountsTimedConfigurations) {
  store.add_run(sample_run());
  add("run-1", "a", true);
  add("run-1", "b", true);
  add("run-1", "c", false);
  Record untimed = sample_record("d");
  untimed.wall_ns.clear();
  untimed.device_ns.clear();
  store.add_record(untimed);
  const auto counts = clock_counts(store, "run-1");
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_THAT(counts.at("null:scripted"), UnorderedElementsAre(Pair("device", 2), Pair("wall", 1)));
}

TEST_F(ClockCountsTest, ThePreviousRunIsOfTheSamePlan) {
  for (const auto& [id, plan] :
       {std::pair("1", "fake/a"), {"2", "fake/b"}, {"3", "fake/a"}, {"4", "fake/a"}}) {
    store.add_run(sample_run(id, plan));
  }
  EXPECT_EQ(previous_run(store, "4"), "3");
  EXPECT_EQ(previous_run(store, "3"), "1");
  EXPECT_EQ(previous_run(store, "2"), "");
  EXPECT_EQ(previous_run(store, "unknown"), "");
}

}  // namespace
}  // namespace triptych::record
