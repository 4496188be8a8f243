#include "accuracy/ray_history.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace triptych::accuracy {
namespace {

constexpr double tolerance = 1e-4;

AllowedRange range_around(double value) {
  return {value, value - tolerance, value + tolerance};
}

// Returns a ray with four samples of opacity ¼ along x, two voxels apart. The last sample covers
// half a step.
ExpectedRay four_samples() {
  ExpectedRay ray{.entry = {1, 5, 5}, .stride = {2, 0, 0}, .samples = {}, .ends_below = 0.001};
  for (int i = 0; i < 4; ++i) {
    const double length = i == 3 ? 1 : 2;
    ray.samples.push_back(
        {.index = i,
         .position = {range_around(1 + 2 * (i + 0.5)), range_around(5), range_around(5)},
         .front = {},
         .value = range_around(0.5),
         .colour = {range_around(0.25), range_around(0.5), range_around(1)},
         .alpha = range_around(0.125),
         .length = range_around(length),
         .opacity = range_around(0.125 * length)});
  }
  return ray;
}

// Returns what a correct device would record.
std::vector<TakenSample> taken_from(const ExpectedRay& ray) {
  std::vector<TakenSample> samples;
  TakenSample sample{.transmittance = 1};
  for (const ExpectedSample& expected : ray.samples) {
    sample.position = {expected.position[0].value, expected.position[1].value,
                       expected.position[2].value};
    sample.value = expected.value.value;
    sample.alpha = expected.alpha->value;
    sample.length = expected.length.value;
    sample.opacity = expected.opacity.value;
    const double weight = sample.transmittance * sample.opacity;
    for (std::size_t k = 0; k < 3; ++k) {
      sample.colour[k] = expected.colour[k].value;
      sample.accumulated[k] += weight * sample.colour[k];
    }
    sample.transmittance -= weight;
    samples.push_back(sample);
  }
  return samples;
}

TEST(RayHistory, HasNoDifferenceForWhatIsExpected) {
  const ExpectedRay ray = four_samples();
  const RayHistory history = compare(ray, taken_from(ray));
  EXPECT_EQ(history.first, std::nullopt);
  ASSERT_EQ(history.rows.size(), 4);
  for (const SampleRow& row : history.rows) EXPECT_TRUE(row.expected && row.taken);
}

// Changes one operation at a time in sample 2. The history must name the changed operation as the
// first that differs.
TEST(RayHistory, NamesTheFirstOperationThatDiffers) {
  const ExpectedRay ray = four_samples();
  const auto changed = [&](auto change) {
    std::vector<TakenSample> taken = taken_from(ray);
    change(taken[2]);
    const RayHistory history = compare(ray, taken);
    EXPECT_EQ(history.first, 2);
    return history.rows[2].differs.value();
  };
  const double off = 3 * tolerance;
  EXPECT_EQ(changed([&](TakenSample& s) { s.position[1] += off; }), Operation::position);
  EXPECT_EQ(changed([&](TakenSample& s) { s.value += off; }), Operation::value);
  EXPECT_EQ(changed([&](TakenSample& s) { s.alpha -= off; }), Operation::alpha);
  EXPECT_EQ(changed([&](TakenSample& s) { s.colour[2] -= off; }), Operation::colour);
  EXPECT_EQ(changed([&](TakenSample& s) { s.length += off; }), Operation::length);
  EXPECT_EQ(changed([&](TakenSample& s) { s.opacity += off; }), Operation::opacity);
  EXPECT_EQ(changed([&](TakenSample& s) { s.transmittance += 1e-5; }), Operation::compositing);
  EXPECT_EQ(changed([&](TakenSample& s) { s.accumulated[0] += 1e-5; }), Operation::compositing);
}

TEST(RayHistory, DistinguishesMissingFromTransparentSamples) {
  ExpectedRay ray = four_samples();
  std::vector<TakenSample> taken = taken_from(ray);
  taken.erase(taken.begin() + 1);
  // The later samples do not differ, because each comparison continues from the light that the
  // device recorded.
  RayHistory history = compare(ray, taken);
  EXPECT_EQ(history.first, 1);
  EXPECT_EQ(history.rows[1].differs, Operation::sampling);
  EXPECT_FALSE(history.rows[1].taken);

  ray.samples[1].opacity = {0, 0, 0};
  history = compare(ray, taken);
  EXPECT_FALSE(history.rows[1].differs);
}

TEST(RayHistory, FindsSamplesBeyondTheEndAndTakenTwice) {
  const ExpectedRay ray = four_samples();
  std::vector<TakenSample> taken = taken_from(ray);
  taken.push_back(taken.back());
  taken.back().position[0] += 2;
  EXPECT_EQ(compare(ray, taken).first, 4);
  taken = taken_from(ray);
  taken.insert(taken.begin() + 2, taken[1]);
  EXPECT_EQ(compare(ray, taken).rows[2].differs, Operation::sampling);
}

// A ray may end early only if hardly any light is left.
TEST(RayHistory, AllowsARayToEndOnlyWithLittleLightLeft) {
  ExpectedRay ray = four_samples();
  std::vector<TakenSample> taken = taken_from(ray);
  taken.resize(2);
  EXPECT_EQ(compare(ray, taken).first, 2);
  ray.ends_below = taken.back().transmittance + 0.01;
  EXPECT_EQ(compare(ray, taken).first, std::nullopt);
}

TEST(RayHistory, DoesNotCompareMergedSamples) {
  ExpectedRay ray = four_samples();
  ray.merges = true;
  std::vector<TakenSample> taken = taken_from(ray);
  taken.erase(taken.begin() + 1, taken.begin() + 3);
  taken[0].position[0] += 1;  // the middle of three merged steps
  taken[0].length = 6;
  const RayHistory history = compare(ray, taken);
  EXPECT_EQ(history.first, 3) << "the light after the last sample is that of another ray";
  EXPECT_FALSE(history.rows[0].compared);
}

}  // namespace
}  // namespace triptych::accuracy
