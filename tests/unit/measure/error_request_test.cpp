// Tests the search of `--error E` with a suite whose errors are known, and the choice of its
// answer.

#include "measure/request/error_request.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/image_io.hpp"
#include "core/temporary_folder.hpp"
#include "measure/contract/factor.hpp"
#include "measure/request/error_answer.hpp"
#include "stub_suite.hpp"

namespace triptych::measure {
namespace {

constexpr double step_factor = 1.9e-3;
constexpr double ert_factor = 0.1;

core::Image uniform_image(double value) {
  core::Image image(32, 32);
  std::ranges::fill(image.rgba, static_cast<float>(value));
  return image;
}

// A suite whose images have one value everywhere. The step causes an error of second order.
class SuiteWithKnownError final : public StubSuite {
 public:
  SuiteWithKnownError()
      : StubSuite({{.name = "technique",
                    .kind = FactorKind::choice,
                    .levels = {"raycast", "raycast_fragment"},
                    .default_value = "raycast",
                    .determines_image = false,
                    .automatic = {"raycast", "raycast_fragment"}},
                   {.name = "data", .default_value = "cube"},
                   {.name = "camera", .default_value = "front"},
                   {.name = "viewport", .default_value = "32"},
                   number("step", 1.0 / 64, 4096, "1", true),
                   {.name = "quadrature",
                    .kind = FactorKind::choice,
                    .levels = {"midpoint", "own"},
                    .default_value = "midpoint"},
                   {.name = "skip",
                    .kind = FactorKind::choice,
                    .levels = {"none", "bricks", "distance"},
                    .default_value = "distance",
                    .determines_image = false},
                   number("ert", 0, 0.5, "0.002", false),
                   number("adapt", 0, 0.5, "0", false)}) {}

  std::string_view name() const override { return "known"; }
  accuracy::TruthPair truth(const Configuration& configuration,
                            const std::map<std::string, double>&) override {
    ++truths;
    const double step = as_number(configuration, "step");
    return {uniform_image(0.5 + step_factor * step * step), uniform_image(0)};
  }
  std::string truth_key(const Configuration&, const std::map<std::string, double>&) override {
    return {};
  }
  std::string limit_key(const Configuration& configuration) override {
    return "limit " + configuration.at("viewport");
  }
  Limit limit(const Configuration&) override { return {uniform_image(0.5), uniform_image(0)}; }

  int truths = 0;  // number of reference images

 private:
  static Factor number(std::string name, double minimum, double maximum, std::string value,
                       bool determines_image) {
    return {.name = std::move(name),
            .kind = FactorKind::number,
            .minimum = minimum,
            .maximum = maximum,
            .default_value = std::move(value),
            .determines_image = determines_image};
  }
};

class ErrorRequestTest : public testing::Test {
 protected:
  // The device's error: errors of the step and of early termination are independent.
  static double error_of(const Configuration& configuration) {
    const double step = as_number(configuration, "step");
    return std::hypot(step_factor * step * step, ert_factor * as_number(configuration, "ert"));
  }

  [[nodiscard]] record::Record drawn(const Configuration& configuration,
                                     const std::string& device) const {
    record::Record record;
    record.suite = suite_.name();
    record.device = device;
    record.configuration = configuration_key(suite_, configuration);
    record.scene = scene_key(suite_, configuration);
    record.factors = configuration;
    record.technique = configuration.at("technique");
    record.outcome = record::Outcome::measured;
    const double samples =
        1e6 / as_number(configuration, "step") * (1 - 20 * as_number(configuration, "ert"));
    record.counters["samples"] = static_cast<std::uint64_t>(samples);
    return record;
  }

  ErrorRequest request(const ErrorGoal& goal, const Overrides& overrides = {}) {
    return request_error(
        default_plan(suite_, overrides),
        {suite_, goal, truths_,
         [&](const Plan& plan, const UseTrial& use) {
           EXPECT_FALSE(plan.timed());
           ++rounds_;
           for (const std::string& device : devices_) {
             for (const Configuration& each : plan.configurations) {
               ++trials_;
               if (device == "null:broken") continue;
               use(drawn(each, device), uniform_image(0.5 + error_of(each)));
             }
           }
         },
         [&](const ErrorProgress& progress) { reported_.push_back(progress.phase); }});
  }

