#include "record/benchmark_entries.hpp"

#include <gtest/gtest.h>

#include "core/json.hpp"

namespace triptych::record {
namespace {

using core::Json;

TEST(BenchmarkEntries, UnpackingInvertsPackingToTheByte) {
  const Json entries = Json::array({
      {{"name", "x"}, {"real_time", 1.5}, {"samples", 7}, {"threads", 1}},
      {{"name", "x"}, {"real_time", 1.5}, {"samples", 7}, {"threads", 1}},
      {{"name", "x_mean"}, {"real_time", 2}, {"samples", 7.0}, {"aggregate_name", "mean"}},
      {{"name", "x/loop"}, {"samples", 7}},
  });
  EXPECT_EQ(unpack_benchmark_entries(pack_benchmark_entries(entries)).dump(), entries.dump());
}

TEST(BenchmarkEntries, RepeatedTextIsStoredOnce) {
  Json entries = Json::array();
  for (int i = 0; i < 16; ++i) {
    entries.push_back({{"name", std::string(200, 'n')}, {"samples", 123456}, {"index", i}});
  }
  EXPECT_LT(8 * pack_benchmark_entries(entries).size(), 2 * entries.dump().size());
}

TEST(BenchmarkEntries, OlderStoresAndEmptyEntriesAreRead) {
  EXPECT_EQ(unpack_benchmark_entries(R"([{"name":"x"},{"name":"y"}])").size(), 2U);
  EXPECT_EQ(unpack_benchmark_entries(R"({"name":"x"})"), Json::array({{{"name", "x"}}}));
  EXPECT_EQ(unpack_benchmark_entries(""), Json::array());
  EXPECT_EQ(pack_benchmark_entries(Json::array()), "");
}

}  // namespace
}  // namespace triptych::record
