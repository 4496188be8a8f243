#include "accuracy/ray_history.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::accuracy {
namespace {

// Recorded numbers are floats. Numbers that the device computed in single precision are therefore
// exact. Numbers in double precision have been rounded, with a relative error of at most half this
// constant.
constexpr double recording_precision = 0x1.0p-23;

// If less than this share of the light is left, nothing behind is visible. A device may then leave
// out all further samples, or take samples that the reference renderer does not take.
constexpr double invisible = 0x1.0p-60;

bool is_within(double number, const AllowedRange& allowed) {
  const double slack = recording_precision * std::max(std::abs(allowed.lo), std::abs(allowed.hi));
  return number >= allowed.lo - slack && number <= allowed.hi + slack;
}

// The accumulated light in front of a sample, as the device recorded it.
struct RayLight {
  double transmittance = 1;
  std::array<double, 3> accumulated{};
};

// Returns whether the light after a sample follows from the recorded light before it. The tolerance
// is 4·2⁻²³ of the operands. It exceeds the sum of the rounding errors of one multiplication, one
// addition, and the conversion of the recorded numbers to float.
bool is_composited(const RayLight& before, const TakenSample& taken) {
  const double weight = before.transmittance * taken.opacity;
  const double slack = 4 * recording_precision * before.transmittance;
  bool right = std::abs(taken.transmittance - (before.transmittance - weight)) <= slack;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double added = taken.opacity > 0 ? weight * taken.colour[channel] : 0.0;
    const double sum = before.accumulated[channel] + added;
    const double scale = std::abs(before.accumulated[channel]) + std::abs(added);
    right = right &&
            std::abs(taken.accumulated[channel] - sum) <= 4 * recording_precision * scale + 1e-30;
  }
  return right;
}

std::optional<Operation> first_difference(const ExpectedSample& expected, const TakenSample& taken,
                                          const RayLight& before) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!is_within(taken.position[axis], expected.position[axis])) return Operation::position;
  }
  if (expected.front && !is_within(taken.front, *expected.front)) return Operation::front;
  if (!is_within(taken.value, expected.value)) return Operation::value;
  if (expected.alpha && !is_within(taken.alpha, *expected.alpha)) return Operation::alpha;
  // A sample without opacity may have any colour, and is not shaded.
  for (std::size_t channel = 0; taken.opacity > 0 && channel < 3; ++channel) {
    if (!is_within(taken.colour[channel], expected.colour[channel])) return Operation::colour;
  }
  if (!is_within(taken.length, expected.length)) return Operation::length;
  if (!is_within(taken.opacity, expected.opacity)) return Operation::opacity;
  if (!is_composited(before, taken)) return Operation::compositing;
  return std::nullopt;
}

// Returns the index i of the sample, computed from its position along the ray. The midpoint of a
// whole step is i + ½ steps from the entry point; the middle of a partial step is before that.
std::int64_t index_of(const ExpectedRay& ray, const TakenSample& taken) {
  double along = 0;
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along += (taken.position[axis] - ray.entry[axis]) * ray.stride[axis];
    square += ray.stride[axis] * ray.stride[axis];
  }
  const double steps = square > 0 ? along / square : 0.0;
  if (!std::isfinite(steps) || std::abs(steps) > 1e15) return -1;
  // If the last step is very short, its middle is just above i steps from the entry point. The
  // small addition prevents rounding from yielding the index i − 1.
  return static_cast<std::int64_t>(std::floor(steps + 1e-4));
}

// Returns whether a sample covers more than its own step.
bool is_merged(const ExpectedRay& ray, const TakenSample& taken, std::int64_t index) {
  if (!ray.merges) return false;
  const auto at = static_cast<std::size_t>(std::max<std::int64_t>(index, 0));
  return at >= ray.samples.size() || !is_within(taken.length, ray.samples[at].length);
}

// Compares the samples that a device took, one after the other, with the expected samples.
class RayComparison {
 public:
  explicit RayComparison(const ExpectedRay& ray) : ray_(ray) {}

  void add_sample(const TakenSample& taken) {
    const std::int64_t index = index_of(ray_, taken);
    const bool merged = is_merged(ray_, taken, index);
    const bool in_order = index >= next_ && index < end();
    if (in_order) add_skipped_until(index, merged);
    SampleRow row{
        .expected = {}, .taken = taken, .index = index, .compared = !merged, .differs = {}};
    if (in_order) {
      row.expected = ray_.samples[static_cast<std::size_t>(index)];
      if (!merged) row.differs = first_difference(*row.expected, taken, light_);
    } else if (!merged && light_.transmittance > invisible) {
      row.differs = Operation::sampling;
    }
    add_row(std::move(row));
    light_ = {taken.transmittance, taken.accumulated};
    if (in_order) next_ = index + 1;
    after_merged_ = merged;
  }

  RayHistory finish() {
    // The ray may have ended because of early termination, or with a merged sample that covers the
    // rest of the ray.
    const bool has_ended = light_.transmittance < std::max(ray_.ends_below, invisible);
    add_skipped_until(end(), has_ended || after_merged_);
    return std::move(history_);
  }

 private:
  [[nodiscard]] std::int64_t end() const { return static_cast<std::int64_t>(ray_.samples.size()); }

  // Adds rows for the samples before `index` that the device did not take. A device may leave out
  // samples without opacity, and samples that it merged into another sample.
  void add_skipped_until(std::int64_t index, bool excused) {
    for (; next_ < index; ++next_) {
      const ExpectedSample& expected = ray_.samples[static_cast<std::size_t>(next_)];
      const bool missing = !excused && !after_merged_ && expected.opacity.lo > 0;
      SampleRow row{
          .expected = expected, .taken = {}, .index = next_, .compared = !excused, .differs = {}};
      if (missing) row.differs = Operation::sampling;
      add_row(std::move(row));
    }
  }

  void add_row(SampleRow row) {
    if (row.differs && !history_.first) history_.first = history_.rows.size();
    history_.rows.push_back(std::move(row));
  }

  const ExpectedRay& ray_;
  std::int64_t next_ = 0;
  RayLight light_;
  bool after_merged_ = false;
  RayHistory history_;
};

}  // namespace

std::string_view name_of(Operation operation) {
  switch (operation) {
    case Operation::sampling:
      return "samples taken";
    case Operation::position:
      return "position";
    case Operation::front:
      return "value at the beginning of the step";
    case Operation::value:
      return "interpolated value";
    case Operation::alpha:
      return "opacity from the transfer function";
    case Operation::colour:
      return "colour from the transfer function and shading";
    case Operation::length:
      return "ray length covered by the sample";
    case Operation::opacity:
      return "opacity for this ray length";
    case Operation::compositing:
      return "compositing";
  }
  return "";
}

RayHistory compare(const ExpectedRay& expected, const std::vector<TakenSample>& taken) {
  RayComparison comparison(expected);
  for (const TakenSample& sample : taken) comparison.add_sample(sample);
  return comparison.finish();
}

}  // namespace triptych::accuracy
