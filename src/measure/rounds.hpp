#pragma once
// Further rounds over what was measured once. On a shared machine whatever runs beside slows a
// configuration for seconds, so that all its frames agree and are all wrong; the least of several
// rounds' medians, a pass over the plan apart, is what the device can do (docs/how-we-measure.md).

#include <cstddef>
#include <span>
#include <vector>

#include "measure/wire.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Settled: the two quietest of at least three rounds agree to this, as ln of a ratio.
inline constexpr std::size_t least_rounds = 3;
inline constexpr double settled_gap = 0.02;
[[nodiscard]] bool is_settled(const record::Record& record);

// One more round of a measured record: its median by the record's clock, and, where that is the
// least, its times. False when the record counts by the device's clock and the device told no
// plausible time: nothing is added then.
bool add_round(record::Record& record, const Turn& turn);

// How the records that a further round measures are ordered.
enum class RoundOrder { as_measured, doubtful_first };

// Indices of the measured records that are neither settled nor had `most` rounds. Doubtful is what
// has the largest gap between its two quietest rounds, before that what had one round only.
[[nodiscard]] std::vector<std::size_t> next_round(std::span<const record::Record> records,
                                                  std::size_t most, RoundOrder order);

}  // namespace triptych::measure
