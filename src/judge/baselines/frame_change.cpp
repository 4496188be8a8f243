#include "judge/baselines/frame_change.hpp"

#include <cmath>

#include "judge/baselines/cost_tolerance.hpp"

namespace triptych::judge {
namespace {

void compare(FrameChange& change, std::string_view name, Unit unit, double before, double now,
             double tolerance) {
  if (std::abs(now - before) <= tolerance) return;
  (now > before ? change.increased : change.decreased) = true;
  change.changes.push_back({std::string(name), unit, before, now, {}, tolerance});
}

}  // namespace

std::optional<double> count_of(const record::Counts& counts, std::string_view name) {
  const auto found = counts.find(std::string(name));
  if (found == counts.end()) return std::nullopt;
  return static_cast<double>(found->second);
}

double frame_instructions(const record::Counts& cost) {
  double sum = 0;
  for (const std::string_view part : cost_parts) sum += count_of(cost, part).value_or(0);
  return sum;
}

FrameChange frame_change(const record::Record& now, const record::Counts& before) {
  FrameChange change;
  const double frame = frame_instructions(before);
  for (const std::string_view part : cost_parts) {
    const double stored = count_of(before, part).value_or(0);
    compare(change, part, Unit::instructions, stored, count_of(now.cost, part).value_or(0),
            cost_tolerance(part, now.device, now.technique, stored, frame));
  }
  const auto misses = count_of(before, "misses");
  const auto misses_now = count_of(now.cost, "misses");
  if (misses && misses_now) {
    if (const auto tolerance = misses_tolerance(now.technique, *misses)) {
      compare(change, "misses", Unit::misses, *misses, *misses_now, *tolerance);
    }
  }
  const auto allocations = count_of(before, "allocations");
  const auto allocations_now = count_of(now.cost, "allocations");
  if (!change.changes.empty() && allocations && allocations_now &&
      *allocations != *allocations_now) {
    change.changes.push_back(
        {"allocations", Unit::allocations, *allocations, *allocations_now, {}, 0});
  }
  return change;
}

}  // namespace triptych::judge
