#pragma once
// Is a program slower on device B than its times on device A let expect? The linear cross-device
// correlation, free of records and files. docs/correlation.md has the derivations.
//
// The line. With x = ln t_A and y = ln t_B of the configurations, y = α + βx + ε: a robust fit
// (judge/statistics/regression.hpp), from the configurations alone. Anchors measure the devices and
// not the program; they get an intercept of their own, α′ = the mean of their y − βx, and give
// nothing to the slope: with a free second intercept an anchor's share of what is known about β is
// its spread in x over its own scatter squared, and anchors scatter more (each loads one resource,
// whose ratio between two devices is its own). So no slowdown of the program moves α′ and no odd
// anchor tilts the line.
//
// One configuration. z = residual/√(ŝ²(1 + h) + max(0, s² − s̃²)), h its leverage, s² = s_A² + s_B²
// the scatter of its own times and s̃² the median of all configurations': ŝ, the scatter of the
// residuals, holds the typical scatter of times already, so that only what one's times scatter
// beyond it comes on top; p from Student's t. The degrees are Satterthwaite's (1946), of a sum of
// variances u each known with ν degrees, (Σu)²/Σ(u²/ν), and no more than the line's n − 2: where a
// machine has slow minutes, configurations scatter so unlike each other that s_A and s_B rest on
// few runs, and their few degrees are what keeps such a minute from being called beyond chance.
//
// A factor level. Its effect is the coefficient of the level's indicator beside α and β, estimated
// with each side's wild points weighted down about that side's own median: a level that is slower
// as a whole is no outlier to itself, and one that holds the long times does not hide in the slope.
//
// Where A is B itself, some time ago, the slope is 1 and effects are estimated from y − x: beside a
// free slope, a slower level of the long times would be taken for a steeper line. They are beside
// the level apart (below), with errors that are no less than with it: what makes it apart is not
// one number for all of it. ŝ is then no less than s̃: the residuals are one run's chance.
//
// One level apart. The level whose effect is the most standard errors, if that is beyond chance, is
// given an offset of its own, and the line is fitted beside it: a level of long times tilts the
// line of all, and others would be named for that. The line is of those inside or outside,
// whichever are more; of equally many it is that of the faster.
//
// Too many changes. Where so much is slower that no line is left, though ρ is still what it must
// be, and B's times when it was accepted had one, that line is taken, moved by the median of what
// the anchors changed since; residuals and effects are those from it, and ŝ is no less than s̃: that
// day knows nothing of today's scatter. Else the line beside a level
// may judge, if it scatters half as much as that of all: then the level is all that was in the way.
//
// All configurations at once. The line follows them, so that no residual tells.
//
// Where B was accepted before, with anchors, what changed since does: Δ = c − a, c the lower
// quartile of ln t_B − ln t_B then of the configurations, as half of them are not the whole, a the
// median of the anchors. Neither device's character is in it. se² = π/2·s_a²/k + v_c + v_d: s_a² of
// the k anchors' changes, from their median absolute deviation; v_c of the quartile,
// distribution-free; v_d of the two medians' distance from stored run to stored run, as a minute
// that only one of them met is common to all configurations. Student's t with Satterthwaite's
// degrees. Told from 5 % on.
//
// Else Δ = α − α′ does: by how much the program lies above the anchors' own line. Anchors of one
// technique share a resource; the k techniques' mean residuals (the configurations', where there is
// one technique only) scatter with s_g around α′, and the program, being one more mix of resources,
// would by chance scatter as they do: se² = s_g² + 1/Σw + var(α + βx̄′), x̄′ the anchors' mean x. w =
// 1/(s_g² + e), e what a technique's times scatter by from run to run beyond the techniques' median
// (of many short launches by a factor of three): α′ is the weighted mean, s_g² by Paule and Mandel
// (1982); Student's t with Σs_g²w − 1 degrees. Where all e are 0 that is the mean, the sample
// variance, s_g²(1 + 1/k) and k − 1. Told from 10 % on, of a device that was accepted (but nothing
// knows v_d) where Δ since then is as much.

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "judge/baselines/work.hpp"
#include "judge/statistics/regression.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::judge {

struct CorrelationModel {
  // What a stored device must show before it may judge another.
  static constexpr std::size_t least_configurations = 30;
  static constexpr std::size_t least_anchors = 6;
  static constexpr double least_rho = 0.95;
  static constexpr double least_slope = 0.7;
  static constexpr double largest_slope = 1.3;
  static constexpr double largest_scale = 0.10;  // ŝ, in ln t
  // Of ŝ, what a level's offset must leave at most to be all that is in a line's way.
  static constexpr double share_beside_level = 0.5;

