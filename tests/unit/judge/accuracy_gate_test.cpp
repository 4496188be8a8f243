// Tests the comparison of images with limit images, to which images converge for small steps: the
// components of an error, and stored errors as baselines.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>

#include "accuracy/cases.hpp"
#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "fixture.hpp"
#include "report/exports/verdict_json.hpp"

namespace triptych::judge {
namespace {

core::Image shifted(core::Image image, float by) {
  for (float& value : image.rgba) value += by;
  return image;
}

class AccuracyGateTest : public JudgeTest {
 protected:
  static constexpr float lattice = 0.01F;

  AccuracyGateTest() {
    checks_ = {Check::image, Check::counters, Check::accuracy};
    request_.checks = {Check::accuracy};
    request_.limit = [this](const record::Record& record) { return limit_of(record); };
  }

  const accuracy::LimitImage* limit_of(const record::Record& record) {
    accuracy::LimitImage& limit = limits_[record.scene];
    limit.key = record.scene;
    limit.image = shifted(truth_of(record.scene), lattice);
    return &limit;
  }

  void accept_with_errors(const std::string& run) {
    AcceptRequest request;
    request.plan = plan;
    request.reason = "a test";
    request.date = "2026-02-01";
    request.truth = [this](const record::Record& record) { return request_.truth(record).truth; };
    request.limit = request_.limit;
    (void)accept(store_, run, folder_.path() / "baselines", request);
  }

  // Returns a reference image that lies 9 % of the way from the drawn image to the limit image.
  core::Image nearer_truth(const record::Record& record) {
    core::Image image = core::decode_exr(store_.image(record.image));
    const core::Image& limit = limit_of(record)->image;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
      image.rgba[i] += 0.09F * (limit.rgba[i] - image.rgba[i]);
    }
    return image;
  }

  // Adds a record whose image differs from the limit image by 0.02·stepᵒʳᵈᵉʳ.
  void add_step(const std::string& run, double step, double order) {
    record::Record record;
    record.run = run;
    record.suite = "volume";
    record.plan = plan;
    record.scene = front_;
    record.technique = "raycast";
    record.device = step_device;
    record.configuration = fmt::format("step={},technique=raycast", step);
    record.factors = {{"data", "ball"}, {"step", fmt::format("{}", step)}};
    record.outcome = record::Outcome::measured;
    record.wall_ns = {1e6 / step};
    const auto bytes = core::encode_exr(
        shifted(truth_of(front_), lattice - static_cast<float>(0.02 * std::pow(step, order))));
    record.image = core::content_hash(bytes);
    store_.add_image(record.image, bytes);
    store_.add_record(record);
  }

  // Returns a change that shifts the image of one configuration on one device.
  static Tweak shifted_on_lavapipe(float by) {
    return [by](record::Record& record, core::Image& image) {
      if (record.device == "vulkan:lavapipe" && record.configuration == plain_) {
        image = shifted(image, by);
      }
    };
  }

  static constexpr const char* step_device = "vulkan:lavapipe";

 private:
  std::map<std::string, accuracy::LimitImage> limits_;
};

TEST_F(AccuracyGateTest, SplitsTheErrorWithTheReferenceImage) {
  const core::Image truth = truth_of(front_);
  const auto error = accuracy::limit_errors(shifted(truth, 0.25F), truth, shifted(truth, 0.75F));
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->arithmetic, 0.25, 1e-6);
  EXPECT_NEAR(error->lattice, 0.75, 1e-6);
  EXPECT_NEAR(error->rmse, 0.5, 1e-6);
  EXPECT_NEAR(error->largest, 0.5, 1e-6);
  EXPECT_NEAR(error->error_99, 0.5, 1e-6);
  EXPECT_FALSE(accuracy::limit_errors(truth, truth, core::Image(1, 1)));
  EXPECT_FALSE(accuracy::limit_errors(shifted(truth, std::nanf("")), truth, truth));
}

