// Tests the stress cases for volumes. Each case is a valid scene, the plan contains all cases, and
// their reference images show the features under test.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "core/error.hpp"
#include "measure/plan/plan.hpp"
#include "reference/volume.hpp"
#include "suites/volume/stress_cases.hpp"
#include "suites/volume/suite.hpp"
#include "suites/volume/tolerance.hpp"

namespace triptych::volume_suite {
namespace {

std::vector<std::string> all_data() {
  std::vector<std::string> names;
  for (const StressCase& each : stress_cases()) {
    if (each.variants.empty()) names.push_back(name_of({&each, {}}));
    for (const std::string_view variant : each.variants) names.push_back(name_of({&each, variant}));
  }
  return names;
}

measure::Configuration configuration(const std::string& data) {
  measure::Configuration result{{"data", data}};
  const auto suite = make_suite({});
  for (const measure::Factor& factor : suite->factors()) {
    result.emplace(factor.name, factor.default_value);
  }
  for (const char* own :
       {"transfer_function", "step", "quadrature", "shading", "ert", "camera", "viewport"}) {
    result[own] = "own";
  }
  return result;
}

accuracy::TruthPair truth_of(const std::string& data) {
  return make_suite({})->truth(configuration(data), {{"filter_weight_error", 0}});
}

// Returns the largest ratio of difference to error bound between an image and its flipped copy.
double largest_ratio(const accuracy::TruthPair& truth, bool flip_x, bool flip_y) {
  double largest = 0;
  for (int y = 0; y < truth.truth.height; ++y) {
    for (int x = 0; x < truth.truth.width; ++x) {
      const auto pixel = truth.truth.pixel(x, y);
      const auto mirrored = truth.truth.pixel(flip_x ? truth.truth.width - 1 - x : x,
                                              flip_y ? truth.truth.height - 1 - y : y);
      const double bound = static_cast<double>(truth.bound.pixel(x, y)[0]);
      for (std::size_t c = 0; c < 4; ++c) {
        largest = std::max(largest, static_cast<double>(std::abs(pixel[c] - mirrored[c])) / bound);
      }
    }
  }
  return largest;
}

TEST(Stress, NumbersAndNamesAreUniqueAndInOrder) {
  std::set<std::string_view> names;
  int last = 0;
  for (const StressCase& each : stress_cases()) {
    EXPECT_GT(each.number, last);
    last = each.number;
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_FALSE(each.expected.empty()) << each.name;
  }
  EXPECT_EQ(stress_cases().size(), 37U);
}

TEST(Stress, ThePlanHasEveryCaseOnce) {
  const auto suite = make_suite({});
  const measure::Plan plan = measure::load_plan(
      "volume/stress", {}, [&](std::string_view) -> measure::Suite& { return *suite; });
  EXPECT_FALSE(plan.timed());
  std::set<std::string> planned;
  for (const measure::Configuration& each : plan.configurations) planned.insert(each.at("data"));
  const std::vector<std::string> all = all_data();
  EXPECT_EQ(planned, std::set<std::string>(all.begin(), all.end()));
}

TEST(Stress, EveryCaseIsValidWithItsExpectations) {
  const std::vector<std::string> all = all_data();
  const auto suite = make_suite({});
  for (const std::string& data : all) {
    SCOPED_TRACE(data);
    const auto known = stress_data(data);
    ASSERT_TRUE(known);
    EXPECT_EQ(name_of(*known), data);
    const StressScene scene = stress_scene(*known);
    EXPECT_EQ(scene.volume.voxels.size(),
              scene.volume.voxel_count() * scene::bytes_of(scene.volume.type));
    EXPECT_EQ(scene.volume.name, data);
    for (const record::Expectation& each : scene.expectations) {
      const auto* same = std::get_if<record::SameImage>(&each.rule);
      if (same == nullptr) continue;
      EXPECT_NE(std::ranges::find(all, same->changed.at("data")), all.end());
      EXPECT_NE(same->changed.at("data"), data);
    }
  }
}

TEST(Stress, UnknownNamesAreRejectedWithTheKnownOnes) {
  EXPECT_FALSE(stress_data("generate:mandelbulb:8"));
  for (const char* wrong :
       {"stress:none", "stress:inside", "stress:inside:out", "stress:prime:1"}) {
    EXPECT_THROW(static_cast<void>(stress_data(wrong)), core::InputError) << wrong;
  }
}

// A vertical flip, a horizontal flip and both flips together must each change the image by far more
// than the bound.
TEST(Stress, TheAsymmetricSceneRevealsEveryFlip) {
  const accuracy::TruthPair truth = truth_of("stress:asymmetric");
  EXPECT_GT(largest_ratio(truth, true, false), 100);
  EXPECT_GT(largest_ratio(truth, false, true), 100);
  EXPECT_GT(largest_ratio(truth, true, true), 100);
}

TEST(Stress, MirroredOctantsHaveMirroredReferenceImages) {
  const accuracy::TruthPair first = truth_of("stress:octant:ppp");
  const accuracy::TruthPair mirrored = truth_of("stress:octant:pmp");
  double largest = 0;
  for (int y = 0; y < first.truth.height; ++y) {
    for (int x = 0; x < first.truth.width; ++x) {
      const auto a = first.truth.pixel(x, y);
      const auto b = mirrored.truth.pixel(first.truth.width - 1 - x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        largest =
            std::max(largest, std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c])));
      }
    }
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_GT(largest_ratio(first, true, false), 100);
}