  static constexpr double share_of_false_alarms = 0.02;  // q of Benjamini–Hochberg
  static constexpr double least_effect = 1.10;           // of a level or of all, to be a regression
  static constexpr double least_change = 1.05;           // of all since B was accepted
  static constexpr double share_not_slower = 0.25;       // of a program that is slower as a whole
  // What a level is told from on: below, it is how devices are made.
  static constexpr double least_level_effect = 1.04;
  // Of one configuration: two devices' character differs by up to that much here and there.
  static constexpr double least_configuration_effect = 1.15;
  static constexpr double false_global_alarms = 0.01;  // one test, so no q
  // What another launch should settle (judge/gate/confirmation.hpp): one suspect in five may be
  // chance.
  static constexpr double share_of_false_suspects = 0.2;
  static constexpr double false_global_suspects = 0.05;
  static constexpr std::size_t least_level = 3;  // configurations inside a level, and outside
  static constexpr double power = 0.80;          // of the smallest effects that are told

  // By least_effect; in ln t.
  [[nodiscard]] static bool is_worth_telling(double effect);
};

struct CorrelationCase {
  std::string configuration;
  std::map<std::string, std::string> factors;  // all of them; "technique" groups anchors
  bool anchor = false;
  double log_time_a = 0;                                       // median ln t of the stored runs
  double variance_a = 0;                                       // of that median
  double degrees_a = std::numeric_limits<double>::infinity();  // that its variance is known with
  double log_time_b = 0;
  double variance_b = 0;
  double degrees_b = std::numeric_limits<double>::infinity();
  // ln t that B itself had when it was accepted, the median of its runs: what differed then is the
  // device's character.
  std::optional<double> known_log_time_b = {};
  std::optional<WorkChange> work = {};  // from A to B
};

struct ConfigurationJudgement {
  double residual = 0;  // ln t_B − α − β ln t_A; an anchor's, from the configurations' line
  double leverage = 0;
  double z = 0;
  double p = 1;  // slower
  double q = 1;  // p after Benjamini–Hochberg over the configurations
  bool slower = false;
  bool faster = false;
  bool suspected = false;  // slower, or it may be
  bool standing = false;   // suspected, but hardly more than when B was accepted
  double share = 0;        // of the residuals' sum of squares that this configuration explains
};

struct LevelEffect {
  std::string factor;
  std::string level;
  std::vector<std::string> aliases;  // "factor=level" of exactly the same configurations
  std::size_t size = 0;
  double effect = 0;  // in ln t, against all other configurations
  double standard_error = 0;
  double p = 1;  // slower
  double q = 1;
  double smallest_effect = 0;  // that would have been found with probability `power`
  double share = 0;            // as of a configuration
  bool slower = false;
  bool suspected = false;
  bool standing = false;
};

struct GlobalShift {
  bool since_acceptance = false;  // Δ is what B changed by; else against A
  // Techniques of anchors, or anchors where they have one technique or it is since acceptance.
  std::size_t groups = 0;
  double delta = 0;  // Δ
  double standard_error = 0;
  double degrees = 0;
  double p = 1;  // slower
  double smallest_effect = std::numeric_limits<double>::infinity();
  bool slower = false;
  bool suspected = false;
};

struct Correlation {
  std::size_t configurations = 0;  // without anchors
  std::size_t anchors = 0;
  double r = 0;    // Pearson's, of raw times
  double rho = 0;  // Pearson's, of their logarithms
  Line line;       // α, β
  double anchor_intercept = std::numeric_limits<double>::quiet_NaN();  // α′
  double intercept_error = 0;
  double slope_error = 0;
  double scale = 0;                 // ŝ
  double smallest_effect = 0;       // on one typical configuration, with probability `power`
  bool line_of_acceptance = false;  // today's times have none
  std::string line_beside;          // "factor=level": the line is beside an offset of that level
  // "12 configurations, 30 are needed": why this baseline cannot judge; empty: it can. Nothing is
  // tested where it cannot.
  std::vector<std::string> refusals;
  std::vector<ConfigurationJudgement> judgements;  // one per case, in order
  std::vector<LevelEffect> levels;                 // slower ones first, by share
  GlobalShift global;
  [[nodiscard]] bool admitted() const { return refusals.empty(); }
  // ŝ is all that is wrong: quieter times might do.
  [[nodiscard]] bool refused_for_scatter() const {
    return refusals.size() == 1 && !(scale <= CorrelationModel::largest_scale);
  }
};

// `beside_anchors`: of how far the configurations' and the anchors' changes since B was accepted
// are apart by chance, as stored runs say; no degrees: nothing says it. `of_itself`: A is B some
// time ago, so that levels are estimated from y − x.
[[nodiscard]] Correlation correlate(std::span<const CorrelationCase> cases,
                                    const KnownVariance& beside_anchors = {0, 0},
                                    bool of_itself = false);

}  // namespace triptych::judge
