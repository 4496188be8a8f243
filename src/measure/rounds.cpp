#include "measure/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/clock.hpp"

namespace triptych::measure {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double doubt(const record::Record& record) {
  return record.round_gap().value_or(infinite);
}

double least_round(const record::Record& record) {
  return record.rounds_ns.empty() ? infinite : std::ranges::min(record.rounds_ns);
}

}  // namespace

bool is_settled(const record::Record& record) {
  return record.rounds_ns.size() >= least_rounds && doubt(record) <= settled_gap;
}

std::optional<double> median_by_clock(const record::Record& record, const Turn& pass) {
  const bool by_device = record.clock() == "device";
  if (by_device && !plausible(pass.device_ns, pass.wall_ns)) return std::nullopt;
  const auto summary = record::summarise(by_device ? pass.device_ns : pass.wall_ns);
  return summary ? std::optional(summary->median) : std::nullopt;
}

bool sees_again(const record::Record& record, const Turn& pass) {
  const auto median_ns = median_by_clock(record, pass);
  return median_ns && std::abs(std::log(*median_ns / least_round(record))) <= settled_gap;
}

bool add_round(record::Record& record, std::span<const Turn> passes) {
  const Turn* quietest = nullptr;
  double least_ns = infinite;
  for (const Turn& pass : passes) {
    const double median_ns = median_by_clock(record, pass).value_or(infinite);
    if (median_ns >= least_ns) continue;
    least_ns = median_ns;
    quietest = &pass;
  }
  if (quietest == nullptr) return false;
  const bool quieter = least_ns < least_round(record);
  record.rounds_ns.push_back(least_ns);
  if (!quieter) return true;
  record.wall_ns = quietest->wall_ns;
  record.device_ns = quietest->device_ns;
  return true;
}

std::vector<std::size_t> next_round(std::span<const record::Record> records, std::size_t most,
                                    RoundOrder order) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const record::Record& record = records[i];
    const bool timed = record.outcome == record::Outcome::measured && record.same_as.empty() &&
                       !record.rounds_ns.empty();
    if (timed && record.rounds_ns.size() < most && !is_settled(record)) chosen.push_back(i);
  }
  if (order == RoundOrder::doubtful_first) {
    std::ranges::stable_sort(chosen, std::ranges::greater{},
                             [&](std::size_t i) { return doubt(records[i]); });
  }
  return chosen;
}

}  // namespace triptych::measure