// The closed-form solution for a ray with n samples is 1 − (1 − 2⁻²⁰)^n, where n follows from the
// length of its chord.
TEST(Stress, FaintSamplesAddUpToTheirClosedForm) {
  const StressScene scene = stress_scene(*stress_data("stress:faint"));
  const accuracy::TruthPair truth = truth_of("stress:faint");
  // The background of the scene is opaque, so the coverage follows from the colour of the pixel.
  const double covered = (static_cast<double>(truth.truth.pixel(1, 1)[0]) - 0.25) / (0.875 - 0.25);
  const double samples = std::log1p(-covered) / std::log1p(-0x1.0p-20);
  EXPECT_NEAR(samples, 3.9 / scene.step_voxels, 0.05 / scene.step_voxels);
}

// The error bounds of these images are so wide that they would not reveal if a third of the samples
// were missing. Each of these scenes must therefore also state how many samples it expects.
TEST(Stress, ScenesOfManySamplesExpectEverySample) {
  for (const std::string data : {"stress:faint", "stress:march:1e5", "stress:march:1e6"}) {
    const StressScene scene = stress_scene(*stress_data(data));
    ASSERT_EQ(scene.expectations.size(), 1U) << data;
    const auto& rule = std::get<record::CountAtMost>(scene.expectations.front().rule);
    EXPECT_EQ(rule.counter, "rays_hit");
    EXPECT_EQ(rule.of, "samples");
    const double least = 1 / rule.factor;
    EXPECT_NEAR(least, 3.875 / scene.step_voxels, 3) << data;
  }
}

// If a case had an empty image, every device would pass it.
TEST(Stress, EveryCaseShowsSomething) {
  for (const std::string& data : all_data()) {
    // Each of these scenes takes a second to draw, and the images of the plan already show that
    // they are not empty.
    if (data.starts_with("stress:march")) continue;
    const StressScene scene = stress_scene(*stress_data(data));
    const bool is_empty = std::ranges::any_of(scene.expectations, [&](const auto& each) {
      const auto* one = std::get_if<record::UniformColour>(&each.rule);
      return one != nullptr && one->rgba == scene.background;
    });
    if (is_empty) continue;
    const accuracy::TruthPair truth = truth_of(data);
    double largest = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double bound = static_cast<double>(truth.bound.pixel(x, y)[0]);
        for (std::size_t c = 0; c < 3; ++c) {
          const double difference = static_cast<double>(truth.truth.pixel(x, y)[c]) -
                                    static_cast<double>(scene.background[c]);
          largest = std::max(largest, std::abs(difference) / bound);
        }
      }
    }
    EXPECT_GT(largest, 2) << data;
  }
}

// A distant eye with a narrow field of view must produce as accurate an image as a nearby eye. If
// the bound were derived from the distance of the eye, it would accept any image.
TEST(Stress, ADistantEyeDoesNotLosePrecision) {
  const auto error_at = [](const char* data) {
    const StressScene stress = stress_scene(*stress_data(data));
    scene::Volume volume = stress.volume;
    const scene::VolumeScene scene{.grid = std::make_shared<const scene::VoxelGrid>(
                                       scene::encode(std::move(volume), scene::VoxelFormat::f32)),
                                   .camera = stress.camera,
                                   .width = stress.width,
                                   .height = stress.height,
                                   .step_voxels = stress.step_voxels};
    return error_model(scene, {}).position_error_voxels;
  };
  EXPECT_LT(error_at("stress:far:1e7"), 2 * error_at("stress:far:1e3"));
  EXPECT_LT(error_at("stress:far:1e7"), 1e-3);
}

// Rounding a ray direction moves samples by a multiple of the smallest voxel spacing, regardless of
// the other spacings.
TEST(Stress, AnisotropicVoxelsUseTheSmallestSpacing) {
  scene::VolumeScene scene;
  scene::VoxelGrid grid;
  grid.size = {8, 8, 8};
  grid.spacing = {1, 1, 1000};
  scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
  scene.width = scene.height = 8;
  scene.camera.eye = {4, 4, 9000};
  EXPECT_GT(error_model(scene, {}).position_error_voxels, 0x1.0p-24 * 25 * 8000);
}

}  // namespace
}  // namespace triptych::volume_suite