TEST_F(AccuracyGateTest, AcceptedErrorsPass) {
  add_run("a");
  accept_with_errors("a");
  add_run("b");
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), core::ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::accuracy).size(), 12U);
  ASSERT_EQ(result.accuracies.size(), 6U);  // two scenes on three devices
  EXPECT_EQ(result.accuracies[0].cases.size(), 2U);
  const core::Json json = report::to_json(result).at("accuracies").at(0);
  EXPECT_EQ(json.at("device"), result.accuracies[0].device);
  ASSERT_EQ(json.at("configurations").size(), 2U);
  EXPECT_EQ(json.at("configurations")[1].at("rmse"), result.accuracies[0].cases[1].rmse);
}

// The times of a device come from its own clock only if the clock is trusted for all work of the
// device. Otherwise, they come from the wall clock.
TEST_F(AccuracyGateTest, TimesOfADeviceComeFromOneClock) {
  const auto timed = [](bool all) {
    return [all](record::Record& record, core::Image&) {
      record.wall_ns = {5e6};
      record.device_ns = {2e6};
      record.device_clock_trusted = all || record.configuration == plain_;
    };
  };
  add_run("a", timed(false));
  add_run("b", timed(true));
  for (const auto& [run, expected] : {std::pair{"a", 5e6}, {"b", 2e6}}) {
    const GateResult result = gate(run);
    ASSERT_FALSE(result.accuracies.empty());
    for (const accuracy::AccuracyScene& scene : result.accuracies) {
      for (const accuracy::AccuracyCase& each : scene.cases) {
        EXPECT_EQ(each.time_ns, expected) << run << ' ' << each.configuration;
      }
    }
  }
}

// The image is still within its error bound, but its distance from the limit image grew by more
// than rounding can explain.
TEST_F(AccuracyGateTest, ALargerErrorIsARegression) {
  add_run("a");
  accept_with_errors("a");
  add_run("b", shifted_on_lavapipe(-bound / 2));
  const auto regressions = with(gate("b"), Verdict::regression, Check::accuracy);
  ASSERT_EQ(regressions.size(), 1U);
  EXPECT_EQ(regressions[0].device, "vulkan:lavapipe");
  EXPECT_EQ(regressions[0].cause, Cause::error);
  EXPECT_GT(regressions[0].number("rmse"), regressions[0].number("bound"));
  EXPECT_GT(regressions[0].numbers.at("rmse"), regressions[0].numbers.at("bound"));
}

TEST_F(AccuracyGateTest, ASmallerErrorPasses) {
  add_run("a");
  accept_with_errors("a");
  add_run("b", shifted_on_lavapipe(lattice / 2));
  EXPECT_TRUE(with(gate("b"), Verdict::regression, Check::accuracy).empty());
}

TEST_F(AccuracyGateTest, WithoutAStoredErrorThereIsNoVerdict) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_EQ(with(gate("a"), Verdict::cannot_judge, Check::accuracy).size(), 12U);
}

// A device that was never accepted may have as large an error as the worst accepted device.
TEST_F(AccuracyGateTest, ANewDeviceIsComparedWithTheWorstAcceptedError) {
  add_run("a");
  accept_with_errors("a");
  std::string stored;
  {
    std::ifstream in(baseline("accuracy.json"));
    stored.assign(std::istreambuf_iterator<char>(in), {});
  }
  for (auto place = stored.find("vulkan:lavapipe"); place != std::string::npos;
       place = stored.find("vulkan:lavapipe")) {
    stored.replace(place, 15, "vulkan:other");
  }
  rewrite("accuracy.json", stored);
  add_run("b", shifted_on_lavapipe(-bound / 2));
  add_run("c");
  EXPECT_EQ(with(gate("b"), Verdict::regression, Check::accuracy).size(), 1U);
  EXPECT_TRUE(with(gate("c"), Verdict::regression, Check::accuracy).empty());
}

