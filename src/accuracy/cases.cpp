#include "accuracy/cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "accuracy/image_metrics.hpp"
#include "record/factor_list.hpp"

namespace triptych::accuracy {
namespace {

// Returns the factor list `scene` ("camera=…,data=…,step=…") without the step, and without the
// levels that `other` does not contain.
std::string common_levels(std::string_view scene, std::string_view other) {
  const auto known = record::parse_factor_list(other);
  auto kept = record::parse_factor_list(scene);
  std::erase_if(kept, [&](const auto& level) {
    const auto same = known.find(level.first);
    return level.first == "step" || same == known.end() || same->second != level.second;
  });
  return record::factor_list(kept);
}

double root_mean_square(const std::vector<float>& values) {
  double squares = 0;
  for (const float value : values)
    squares += static_cast<double>(value) * static_cast<double>(value);
  return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

// Returns the total size of all buffers and images, in bytes. `memory` also contains the bytes that
// a frame uploads, under the key "moved" (measure/contract/memory_ledger.hpp); they are not
// included.
std::uint64_t allocated_bytes(const record::Counts& memory) {
  std::uint64_t bytes = 0;
  for (const auto& [kind, bytes_of_kind] : memory) bytes += kind == "moved" ? 0 : bytes_of_kind;
  return bytes;
}

// Returns the sum of the energies from all meters, which measure separate parts of the system
// (measure/system/energy_meters.hpp).
double joules_of(const record::Counts& microjoules) {
  double sum = 0;
  for (const auto& [meter, energy] : microjoules) sum += static_cast<double>(energy);
  return sum * 1e-6;
}

core::Image in_eight_bits(core::Image image) {
  for (float& value : image.rgba) {
    value = std::round(std::clamp(value, 0.0F, 1.0F) * 255.0F) / 255.0F;
  }
  return image;
}

}  // namespace

std::optional<LimitErrors> limit_errors(const core::Image& image, const core::Image& truth,
                                        const core::Image& limit) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  const ImageComparison comparison = compare(image, limit, unbounded);
  const double arithmetic = accuracy::root_mean_square(image, truth);
  const double lattice = accuracy::root_mean_square(truth, limit);
  if (comparison.size_mismatch || comparison.non_finite > 0 || comparison.pixels == 0 ||
      !std::isfinite(arithmetic) || !std::isfinite(lattice)) {
    return std::nullopt;
  }
  return LimitErrors{comparison.rmse, comparison.largest.error, comparison.error_99, lattice,
                     arithmetic};
}

AccuracyCase accuracy_case(const record::Record& record, const LimitErrors& error,
                           std::string_view clock) {
  const auto summary = record::summarise(record.time_ns_by(clock));
  AccuracyCase result{.configuration = record.configuration,
                      .factors = record.factors,
                      .time_ns = summary ? std::optional(summary->median) : std::nullopt,
                      .samples = {},
                      .instructions = record.instructions(),
                      .fetched = record.fetched_bytes(),
                      .memory = {},
                      .joules = {},
                      .rmse = error.rmse,
                      .largest = error.largest,
                      .error_99 = error.error_99,
                      .lattice = error.lattice,
                      .arithmetic = error.arithmetic};
  const auto samples = record.counters.find("samples");
  if (samples != record.counters.end()) result.samples = samples->second;
  if (!record.memory.empty()) result.memory = allocated_bytes(record.memory);
  if (!record.energy.empty()) result.joules = joules_of(record.energy);
  return result;
}

AccuracyScene accuracy_scene(const record::Record& record, const LimitImage& limit) {
  AccuracyScene scene;
  scene.device = record.device;
  scene.limit = limit.key;
  scene.scene = common_levels(record.scene, record.scene);
  const auto data = record.factors.find("data");
  if (data != record.factors.end()) scene.data = data->second;
  scene.uncertainty = root_mean_square(limit.uncertainty.rgba);
  if (limit.closed_form) {
    scene.representation = accuracy::root_mean_square(limit.image, *limit.closed_form);
  }
  scene.eight_bit_error = accuracy::root_mean_square(in_eight_bits(limit.image), limit.image);
  scene.empty_image_error = root_mean_square(limit.image.rgba);
  return scene;
}

void keep_common_levels(AccuracyScene& scene, const record::Record& record) {
  scene.scene = common_levels(scene.scene, record.scene);
}

void evaluate(AccuracyScene& scene) {
  scene.families = accuracy_families(scene.cases);
  scene.front = pareto_front(scene.cases);
  scene.dominated = dominated(scene.cases, scene.front);
  scene.area = front_area(scene.cases, scene.front, scene.empty_image_error);
}

}  // namespace triptych::accuracy
