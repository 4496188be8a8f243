// Tests the verdicts on pipeline statistics, with a device that reports scripted numbers.

#include "measure/protocol/statistics_calibration.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

using record::StatisticWorth;
using record::Worth;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;
using Calibration = std::map<std::string, StatisticWorth>;

const StatisticWorth exact;

MATCHER_P(Is, worth, "") {
  return arg.worth == worth;
}

// The numbers that Triptych's own counters report for the scene with many small sprites: all
// fragments, and those that are kept because they hit their sphere.
constexpr std::uint64_t all_fragments = 2500;
constexpr std::uint64_t kept_fragments = 2090;

bool is_one_sprite(const Work& work) {
  const auto* particles = std::get_if<ParticleWork>(&work.scene);
  return particles != nullptr && particles->scene.particles->count() == 1;
}

record::Counts exact_counts(const Work& work) {
  for (const technique::Work kind : {technique::Work::compute, technique::Work::draw}) {
    for (const CalibrationScene& scene : calibration_scenes(kind)) {
      const bool same_image = scene.work.technique == work.technique &&
                              is_one_sprite(scene.work) == is_one_sprite(work);
      if (!same_image) continue;
      if (const auto* volume = std::get_if<VolumeWork>(&work.scene);
          volume != nullptr &&
          volume->scene.width != std::get<VolumeWork>(scene.work.scene).scene.width) {
        continue;
      }
      record::Counts counts = scene.expected;
      if (scene.counts_fragments) counts["fragment_invocations"] = all_fragments;
      return counts;
    }
  }
  throw std::logic_error("a work that is no calibration scene");
}

// A function that changes the exact statistics of a frame. `n` is the zero-based number of the
// frame among those of the same work that report statistics.
using Script = std::function<void(const Work&, int n, record::Counts&)>;

class CountingPrepared final : public Prepared {
 public:
  CountingPrepared(Work work, Script script) : work_(std::move(work)), script_(std::move(script)) {}

  Frame frame(Purpose purpose) override {
    Frame frame;
    if (purpose == Purpose::counters) {
      frame.counts = {{"fragments", all_fragments}, {"fragments_kept", kept_fragments}};
    }
    if (purpose == Purpose::statistics) {
      frame.counts = exact_counts(work_);
      script_(work_, frames_++, frame.counts);
    }
    return frame;
  }
  void poison() override {}
  core::Image image() override { return {}; }
  std::string kernel_hash() const override { return "kernel"; }

 private:
  Work work_;
  Script script_;
  int frames_ = 0;
};

class CountingDevice final : public Device {
 public:
  explicit CountingDevice(Script script, std::string lacks = {})
      : script_(std::move(script)), lacks_(std::move(lacks)) {}

  const record::Device& info() const override { return info_; }
  std::optional<std::string> unsupported(const Work& work) const override {
    if (work.technique == lacks_) return "no such stage";
    return std::nullopt;
  }
  VolumePath default_path(const VolumeKind&) const override { return {}; }
  double filter_weight_error(const VolumePath&) const override { return 0; }
  std::unique_ptr<Prepared> prepare(const Work& work) override {
    prepared.push_back(work.technique);
    return std::make_unique<CountingPrepared>(work, script_);
  }

  std::vector<std::string> prepared;

 private:
  record::Device info_;
  Script script_;
  std::string lacks_;
};

Calibration calibration_of(Script script, technique::Work kind = technique::Work::draw) {
  CountingDevice device(std::move(script));
  return calibrate_statistics(device, kind);
}

void count_exactly(const Work&, int, record::Counts&) {}

TEST(Calibration, CorrectNumbersAreExact) {
  const Calibration calibration = calibration_of(count_exactly);
  EXPECT_THAT(calibration, Each(Pair(testing::_, exact)));
  for (const char* const name :
       {"input_assembly_vertices", "input_assembly_primitives", "vertex_invocations",
        "geometry_invocations", "geometry_primitives", "clipping_invocations",
        "clipping_primitives", "fragment_invocations", "tessellation_control_patches",
        "tessellation_evaluation_invocations"}) {
    EXPECT_THAT(calibration, Contains(Key(name)));
  }
  EXPECT_EQ(calibration_of(count_exactly, technique::Work::compute),
            (Calibration{{"compute_invocations", exact}}));
}

TEST(Calibration, TheViewIsNotAMultipleOfPixelBlocks) {
  for (const CalibrationScene& scene : calibration_scenes(technique::Work::draw)) {
    const scene::ParticleScene& drawn = std::get<ParticleWork>(scene.work.scene).scene;
    EXPECT_NE(drawn.width % 4, 0);
    EXPECT_NE(drawn.height % 4, 0);
    if (is_one_sprite(scene.work)) {
      EXPECT_EQ(scene.expected.at("fragment_invocations"), 3300U);
      EXPECT_EQ(scene.expected.at("clipping_primitives"), 2U);
    }
  }
}

