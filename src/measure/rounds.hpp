#pragma once
// Further rounds over what was measured once. On a shared machine whatever runs beside slows a
// configuration for seconds, so that all its frames agree and are all wrong; the least of several
// rounds' medians, a pass over the plan apart, is what the device can do (docs/how-we-measure.md).

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "measure/wire.hpp"
#include "record/record.hpp"

namespace triptych::measure {

// Settled: the two quietest of at least four rounds agree to this, as ln of a ratio.
inline constexpr std::size_t least_rounds = 4;
inline constexpr double settled_gap = 0.02;
[[nodiscard]] bool is_settled(const record::Record& record);

// The median of a pass of timed frames by the record's clock; nullopt where that is the device's
// and it told no plausible time.
[[nodiscard]] std::optional<double> median_by_clock(const record::Record& record, const Turn& pass);

// Whether a pass was as fast as the record's fastest round, to what settles it: nothing more is to
// be learnt in its round. Not where it was faster than that: then it is the first to have been.
[[nodiscard]] bool sees_again(const record::Record& record, const Turn& pass);

// One more round of a measured record: the least median of its passes, and, where no round's was
// less, that pass's times. False where no pass has a median by the record's clock: nothing is added
// then.
bool add_round(record::Record& record, std::span<const Turn> passes);

// How the records that a further round measures are ordered.
enum class RoundOrder { as_measured, doubtful_first };

// Indices of the measured records that are neither settled nor had `most` rounds. Doubtful is what
// has the largest gap between its two quietest rounds, before that what had one round only.
[[nodiscard]] std::vector<std::size_t> next_round(std::span<const record::Record> records,
                                                  std::size_t most, RoundOrder order);

}  // namespace triptych::measure
