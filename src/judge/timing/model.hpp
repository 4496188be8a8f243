#pragma once
// Is a configuration slower than its stored runs on the same device? The numbers behind the timing
// check, free of records and files.
//
// With y = ln t, x̄ a configuration's median over its H stored runs, and deviations y − x̄:
//
//     y = x̄ + shift of the run + what became of the configuration + its own scatter.
//
// The shift has two witnesses.
// - The anchors: a, the median of their deviations in each run. No change of the program reaches
//   them, but they are few and each loads one resource: they scatter by several percent.
// - The body: b, the median of the deviations of the device's other configurations. It knows the
//   shift to their scatter/√n, but a slowdown of the whole program moves it too.
//
// The program as a whole. d = b − a is free of the device and holds what changed in the program
// alone. Over the H stored runs, in which nothing did, it scatters by s_d around their median d̄:
//
//     t = (d − d̄ − τ)/√(V + v_b),  V = the larger of s_d²(1 + π/2H) and v_a,
//
// s_d and the anchors' σ from median absolute deviations, as all scatter of stored runs (below),
// s_d² moderated over the run's devices, of which each has few runs: Student's t with the ν that
// such a variance of H values is worth, and those of the others, where the first is larger, else
// with (k − 1)ν of k anchors (ν of one). v_a is what the anchors' own scatter lets expect of their
// median, π/2·k/(Σ1/σ)²·k/(k − 1): the median of values with unlike σ, of which wild ones say
// little (one that makes many short launches scatters by a factor of three), none of them being
// taken as quieter than the median of all σ by its few runs. s_d holds what that does not know:
// anchors that are slow together, a minute that only one of the two witnesses met, as far as that
// happens in most runs: the rest is for another launch. Tested at 1 % on either side, once per
// device.
//
// Where d is significant the program has changed, and the shift is a, whose variance is V.
// Otherwise both tell the same shift, and it is their mean weighted by precision,
//
//     shift = w·b + (1 − w)·a,  w = V/(V + v_b),  v = w²v_b + (1 − w)²V,
//
// in this run and, with the same w, in each stored one. A slowdown of the whole program that d does
// not show is in it. How large that may be is what the half-width of d says, and the verdict on the
// program as a whole is no pass where a fifth cannot be excluded: the configurations' verdicts hold
// against the program as a whole, that one against the device.
//
// The judged configuration is left out of its own b: of few it would hide a part of itself there.
// v_b is the larger of two: π/2 · s₀²(1 + π/2H)/n, of a median of n normal deviations with the
// stored runs' typical scatter s₀; and this run's own, from the distribution-free interval of the
// median between the c-th smallest and c-th largest deviation,
//
//     c = (n + 1)/2 − 2.576·√n/2,  (width/2z)²,
//
// z normal with the interval's exact binomial coverage (McKean and Schrader 1984; coverage as Price
// and Bonett 2001). That is the guard against a level: where from 31 to 69 % of the configurations
// are slower together (n = 48) the median lies anywhere between the two parts, the interval spans
// both, w falls and the anchors decide. Beyond 69 % the body is the slower part: d tells, or,
// within V, the rest is called faster.
//
// A stored run without anchors is levelled by the body alone, and where the program has changed,
// when the body is no witness, it is left out.
//
// Without anchors nothing tells a shift from the program: there is none. With fewer than three
// configurations the body is no crowd: the shift is the anchors', v = v_a.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych::judge {

struct TimingModel {
  static constexpr double share_of_false_alarms = 0.05;  // q of Benjamini–Hochberg
  static constexpr double false_program_alarms = 0.01;   // one test a device, so no q
  // What another launch should settle (judge/gate/confirmation.hpp): one suspect in five may be
  // chance.
  static constexpr double share_of_false_suspects = 0.2;
  static constexpr double false_program_suspects = 0.05;
  static constexpr std::size_t least_runs = 5;  // fewer stored runs decide nothing
  static constexpr std::size_t least_body = 3;  // fewer configurations tell no shift
  static constexpr double tolerated = 1.02;     // slower by this factor is not worth a finding
  // A configuration passes only where a slowdown by this factor can be excluded; where noise or a
  // coarse clock leave it possible, nothing is decided.
  static constexpr double must_be_told = 1.20;
  // Of a run's configurations, what noise may leave open before the run cannot be judged. None of
  // them may itself have come out slower by must_be_told.
  static constexpr double largest_share_open = 0.05;
};

