#include <gtest/gtest.h>

#include <set>

#include "backends/null/backend.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "measure/plan.hpp"
#include "measure/plant.hpp"
#include "suites/anchors/suite.hpp"

namespace triptych::anchors_suite {
namespace {

measure::Plan load(measure::Suite& suite, const measure::Overrides& overrides = {}) {
  return measure::load_plan("anchors/frozen", overrides,
                            [&](std::string_view) -> measure::Suite& { return suite; });
}

TEST(AnchorSuite, TheFrozenPlanIsEveryTechniqueInTwoSizes) {
  const auto suite = make_suite({});
  std::set<std::string> keys;
  for (const auto& each : load(*suite).configurations) {
    keys.insert(measure::configuration_key(*suite, each));
    EXPECT_TRUE(suite->missing_data(each).empty());
  }
  EXPECT_EQ(keys.size(), 10U);
  EXPECT_TRUE(keys.contains("technique=anchor_arithmetic"));
  EXPECT_TRUE(keys.contains("size=2,technique=anchor_launch"));
}

TEST(AnchorSuite, ASizeIsAWholeNumber) {
  const auto suite = make_suite({});
  EXPECT_EQ(load(*suite, {{"size", {"7"}}}).configurations.size(), 5U);
  for (const char* size : {"1.5", "0", "-1", "257", "large"}) {
    EXPECT_THROW(static_cast<void>(load(*suite, {{"size", {size}}})), core::InputError) << size;
  }
}

TEST(AnchorSuite, HasNoTruth) {
  const auto suite = make_suite({});
  const measure::Configuration any = load(*suite).configurations.front();
  EXPECT_THROW(static_cast<void>(suite->truth(any, {})), core::NotSupported);
  EXPECT_THROW(static_cast<void>(suite->truth_key(any, {})), core::NotSupported);
  EXPECT_THROW(static_cast<void>(suite->describe(any)), core::NotSupported);
}

TEST(AnchorSuite, AScriptPlaysItInProportionToTheSize) {
  const auto suite = make_suite({});
  const auto backend = null_backend::make_backend(
      null_backend::Script{.base_ns = 0, .ns_per_sample = 1, .warm_up_factor = 1, .noise = 0});
  const auto device = backend->open("null:scripted");
  const auto frame = [&](const char* size, measure::Purpose purpose) {
    measure::Configuration configuration{{"technique", "anchor_fetch"}, {"size", size}};
    return device->prepare(suite->work(configuration, *device))->frame(purpose);
  };
  const double once = frame("1", measure::Purpose::timing).wall_ns;
  EXPECT_GT(once, 0);
  EXPECT_DOUBLE_EQ(frame("4", measure::Purpose::timing).wall_ns, 4 * once);
  EXPECT_EQ(frame("2", measure::Purpose::counters).counts.size(), 1U);
}

TEST(AnchorSuite, TakesNoPlantedFault) {
  measure::Work work{.technique = "anchor_fetch", .scene = measure::AnchorWork{}};
  EXPECT_THROW(measure::apply_plant("slowdown:10", work), core::NotSupported);
  EXPECT_THROW(measure::apply_plant("device_lost", work), core::DeviceLost);
}

}  // namespace
}  // namespace triptych::anchors_suite