  SuiteWithKnownError suite_;
  core::TemporaryFolder folder_;
  record::Store store_{folder_.path() / "store", record::Store::Mode::append};
  Truths truths_{[this](std::string_view) -> SuiteWithTruth& { return suite_; }, store_};
  std::vector<std::string> devices_{"null:a"};
  int trials_ = 0;
  int rounds_ = 0;
  std::vector<ErrorProgress::Phase> reported_;
};

// A fixed share of 0.7 of the error would allow a step of at most 0.607, and an ert of 0.00025.
TEST_F(ErrorRequestTest, UsesTheWholeError) {
  const ErrorGoal goal = error_goal("1e-3", {});
  const ErrorRequest found = request(goal);
  EXPECT_TRUE(found.unreachable.empty());
  ASSERT_EQ(found.plan.configurations.size(), 4U);  // three levels of `skip`, and merged samples
  for (const Configuration& each : found.plan.configurations) {
    EXPECT_LE(error_of(each), 1e-3);
    EXPECT_GE(as_number(each, "step"), 0.7);
    EXPECT_GE(as_number(each, "ert"), 9.9e-4);
  }
  EXPECT_TRUE(found.plan.timed());
  EXPECT_LE(trials_, 18);
  // Only the estimate of the first step needs reference images.
  EXPECT_LE(suite_.truths, 15);
}

TEST_F(ErrorRequestTest, IsTheSameForEveryCall) {
  const ErrorGoal goal = error_goal("1e-3", {});
  EXPECT_EQ(request(goal).plan.configurations, request(goal).plan.configurations);
}

TEST_F(ErrorRequestTest, ReportsEachPhase) {
  using Phase = ErrorProgress::Phase;
  static_cast<void>(request(error_goal("1e-3", {})));
  ASSERT_GE(reported_.size(), 4U);
  EXPECT_EQ(std::vector(reported_.begin(), reported_.begin() + 4),
            (std::vector{Phase::begin, Phase::step_search, Phase::step_found, Phase::trials}));
  EXPECT_EQ(std::ranges::count(reported_, Phase::trials), rounds_);
}

TEST_F(ErrorRequestTest, KeepsFactorsThatTheUserFixes) {
  const ErrorGoal goal = error_goal("1e-3", {"step", "skip", "data"});
  EXPECT_EQ(goal.fixed, (std::set<std::string>{"step", "skip"}));
  const ErrorRequest found = request(goal, {{"step", {"0.5", "0.25"}}, {"skip", {"none"}}});
  ASSERT_EQ(found.plan.configurations.size(), 2U);
  EXPECT_EQ(found.plan.configurations[0].at("step"), "0.5");
  EXPECT_EQ(found.plan.configurations[1].at("step"), "0.25");
  for (const Configuration& each : found.plan.configurations) {
    EXPECT_EQ(each.at("skip"), "none");
    EXPECT_GT(as_number(each, "ert"), 2.5e-4);
    EXPECT_LE(error_of(each), 1e-3);
  }
  EXPECT_EQ(suite_.truths, 0);
}

TEST_F(ErrorRequestTest, IgnoresAPlansLevelsOfOtherFactors) {
  EXPECT_EQ(request(error_goal("1e-3", {}), {{"step", {"0.5", "0.25"}}}).plan.configurations.size(),
            4U);
}

// Techniques share the estimate of the first step, but are drawn and measured separately.
TEST_F(ErrorRequestTest, SearchesEachTechnique) {
  const ErrorGoal goal = error_goal("1e-3", {});
  static_cast<void>(request(goal));
  const int truths = std::exchange(suite_.truths, 0);
  const ErrorRequest found = request(goal, {{"technique", {"auto"}}});
  EXPECT_EQ(found.plan.configurations.size(), 8U);
  EXPECT_EQ(suite_.truths, truths);
}

TEST_F(ErrorRequestTest, MeasuresADeviceThatDrewNoTrial) {
  devices_ = {"null:broken"};
  const ErrorRequest found = request(error_goal("1e-3", {}));
  EXPECT_EQ(found.plan.configurations.size(), 4U);
  EXPECT_EQ(rounds_, 1);
}

TEST_F(ErrorRequestTest, ReportsWhyAnErrorIsOutOfReach) {
  const ErrorRequest empty = request(error_goal("0.9", {}));
  ASSERT_EQ(empty.unreachable.size(), 1U);
  EXPECT_EQ(empty.unreachable[0].why, Unreachable::Why::empty_image);
  const ErrorRequest tiny = request(error_goal("1e-9", {}));
  ASSERT_EQ(tiny.unreachable.size(), 1U);
  EXPECT_EQ(tiny.unreachable[0].why, Unreachable::Why::step);
  EXPECT_EQ(trials_, 0);
}

// The answer of each device has its own step. Their order, and the records to be compared, must not
// depend on slower candidates.
TEST_F(ErrorRequestTest, IsAnsweredByTheFastestOfEachDevice) {
  const ErrorGoal goal = error_goal("1e-3", {});
  std::vector<record::Record> records;
  const auto add = [&](const std::string& device, const std::string& step, double milliseconds) {
    Configuration configuration = default_plan(suite_, {}).configurations.at(0);
    configuration["step"] = step;
    configuration["ert"] = "0.0005";
    record::Record record = drawn(configuration, device);
    record.image = device + step;
    record.wall_ns = {1e6 * milliseconds, 1.1e6 * milliseconds, 1.2e6 * milliseconds};
    store_.add_image(record.image, core::encode_exr(uniform_image(0.5 + error_of(configuration))));
    records.push_back(record);
  };
  add("null:a", "0.7", 30);
  add("null:a", "0.25", 900);
  add("null:a", "2", 1);  // does not meet the error
  add("null:b", "0.5", 20);
  add("null:c", "0.5", 21);
  const std::vector<ErrorAnswer> answers = answer_error(records, suite_, goal, truths_);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].device, "null:b");
  EXPECT_EQ(answers[0].clock, "wall");
  EXPECT_EQ(answers[2].record, &records[0]);
  EXPECT_TRUE(is_not_clearly_slower(answers[1], answers[0]));
  EXPECT_FALSE(is_not_clearly_slower(answers[2], answers[0]));
  const std::vector<record::Record> compared = answer_records(answers);
  ASSERT_EQ(compared.size(), 3U);
  for (const record::Record& each : compared) {
    EXPECT_EQ(each.configuration, compared[0].configuration);
  }
}

}  // namespace
}  // namespace triptych::measure
