// Tests the scores of stress cases: the reasons for lost points, scores as baselines, and
// expectations in addition to the reference image.

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "fixture.hpp"
#include "judge/stress/expectation.hpp"
#include "judge/stress/stress.hpp"

namespace triptych::judge {
namespace {

constexpr const char* stress_device = "vulkan:lavapipe";

class StressGateTest : public JudgeTest {
 protected:
  StressGateTest() {
    checks_ = {Check::counters, Check::stress};
    request_.checks = {Check::stress};
    request_.expectations = [this](const record::Record& record) { return expected_(record); };
  }

  void accept_scores(const std::string& run) {
    AcceptRequest request;
    request.plan = plan;
    request.reason = "a test";
    request.date = "2026-02-01";
    request.truth = [this](const record::Record& record) { return request_.truth(record).truth; };
    request.stress = {.truth = request_.truth, .expectations = request_.expectations};
    (void)accept(store_, run, folder_.path() / "baselines", request);
  }

  // Returns a change of one configuration on one device.
  static Tweak on_lavapipe(const std::function<void(record::Record&, core::Image&)>& change) {
    return [change](record::Record& record, core::Image& image) {
      if (record.device == stress_device && record.configuration == plain_) change(record, image);
    };
  }

  // Accepts an unchanged run, judges a second run with the change, and returns the only finding
  // about it.
  Finding stress_finding(const Tweak& tweak) {
    add_run("accepted");
    accept_scores("accepted");
    add_run("judged", tweak);
    Finding result;
    for (const Finding& finding : gate("judged").findings) {
      const bool about = finding.device == stress_device && finding.configuration == plain_;
      if (about && finding.check == Check::stress) result = finding;
    }
    return result;
  }

  // Expects that each image equals an image with skip=distance, which no run contains.
  void expect_equality_with_absent_configuration() {
    expected_ = [](const record::Record&) {
      return std::vector<record::Expectation>{
          {"the bits with another skip", record::SameImage{.changed = {{"skip", "distance"}}}}};
    };
  }