// If the order of convergence falls from 2 to 1.95, the error with the smallest step size, 1/16,
// grows by 15 %. That growth alone would be within the accepted rounding error.
TEST_F(AccuracyGateTest, ALowerOrderIsARegression) {
  request_.truth = [this](const record::Record& record) {
    const core::Image truth = nearer_truth(record);
    return TruthPair{.truth = truth, .bound = truth};
  };
  const auto run_of_order = [this](const std::string& run, double order) {
    store_.add_run({run, plan, "2026-02-01T00:00:00Z", {}, checks_});
    record::Device device;
    device.id = step_device;
    store_.add_device(run, device, {});
    for (const double step : {1.0, 0.5, 0.25, 0.125, 0.0625}) add_step(run, step, order);
  };
  run_of_order("a", 2);
  accept_with_errors("a");
  run_of_order("b", 2);
  EXPECT_TRUE(with(gate("b"), Verdict::regression).empty()) << text(gate("b"));
  run_of_order("c", 1.95);
  const auto lower = with(gate("c"), Verdict::regression, Check::accuracy);
  ASSERT_EQ(lower.size(), 1U) << text(gate("c"));
  EXPECT_NEAR(lower[0].number("order"), 1.95, 5e-3);
  EXPECT_NEAR(lower[0].number("stored_order"), 2, 5e-3);
  // This reference image is so far from the images that hardly any error comes from the step size.
  // An order of convergence can therefore not be determined.
  request_.truth = [](const record::Record& record) {
    const core::Image truth = truth_of(record.scene);
    return TruthPair{.truth = truth, .bound = truth};
  };
  const auto lost = with(gate("b"), Verdict::cannot_judge, Check::accuracy);
  ASSERT_EQ(lost.size(), 1U) << text(gate("b"));
  EXPECT_EQ(lost[0].cause, Cause::no_order);
}

// If one configuration cannot be judged, the verdicts on all other configurations must remain the
// same.
TEST_F(AccuracyGateTest, ConfigurationsThatCannotBeJudgedAreReported) {
  add_run("a");
  accept_with_errors("a");
  const std::size_t all = with(gate("a"), Verdict::pass).size();
  const auto is_selected = [](const record::Record& record) {
    return record.device == step_device && record.configuration == plain_;
  };
  const auto copy_with_image = [&](const std::string& run, const std::string& hash) {
    store_.add_run({run, plan, "2026-02-02T00:00:00Z", {}});
    for (const auto& entry : store_.devices("a")) store_.add_device(run, entry.device, {});
    for (record::Record record : store_.records("a")) {
      record.run = run;
      if (is_selected(record)) record.image = hash;
      store_.add_record(record);
    }
  };
  const auto undecided_cause = [&](const std::string& run) {
    const GateResult result = gate(run);
    EXPECT_EQ(with(result, Verdict::pass).size(), all - 1) << text(result);
    const auto findings = with(result, Verdict::cannot_judge, Check::accuracy);
    EXPECT_EQ(findings.size(), 1U) << text(result);
    return findings.empty() ? Cause::none : findings[0].cause;
  };
  copy_with_image("lost", "0123");
  EXPECT_EQ(undecided_cause("lost"), Cause::unknown_error);
  copy_with_image("without", "");
  EXPECT_EQ(undecided_cause("without"), Cause::no_image);
  request_.limit = [&](const record::Record& record) {
    return is_selected(record) ? nullptr : limit_of(record);
  };
  EXPECT_EQ(undecided_cause("a"), Cause::no_limit_any_more);
}

TEST_F(AccuracyGateTest, APlanWithoutLimitsDoesNotPass) {
  add_run("a");
  (void)accept_run("a");
  request_.limit = nullptr;
  request_.checks = {Check::image, Check::accuracy};
  EXPECT_EQ(gate("a").exit_code(), core::ExitCode::cannot_judge) << text(gate("a"));
}

TEST_F(AccuracyGateTest, OnlyAccuracyPlansAreJudgedByDefault) {
  add_run("a");
  accept_with_errors("a");
  GateRequest default_request = request_;
  default_request.checks.clear();
  EXPECT_FALSE(gate("a", default_request).accuracies.empty());
  checks_ = {Check::image};
  add_run("b");
  EXPECT_TRUE(gate("b", default_request).accuracies.empty());
}

}  // namespace
}  // namespace triptych::judge
