#pragma once
// Decides from interleaved measurements of two sides a and b, such as two drivers, whether one of
// them is slower. The input is a list of differences d = ln t(b) − ln t(a), one for each block of
// batches (measure/run/interleaved.hpp), where t is the frame time of a side. A positive d means
// that b is slower.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace triptych::comparison {

// Wilcoxon's signed-rank test of H₀: the differences are distributed symmetrically about `shift`.
// Differences equal to the shift are omitted. Ties share their mean rank.
struct SignedRank {
  std::size_t n = 0;     // number of differences that are not omitted
  double statistic = 0;  // V: sum of the ranks of differences above the shift
  double p_greater = 1;  // P(≥ V) under H₀: small if most differences are above the shift
  double p_less = 1;     // P(≤ V) under H₀
};
// Up to this number of differences, the test is exact (conditional on the ties). Beyond it, the
// normal approximation is used, with corrections for ties and continuity.
inline constexpr std::size_t max_exact_differences = 25;
[[nodiscard]] SignedRank wilcoxon_signed_rank(std::span<const double> differences,
                                              double shift = 0);

struct Interval {
  double low = 0;
  double high = 0;
  [[nodiscard]] double half_width() const { return (high - low) / 2; }
};

// `estimate` is the Hodges–Lehmann estimate of the centre: the median of the Walsh averages (dᵢ +
// dⱼ)/2 with i ≤ j. It is NaN if there are no differences. `interval` contains all shifts that the
// test does not reject at the one-sided level `tail`. It is infinite if there are too few
// differences to reject any shift.
struct Shift {
  double estimate = 0;
  Interval interval;
};
[[nodiscard]] Shift estimate_shift(std::span<const double> differences, double tail);

enum class PairVerdict : std::uint8_t {
  slower,  // b is slower than a by more than the tolerated shift
  faster,
  same,      // neither side is slower by an amount that matters
  undecided  // more blocks may lead to a decision
};
[[nodiscard]] std::string_view name_of(PairVerdict verdict);

// A group-sequential test. It evaluates the differences after fixed numbers of blocks. Each such
// evaluation is called a look, and is allotted an equal share of `alpha` (Bonferroni). Therefore
// the probability of a one-sided error over all looks together is at most `alpha`.
struct SequentialDesign {
  std::array<int, 6> looks{12, 24, 48, 96, 192, 384};
  double alpha = 0.01;
  double tolerated = 0;   // τ₀: a shift up to this size is tolerated
  double detectable = 0;  // τ₁: a shift of at least this size must be found

  // Returns the design with τ₀ = ln 1.01 and τ₁ = ln 1.03.
  [[nodiscard]] static SequentialDesign standard();
  [[nodiscard]] double alpha_of_a_look() const { return alpha / static_cast<double>(looks.size()); }
  // Returns the number of blocks at which the next look takes place, or 0 after the last look.
  // `blocks` is the number of blocks measured so far.
  [[nodiscard]] int next_look(int blocks) const;
};

// The result of a look. Each verdict is a statement about the true shift θ:
//   slower  rejects θ ≤ τ₀
//   faster  rejects θ ≥ −τ₀
//   same    rejects both θ ≥ τ₁ and θ ≤ −τ₁
// The probability that the interval contains the true shift at all looks is at least 1 − 2·alpha.
struct Look {
  PairVerdict verdict = PairVerdict::undecided;
  Shift shift;
};
[[nodiscard]] Look look_at(std::span<const double> differences, const SequentialDesign& design);

// A configuration that seemed slower or faster. The blocks of one process run (the lifetime of one
// worker process) scatter less than different process runs do, because memory layout and thread
// placement differ between process runs. Therefore the result of one process run is accepted only
// if fresh process runs confirm it.
struct Suspect {
  std::vector<double> process_runs;  // the estimated shift of each fresh process run
  bool slower = true;                // result of the first process run; false: faster
};
inline constexpr std::size_t min_process_runs = 2;  // with fewer runs, their scatter is unknown

// The design of the confirmation, which consists of two looks. Only suspects that the first look
// leaves undecided are evaluated at the second look. Each look is allotted an equal share of `q`.
struct ConfirmationDesign {
  std::array<std::size_t, 2> looks{5, 10};  // numbers of fresh process runs
  std::size_t blocks_per_process_run = 24;
  // The limit for the false discovery rate (the expected fraction of false results among the
  // confirmed results) over all looks together. Each look adds at most its own share to that rate.
  double q = 0.02;

  [[nodiscard]] double q_of_a_look() const { return q / static_cast<double>(looks.size()); }
};

struct Confirmation {
  PairVerdict verdict = PairVerdict::undecided;  // slower or faster only if that was suspected
  Shift shift;   // mean of the process runs, and Student's t interval with the tail probability `q`
                 // at each end
  double p = 1;  // p-value of the hypothesis that the shift is not larger than tolerated
};
// Compares the mean of the process runs with τ₀ (SequentialDesign::tolerated) by Student's t test.
// Each suspect has only a few process runs, so the estimate of its variance is made more accurate
// with the variances of the other suspects (moderated_variance() in estimation/statistics.hpp). The
// Benjamini–Hochberg procedure with the rate `q` then decides which suspects are confirmed. The
// resulting false discovery rate holds for all configurations for two reasons: the process run that
// selected the suspects is not used for the confirmation, and no other configuration is called
// slower or faster.
//
// A suspect that is not confirmed gets the verdict `same` if its interval proves it, and
// `undecided` otherwise. A suspect with fewer than min_process_runs process runs is undecided.
[[nodiscard]] std::vector<Confirmation> confirm(std::span<const Suspect> suspects, double q,
                                                const SequentialDesign& design);

// A function that measures one fresh process run for each suspect whose index is in `open`.
// Suspects about which a look has decided are no longer in `open`. `number` is the number of this
// process run (1, 2, …), and the next look takes place after the process run with the number
// `until`. The function returns false if no more process runs are possible.
using MeasureProcessRun =
    std::function<bool(std::span<const std::size_t> open, std::size_t number, std::size_t until)>;
[[nodiscard]] std::vector<Confirmation> confirm_in_looks(std::vector<Suspect>& suspects,
                                                         const ConfirmationDesign& confirmation,
                                                         const SequentialDesign& design,
                                                         const MeasureProcessRun& run_again);

}  // namespace triptych::comparison