  std::function<std::vector<record::Expectation>(const record::Record&)> expected_ =
      [](const record::Record&) { return std::vector<record::Expectation>{}; };
};

TEST_F(StressGateTest, AllPointsPass) {
  add_run("a");
  accept_scores("a");
  const GateResult result = gate("a");
  EXPECT_EQ(result.exit_code(), core::ExitCode::pass) << text(result);
  const auto passed = with(result, Verdict::pass, Check::stress);
  ASSERT_EQ(passed.size(), 12U);
  EXPECT_EQ(passed[0].numbers.at("score"), 3);
}

TEST_F(StressGateTest, AnImageBeyondItsBoundLosesTwoPoints) {
  const Finding finding = stress_finding(
      on_lavapipe([](record::Record&, core::Image& image) { image.rgba[17] += 2 * bound; }));
  EXPECT_EQ(finding.verdict, Verdict::regression);
  EXPECT_EQ(finding.numbers.at("score"), 1);
  EXPECT_TRUE(has_cause(finding.because, Cause::pixels_over_bound));
  EXPECT_TRUE(has_cause(finding.because, Cause::farther_device));
}

TEST_F(StressGateTest, WithinTheBoundOnlyAgreementIsLost) {
  const Finding finding = stress_finding(on_lavapipe([](record::Record&, core::Image& image) {
    for (float& value : image.rgba) value += bound / 2;
  }));
  EXPECT_EQ(finding.verdict, Verdict::regression);
  EXPECT_EQ(finding.numbers.at("score"), 2);
  EXPECT_TRUE(has_cause(finding.because, Cause::farther_device));
}

// The other devices are closer to the reference image, so they must not lose a point because of the
// device that differs.
TEST_F(StressGateTest, TheDeviceCloserToTheReferenceKeepsItsPoint) {
  (void)stress_finding(on_lavapipe([](record::Record&, core::Image& image) {
    for (float& value : image.rgba) value += bound / 2;
  }));
  EXPECT_EQ(with(gate("judged"), Verdict::regression).size(), 1U);
}

TEST_F(StressGateTest, NonFinitePixelsScoreZero) {
  const Finding finding = stress_finding(
      on_lavapipe([](record::Record&, core::Image& image) { image.rgba[3] = std::nanf(""); }));
  EXPECT_EQ(finding.verdict, Verdict::regression);
  EXPECT_EQ(finding.numbers.at("score"), 0);
}

TEST_F(StressGateTest, ACrashScoresZeroAndIsReportedOnce) {
  const Finding finding = stress_finding(on_lavapipe([](record::Record& record, core::Image&) {
    record.outcome = record::Outcome::crashed;
    record.reason = {.cause = record::Cause::signal, .numbers = {{"signal", 11}}};
  }));
  EXPECT_EQ(finding.numbers.at("score"), 0);
  EXPECT_TRUE(has_cause(finding.because, Cause::ended));
  EXPECT_EQ(finding.reason.number("signal"), 11);
  EXPECT_EQ(with(gate("judged"), Verdict::regression).size(), 1U);
}

TEST_F(StressGateTest, AnAcceptedLossIsStillShown) {
  const Tweak wrong =
      on_lavapipe([](record::Record&, core::Image& image) { image.rgba[17] += 2 * bound; });
  add_run("a", wrong);
  accept_scores("a");
  add_run("b", wrong);
  const auto known = with(gate("b"), Verdict::advisory, Check::stress);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known[0].numbers.at("accepted"), 1);
  add_run("c");
  EXPECT_EQ(with(gate("c"), Verdict::improved, Check::stress).size(), 1U);
}

TEST_F(StressGateTest, ANewDeviceIsComparedWithAcceptedDevices) {
  add_run("a", [](record::Record& record, core::Image&) {
    if (record.device == stress_device) record.outcome = record::Outcome::skipped;
  });
  accept_scores("a");
  add_run("b", on_lavapipe([](record::Record&, core::Image& image) { image.rgba[17] += 1; }));
  EXPECT_EQ(with(gate("b"), Verdict::regression, Check::stress).size(), 1U);
}

TEST_F(StressGateTest, WithoutAStoredScoreThereIsNoVerdict) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_EQ(with(gate("a"), Verdict::cannot_judge, Check::stress).size(), 12U);
}

TEST_F(StressGateTest, ASelectedDeviceIsComparedWithTheOthersOfTheRun) {
  (void)stress_finding(on_lavapipe([](record::Record&, core::Image& image) {
    for (float& value : image.rgba) value += bound / 2;
  }));
  GateRequest request = request_;
  request.devices = {stress_device};
  const auto lost = with(gate("judged", request), Verdict::regression, Check::stress);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].device, stress_device);
}

TEST_F(StressGateTest, ARefusalIsCorrectOnlyIfItIsAllowed) {
  const Tweak refuse = on_lavapipe([](record::Record& record, core::Image&) {
    record.outcome = record::Outcome::skipped;
    record.reason = {.cause = record::Cause::not_supported, .detail = "too large"};
  });
  const Finding finding = stress_finding(refuse);
  EXPECT_EQ(finding.verdict, Verdict::cannot_judge);  // the accepted run drew it
  EXPECT_TRUE(finding.numbers.empty());               // no score now
  expected_ = [](const record::Record&) {
    return std::vector<record::Expectation>{{"may be refused", record::MayBeRefused{}}};
  };
  EXPECT_EQ(with(gate("judged"), Verdict::pass, Check::stress).size(), 12U);
}

// The images with and without brick skipping must be bit-identical, even if the error bound would
// permit a difference.
TEST_F(StressGateTest, DifferentBitsLoseAPoint) {
  expected_ = [](const record::Record& record) {
    std::vector<record::Expectation> result;
    if (record.configuration.find("skip=") == std::string::npos) {
      result.push_back(
          {"the bits with bricks", record::SameImage{.changed = {{"skip", "bricks"}}}});
    }
    return result;
  };
  const Finding finding = stress_finding(on_lavapipe([](record::Record&, core::Image& image) {
    image.rgba[5] = std::nextafter(image.rgba[5], 1.0F);
  }));
  EXPECT_EQ(finding.verdict, Verdict::regression);
  EXPECT_EQ(finding.numbers.at("score"), 2);
  ASSERT_EQ(finding.because.size(), 1U);
  EXPECT_EQ(finding.because[0].cause, Cause::pixels_differ);
  EXPECT_EQ(finding.because[0].against, Against::expectation);
  EXPECT_EQ(finding.because[0].number("pixels_differing"), 1);
  EXPECT_EQ(finding.because[0].number("x"), 1);
}

