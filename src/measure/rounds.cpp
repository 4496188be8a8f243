#include "measure/rounds.hpp"

#include <algorithm>
#include <limits>

#include "measure/clock.hpp"

namespace triptych::measure {
namespace {

double doubt(const record::Record& record) {
  return record.round_gap().value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

bool is_settled(const record::Record& record) {
  return record.rounds_ns.size() >= least_rounds && doubt(record) <= settled_gap;
}

bool add_round(record::Record& record, const Turn& turn) {
  const bool by_device = record.clock() == "device";
  if (by_device && !plausible(turn.device_ns, turn.wall_ns)) return false;
  const auto summary = record::summarise(by_device ? turn.device_ns : turn.wall_ns);
  if (!summary) return false;
  const bool quietest =
      record.rounds_ns.empty() || summary->median < *std::ranges::min_element(record.rounds_ns);
  record.rounds_ns.push_back(summary->median);
  if (!quietest) return true;
  record.wall_ns = turn.wall_ns;
  record.device_ns = turn.device_ns;
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