TEST(Calibration, PixelsCountedInBlocksAreInflated) {
  const Calibration calibration = calibration_of([](const Work& work, int, record::Counts& counts) {
    counts["fragment_invocations"] = is_one_sprite(work) ? 3536 : 9856;
  });
  const StatisticWorth& worth = calibration.at("fragment_invocations");
  EXPECT_EQ(worth.worth, Worth::inflated);
  EXPECT_NEAR(worth.low, 1.072, 5e-4);
  EXPECT_NEAR(worth.high, 3.942, 5e-4);
  EXPECT_EQ(calibration.at("vertex_invocations"), exact);
}

TEST(Calibration, AConstantMultipleIsProportional) {
  const Calibration calibration = calibration_of(
      [](const Work&, int, record::Counts& counts) { counts["vertex_invocations"] *= 3; });
  EXPECT_EQ(calibration.at("vertex_invocations"),
            (StatisticWorth{.worth = Worth::proportional, .low = 3, .high = 3}));
}

TEST(Calibration, TheCounterThatADriverMatchesIsReported) {
  const auto kept = [](const Work&, int, record::Counts& counts) {
    counts["fragment_invocations"] = kept_fragments;
  };
  EXPECT_EQ(calibration_of(kept).at("fragment_invocations"),
            (StatisticWorth{.worth = Worth::counts, .counter = "fragments_kept"}));
  const Calibration almost = calibration_of([&](const Work& work, int n, record::Counts& counts) {
    kept(work, n, counts);
    if (is_one_sprite(work)) ++counts["fragment_invocations"];
  });
  EXPECT_THAT(almost.at("fragment_invocations"), Is(Worth::differs));
}

TEST(Calibration, ATooLowNumberDiffers) {
  const Calibration calibration = calibration_of([](const Work& work, int, record::Counts& counts) {
    counts["clipping_primitives"] += is_one_sprite(work) ? 1U : 0U;
    if (work.technique == "quad_tess") counts["input_assembly_primitives"] = 0;
    if (!is_one_sprite(work)) counts["clipping_invocations"] -= 1;
  });
  EXPECT_THAT(calibration.at("clipping_primitives"), Is(Worth::inflated));
  EXPECT_THAT(calibration.at("input_assembly_primitives"), Is(Worth::differs));
  EXPECT_THAT(calibration.at("input_assembly_primitives").detail,
              AllOf(HasSubstr("quad_tess"), Not(HasSubstr("quad_screen"))));
  EXPECT_THAT(calibration.at("clipping_invocations"), Is(Worth::differs));
}

TEST(Calibration, ADifferentNumberInTheSecondFrameIsUnsteady) {
  const Calibration calibration = calibration_of([](const Work&, int n, record::Counts& counts) {
    counts["input_assembly_vertices"] *= static_cast<std::uint64_t>(n) + 1;
  });
  EXPECT_THAT(calibration.at("input_assembly_vertices"), Is(Worth::unsteady));
}

TEST(Calibration, MissingStatisticsAreAbsentAndIntermittentOnesDiffer) {
  const Calibration calibration = calibration_of([](const Work& work, int, record::Counts& counts) {
    counts.erase("geometry_primitives");
    if (!is_one_sprite(work)) counts.erase("vertex_invocations");
  });
  EXPECT_THAT(calibration.at("geometry_primitives"), Is(Worth::absent));
  EXPECT_THAT(calibration.at("vertex_invocations"), Is(Worth::differs));
}

TEST(Calibration, ADeviceWithoutStatisticsIsQueriedOnce) {
  CountingDevice device([](const Work&, int, record::Counts& counts) { counts.clear(); });
  EXPECT_THAT(calibrate_statistics(device, technique::Work::draw), IsEmpty());
  EXPECT_EQ(device.prepared.size(), 1U);
}

TEST(Calibration, AMissingStageIsNotJudged) {
  CountingDevice device(count_exactly, "quad_screen");
  const Calibration calibration = calibrate_statistics(device, technique::Work::draw);
  EXPECT_THAT(calibration, Not(Contains(Key("geometry_primitives"))));
  EXPECT_THAT(calibration, Contains(Pair("tessellation_control_patches", exact)));

  CountingDevice none(count_exactly, "raycast");
  EXPECT_THAT(calibrate_statistics(none, technique::Work::compute), IsEmpty());
}

TEST(Calibration, AnErrorGivesNoCalibration) {
  const auto failing = [](const Work& work, int, record::Counts&) {
    if (work.technique == "quad_tess") throw core::Error("the driver refuses");
  };
  const Calibration calibration = calibration_of(failing);
  EXPECT_THAT(calibration.at("vertex_invocations"), Is(Worth::unknown));
  EXPECT_THAT(calibration.at("vertex_invocations").detail, HasSubstr("the driver refuses"));
  EXPECT_EQ(calibration.at("geometry_primitives"), exact);

  EXPECT_THROW(static_cast<void>(calibration_of([](const Work&, int, record::Counts&) {
                 throw core::DeviceLost("draw", "LOST");
               })),
               core::DeviceLost);
}

}  // namespace
}  // namespace triptych::measure