// If a plan is divided into shards, two configurations whose images are to be compared can be in
// different shards. The missing image must not cost a point in the gate of a single shard.
TEST_F(StressGateTest, APartOfAPlanNeedsNoOtherImages) {
  add_run("a");
  accept_scores("a");
  expect_equality_with_absent_configuration();
  EXPECT_EQ(with(gate("a"), Verdict::regression, Check::stress).size(), 12U);
  request_.part = true;
  EXPECT_EQ(with(gate("a"), Verdict::pass, Check::stress).size(), 12U);
}

// If a run was interrupted, the missing configuration is reported, and costs no other configuration
// a point.
TEST_F(StressGateTest, AnInterruptedRunLosesNoPointsForImagesThatAreStillMissing) {
  add_run("a");
  accept_scores("a");
  expect_equality_with_absent_configuration();
  std::vector<std::string> planned;
  for (const record::Record& record : store_.records("a")) planned.push_back(record.configuration);
  store_.begin("a", {}, planned);
  EXPECT_EQ(with(gate("a"), Verdict::regression, Check::stress).size(), 12U);
  planned.push_back("camera=side,data=ball,skip=distance,technique=raycast");
  store_.begin("a", {}, planned);
  const GateResult result = gate("a");
  EXPECT_EQ(with(result, Verdict::pass, Check::stress).size(), 12U);
  EXPECT_EQ(result.exit_code(), core::ExitCode::cannot_judge) << text(result);
}

TEST_F(StressGateTest, MoreSamplesThanAllowedLoseAPoint) {
  expected_ = [](const record::Record&) {
    return std::vector<record::Expectation>{
        {"few", record::CountAtMost{.counter = "samples", .factor = 20834, .of = "rays"}}};
  };
  const Finding finding = stress_finding(on_lavapipe(
      [](record::Record& record, core::Image&) { record.counters["samples"] = 1000033; }));
  EXPECT_EQ(finding.verdict, Verdict::regression);
  ASSERT_EQ(finding.because.size(), 1U);
  EXPECT_EQ(finding.because[0].cause, Cause::count_too_large);
  EXPECT_EQ(finding.because[0].number("count"), 1000033);
  EXPECT_EQ(finding.because[0].number("unit"), 48);
  EXPECT_EQ(with(gate("judged"), Verdict::regression).size(), 1U);
}

TEST_F(StressGateTest, OnlyStressPlansAreJudgedByDefault) {
  add_run("a");
  accept_scores("a");
  GateRequest default_request = request_;
  default_request.checks.clear();
  EXPECT_EQ(with(gate("a", default_request), Verdict::pass, Check::stress).size(), 12U);
  checks_ = {};
  add_run("b");
  for (const Finding& finding : gate("b", default_request).findings) {
    EXPECT_NE(finding.check, Check::stress);
  }
}

// Tests expectations in isolation, with two configurations of one device.
class ExpectationTest : public JudgeTest {
 protected:
  static constexpr int width = 3;
  static constexpr int height = 2;

  const record::Record& add(const std::string& configuration, const core::Image& image) {
    record::Record record;
    record.device = "gl:x";
    record.configuration = configuration;
    const auto bytes = core::encode_exr(image);
    record.image = core::content_hash(bytes);
    store_.add_image(record.image, bytes);
    records_.push_back(record);
    return records_.back();
  }

