#pragma once
// Decides from interleaved A/B measurements whether one side is slower. These are plain functions
// of the differences d of ln t between side b and side a, with one d for each block of batches
// (measure/run/interleaved.hpp). d > 0 means that b is slower.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace triptych::comparison {

// Wilcoxon's signed-rank test of H₀: the differences are symmetric about `shift`. Differences that
// equal the shift are left out; ties share their mean rank.
struct SignedRank {
  std::size_t n = 0;     // number of differences that count
  double statistic = 0;  // V: sum of the ranks of those above the shift
  double p_greater = 1;  // P(V or more) under H₀: small if they lie above the shift
  double p_less = 1;     // P(V or less)
};
// Exact up to this number of differences (conditional on the ties); beyond it the normal
// approximation with corrections for ties and continuity.
inline constexpr std::size_t most_for_exact = 25;
[[nodiscard]] SignedRank wilcoxon_signed_rank(std::span<const double> differences,
                                              double shift = 0);

struct Interval {
  double low = 0;
  double high = 0;
  [[nodiscard]] double half_width() const { return (high - low) / 2; }
};

// Hodges and Lehmann's estimate of the centre, which is the median of the Walsh averages
// (dᵢ + dⱼ)/2 with i ≤ j, and the interval of the shifts that the test does not reject at the
// one-sided level `tail`. The interval is infinite if there are too few differences to reject
// anything. NaN without differences.
struct Shift {
  double estimate = 0;
  Interval interval;
};
[[nodiscard]] Shift estimate_shift(std::span<const double> differences, double tail);

enum class PairVerdict : std::uint8_t {
  slower,  // b is slower than a by more than is tolerated
  faster,
  same,      // no difference in either direction that is large enough to matter
  undecided  // more blocks may decide
};
[[nodiscard]] std::string_view name_of(PairVerdict verdict);

// A group-sequential test. It evaluates the result after fixed numbers of blocks, which are called
// looks. Each look uses an equal share of `alpha` (Bonferroni), so that the probability of an error
// on one side is at most `alpha` for all looks together.
struct SequentialDesign {
  std::array<int, 6> looks{12, 24, 48, 96, 192, 384};
  double alpha = 0.01;
  double tolerated = 0;  // τ₀: a shift up to this size is tolerated
  double caught = 0;     // τ₁: a shift of this size or more must be found

  // τ₀ = ln 1.01, τ₁ = ln 1.03
  [[nodiscard]] static SequentialDesign standard();
  [[nodiscard]] double alpha_of_a_look() const { return alpha / static_cast<double>(looks.size()); }
  // The next look after this number of blocks; 0 after the last one.
  [[nodiscard]] int next_look(int blocks) const;
};

// slower: θ ≤ τ₀ is rejected. faster: θ ≥ −τ₀ is rejected. same: both θ ≥ τ₁ and θ ≤ −τ₁ are
// rejected. The interval contains the exact shift at all looks together with a probability of at
// least 1 − 2·alpha.
struct Look {
  PairVerdict verdict = PairVerdict::undecided;
  Shift shift;
};
[[nodiscard]] Look look_at(std::span<const double> differences, const SequentialDesign& design);

// The blocks of one process run agree better than different process runs do (because of memory
// layout and thread placement). The result of one process run is therefore accepted only if new
// process runs confirm it.
struct Suspect {
  std::vector<double> process_runs;  // the estimated shift of each new process run
  bool slower = true;                // otherwise faster: the result of the first process run
};
inline constexpr std::size_t least_process_runs = 2;  // with fewer there is no scatter

// The looks of the confirmation. The second look is for suspects about which the first one does not
// decide. Each look has an equal share of `q`.
struct ConfirmationDesign {
  std::array<std::size_t, 2> looks{5, 10};  // numbers of new process runs
  std::size_t blocks_per_process_run = 24;
  // The expected share of false results among the confirmed ones, for all looks together: each look
  // adds at most its own share to the false discovery rate.
  double q = 0.02;

  [[nodiscard]] double q_of_a_look() const { return q / static_cast<double>(looks.size()); }
};

struct Confirmation {
  PairVerdict verdict = PairVerdict::undecided;  // slower or faster only as suspected
  Shift shift;  // mean of the process runs, with Student's t interval that has the tail probability
                // `q` at each end
  double p = 1;  // p-value of the hypothesis that the shift is not larger than tolerated
};
// Student's t test of the process runs' mean against τ₀, with the variance between process runs
// moderated over the suspects, and the Benjamini–Hochberg procedure at `q` over the suspects. The
// rate holds for all configurations, because the process run that chose the suspects is not used
// for the confirmation, and no other configuration is called slower or faster. A suspect that is
// not confirmed is the same if its interval shows that, and undecided with fewer than
// least_process_runs.
[[nodiscard]] std::vector<Confirmation> confirm(std::span<const Suspect> suspects, double q,
                                                const SequentialDesign& design);

// Measures one more fresh process run, the `number`-th, for each of the suspects `open`, for the
// look after `until`. Returns false if no more runs are possible. After a look has decided about a
// suspect, the suspect is not measured again.
using RunAgain =
    std::function<bool(std::span<const std::size_t> open, std::size_t number, std::size_t until)>;
[[nodiscard]] std::vector<Confirmation> confirm_in_looks(std::vector<Suspect>& suspects,
                                                         const ConfirmationDesign& confirmation,
                                                         const SequentialDesign& design,
                                                         const RunAgain& run_again);

}  // namespace triptych::comparison
