#pragma once
// Two things measured by interleaved A/B: is one slower than the other? Plain functions of numbers:
// the differences d of ln t between side b and side a, one per block of batches
// (measure/run/interleaved.hpp), so that d > 0 says b is slower.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace triptych::comparison {

// Wilcoxon's test of H₀: the differences are symmetric about `shift`. Differences that equal the
// shift say nothing and are left out; ties share their mean rank.
struct SignedRank {
  std::size_t n = 0;     // differences that count
  double statistic = 0;  // V: sum of the ranks of those above the shift
  double p_greater = 1;  // P(V or more) under H₀: small when they lie above the shift
  double p_less = 1;     // P(V or less)
};
// Exact up to this many differences (conditional on the ties there are), beyond it the normal
// approximation with corrections for ties and continuity.
inline constexpr std::size_t most_for_exact = 25;
[[nodiscard]] SignedRank wilcoxon_signed_rank(std::span<const double> differences,
                                              double shift = 0);

struct Interval {
  double low = 0;
  double high = 0;
  [[nodiscard]] double half_width() const { return (high - low) / 2; }
};

// Hodges & Lehmann's estimate of the centre, the median of the Walsh averages (dᵢ + dⱼ)/2, i ≤ j,
// with the interval of the shifts that the test at one-sided level `tail` does not reject; infinite
// where there are too few differences to reject anything. NaN for no differences.
struct Shift {
  double estimate = 0;
  Interval interval;
};
[[nodiscard]] Shift estimate_shift(std::span<const double> differences, double tail);

enum class PairVerdict : std::uint8_t {
  slower,  // b is slower than a by more than what is tolerated
  faster,
  same,      // no difference either way that would have to be caught
  undecided  // more blocks may tell
};
[[nodiscard]] std::string_view name_of(PairVerdict verdict);

// A group-sequential test: looks at fixed numbers of blocks, each at an equal share of `alpha`
// (Bonferroni), so that all looks together err on a side with a probability of at most `alpha`.
struct SequentialDesign {
  std::array<int, 6> looks{12, 24, 48, 96, 192, 384};
  double alpha = 0.01;
  double tolerated = 0;  // τ₀: a shift up to here is none
  double caught = 0;     // τ₁: a shift from here on must be found

  // τ₀ = ln 1.01, τ₁ = ln 1.03
  [[nodiscard]] static SequentialDesign standard();
  [[nodiscard]] double alpha_of_a_look() const { return alpha / static_cast<double>(looks.size()); }
  // The next look after so many blocks; 0 after the last.
  [[nodiscard]] int next_look(int blocks) const;
};

// slower: θ ≤ τ₀ is rejected; faster: θ ≥ −τ₀ is; same: both θ ≥ τ₁ and θ ≤ −τ₁ are. The interval
// holds the true shift at all looks together with a probability of at least 1 − 2·alpha.
struct Look {
  PairVerdict verdict = PairVerdict::undecided;
  Shift shift;
};
[[nodiscard]] Look look_at(std::span<const double> differences, const SequentialDesign& design);

// One process run's blocks agree with each other more than process runs do (memory layout, thread
// placement), so what one process run says is believed only once fresh process runs say it again.
struct Suspect {
  std::vector<double> process_runs;  // the estimated shift of each fresh process run
  bool slower = true;                // else faster: what the first process run said
};
inline constexpr std::size_t least_process_runs = 2;  // fewer have no scatter

// Two looks, the second at what the first leaves open, each at an equal share of `q`.
struct ConfirmationDesign {
  std::array<std::size_t, 2> looks{5, 10};  // fresh process runs
  std::size_t blocks_per_process_run = 24;
  // False among what is confirmed, at all looks together: what a look adds to the false
  // discoveries' share is at most its own share of them.
  double q = 0.02;

  [[nodiscard]] double q_of_a_look() const { return q / static_cast<double>(looks.size()); }
};

struct Confirmation {
  PairVerdict verdict = PairVerdict::undecided;  // slower or faster only as suspected
  Shift shift;  // mean of the process runs; Student's t leaves out `q` on each side of the interval
  double p = 1;  // of a shift no larger than what is tolerated
};
// Student's t of the process runs' mean against τ₀, the variance between process runs moderated
// over the suspects; Benjamini & Hochberg at `q` over the suspects. That holds for all
// configurations: the process run that chose the suspects is none of those that confirm, and no
// other is called anything. What is not confirmed is the same where its interval says so, and
// undecided where there are fewer than least_process_runs.
[[nodiscard]] std::vector<Confirmation> confirm(std::span<const Suspect> suspects, double q,
                                                const SequentialDesign& design);

// Adds one fresh process run to each of the suspects `open`, the `number`-th, towards the look
// after `until`; false where none can be had any more.
using RunAgain =
    std::function<bool(std::span<const std::size_t> open, std::size_t number, std::size_t until)>;
// All looks of a confirmation; what one of them settles is measured no more.
[[nodiscard]] std::vector<Confirmation> confirm_in_looks(std::vector<Suspect>& suspects,
                                                         const ConfirmationDesign& confirmation,
                                                         const SequentialDesign& design,
                                                         const RunAgain& run_again);

}  // namespace triptych::comparison