  // Returns an image whose values are a function of the position and the channel.
  static core::Image make_image(int w, int h, const std::function<float(int, int)>& at) {
    core::Image image(w, h);
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        for (int c = 0; c < 4; ++c) {
          image.rgba[static_cast<std::size_t>(4 * (y * w + x) + c)] =
              at(x, y) + 0.125F * static_cast<float>(c);
        }
      }
    }
    return image;
  }

  // Judges the image of the first record by this rule. Returns an observation that states why the
  // rule is not met. If it is met, the cause of the observation is Cause::none.
  Observation judge(const record::SameImage& rule) {
    StressRun run(store_, records_);
    const auto observation =
        violation_of({"a test", rule}, records_.front(), run, [](const record::Record&) {
          TruthPair pair{core::Image(width, height), core::Image(width, height)};
          for (float& value : pair.bound.rgba) value = 0.25F;
          return pair;
        });
    return observation.value_or(Observation{});
  }
  // Returns the number of pixels that differ.
  double differing_pixels(const record::SameImage& rule) {
    return judge(rule).number("pixels_differing");
  }

  std::vector<record::Record> records_;
};

float position_value(int x, int y) {
  return static_cast<float>(x + 10 * y);
}

TEST_F(ExpectationTest, AMirrorImageMatchesOnlyAlongItsAxis) {
  add("data=a", make_image(width, height, position_value));
  add("data=b",
      make_image(width, height, [](int x, int y) { return position_value(width - 1 - x, y); }));
  add("data=c", make_image(width, height, [](int x, int y) {
        return position_value(width - 1 - x, height - 1 - y);
      }));
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}, .mirrored_x = true}), 0);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "c"}}, .mirrored_x = true, .mirrored_y = true}),
            0);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}}), 4);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "c"}}, .mirrored_x = true}), 6);
}

TEST_F(ExpectationTest, APartIsComparedAtItsPosition) {
  add("data=a",
      make_image(width, height, [](int x, int y) { return position_value(x + 2, y + 1); }));
  add("data=b", make_image(6, 5, position_value));
  EXPECT_EQ(judge({.changed = {{"data", "b"}}, .at = {2, 1}}).cause, Cause::none);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}, .at = {1, 1}}), 6);
  EXPECT_EQ(judge({.changed = {{"data", "b"}}, .at = {4, 1}}).cause, Cause::not_inside);
  EXPECT_EQ(judge({.changed = {{"data", "z"}}}).cause, Cause::no_other_image);
}

TEST_F(ExpectationTest, BoundsOfBothAddUp) {
  add("data=a", make_image(width, height, position_value));
  add("data=b",
      make_image(width, height, [](int x, int y) { return position_value(x, y) + 0.5F; }));
  add("data=c",
      make_image(width, height, [](int x, int y) { return position_value(x, y) + 0.75F; }));
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}, .bit_identical = false}), 0);
  EXPECT_EQ(judge({.changed = {{"data", "c"}}, .bit_identical = false}).fact("by"), "bounds");
}

TEST_F(ExpectationTest, ParticlesMayHaveOtherNumbers) {
  core::Image image = make_image(width, height, position_value);
  image.depth.assign(6, 2.0F);
  image.ids = {0, 1, 2, 3, 4, 5};
  core::Image other = image;
  other.ids = {5, 4, 3, 2, 1, 0};
  add("data=a", image);
  add("data=b", other);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}, .compare_ids = false}), 0);
  EXPECT_EQ(differing_pixels({.changed = {{"data", "b"}}}), 6);
}

TEST_F(ExpectationTest, OneColourMustMatchExactly) {
  core::Image image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 1.0F : 0.25F;
  add("data=a", image);
  image.rgba[21] = std::nextafter(0.25F, 1.0F);
  add("data=b", image);
  StressRun run(store_, records_);
  const record::Expectation expected{"a test", record::UniformColour{{0.25F, 0.25F, 0.25F, 1.0F}}};
  EXPECT_FALSE(violation_of(expected, records_[0], run, {}));
  const auto wrong = violation_of(expected, records_[1], run, {});
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->number("x"), 2);
  EXPECT_EQ(wrong->number("y"), 1);
  EXPECT_EQ(wrong->number("channel"), 1);
}

}  // namespace
}  // namespace triptych::judge