struct TimingCase {
  std::string device;
  bool anchor = false;
  bool witness = false;  // an anchor of another plan: tells the shift, is not judged itself
  double median_ns = 0;
  std::map<std::string, double> stored_ns;   // run → median; at least TimingModel::least_runs
  double tolerance = 0;                      // τ in ln t: max(ln 1.02, one step of the clock)
  std::optional<double> variance_of_rounds;  // v_r of this run's ln t; empty: it had one round
};

// Something in ln t against its stored runs, slower by more than τ or faster.
struct TimingTest {
  double log_ratio = 0;       // x − shift − x̄; of a program d − d̄
  double standard_error = 0;  // of log_ratio
  double busy_variance = 0;   // of what a busy machine may have added to log_ratio
  double degrees = 0;         // of freedom of its t distribution, may be infinite
  double t = 0;               // against "slower by τ"
  double p_slower = 1;
  double p_faster = 1;
  double half_width = 0;  // of the one-sided 95 % interval of log_ratio
  bool slower = false;
  bool faster = false;
  // Fills t, both p and the half-width from the first four. A busy machine only lengthens a time:
  // it weakens "slower", and neither "faster" nor how much slower can be excluded.
  void test(double tolerance);
  [[nodiscard]] bool too_noisy(double tolerance) const;
};

// Slower and faster after Benjamini–Hochberg over all cases.
struct TimingJudgement : TimingTest {
  double baseline_ns = 0;   // geometric mean of the stored runs
  double shift = 0;         // of this run against the stored ones, in ln t; 0 without anchors
  std::size_t runs = 0;     // stored ones of which the shift is known; with fewer than
                            // TimingModel::least_runs nothing is told
  std::size_t anchors = 0;  // of the device
};

// The program as a whole on one device, of which both witnesses are there.
struct ProgramJudgement : TimingTest {
  std::string device;
  double tolerance = 0;            // the configurations' median τ
  double device_shift = 0;         // a − ā, what the anchors show
  std::size_t configurations = 0;  // of the body
  std::size_t anchors = 0;
};

struct TimingJudgements {
  std::vector<TimingJudgement> cases;      // in order; of witnesses it says nothing
  std::vector<ProgramJudgement> programs;  // by device
};

// The variance of ln of the least of a run's rounds, from the rounds themselves: with m₁ the least
// of the first ⌈K/2⌉ of K and m₂ that of the others, minutes later, ½(ln m₁ − ln m₂)². It is of the
// least of half as many rounds, so a bound. Empty below two rounds.
[[nodiscard]] std::optional<double> variance_of_rounds(std::span<const double> rounds_ns);

// A run that met a slow minute says nothing of the others: x̄ is a median, and the variance between
// stored runs is from their median absolute deviation, moderated over the device's cases;
// t = (x − shift − x̄ − τ)/√(max(s̃², v_r) + π/2·s̃²/H + v). A judged run that met one is told by
// another launch (judge/gate/confirmation.hpp). s̃² has the stored runs' shifts in it already; v is
// added in full as it is common to all cases, and H runs tell it but once: a bound.
//
// The stored runs may be of a quiet day. v_r is what this run's own rounds say, typical of the
// device's cases: a slowdown of the program is in every round, and not in it. It counts against
// "slower" alone, as what runs beside a frame never shortens it: where the least round is as the
// stored ones, the program is no slower, however slow the other rounds were.
[[nodiscard]] TimingJudgements judge_timings(std::span<const TimingCase> cases);

}  // namespace triptych::judge
