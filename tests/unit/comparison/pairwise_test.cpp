#include "comparison/pairwise.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "estimation/statistics.hpp"
#include "tests/support/normal.hpp"

namespace triptych::comparison {
namespace {

using test::normal;

// Hollander & Wolfe (1973), p. 29f.: a depression scale at two visits. For these data, R's
// wilcox.test gives V = 40, a one-sided p of 0.01953, and an estimate of 0.46.
std::vector<double> depression_scale() {
  const std::vector<double> first{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> second{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(first[i] - second[i]);
  return differences;
}

TEST(SignedRank, GivesThePublishedValues) {
  const SignedRank test = wilcoxon_signed_rank(depression_scale());
  EXPECT_EQ(test.n, 9U);
  EXPECT_EQ(test.statistic, 40);
  EXPECT_NEAR(test.p_greater, 0.01953125, 1e-12);  // 10/512
  EXPECT_NEAR(estimate_shift(depression_scale(), 0.025).estimate, 0.46, 1e-12);
}

// Enumerates all assignments of signs to the differences, which is how the null distribution is
// defined.
TEST(SignedRank, IsTheEnumeratedNullDistributionWithAndWithoutTies) {
  core::Random random(3);
  for (std::size_t n = 1; n <= 10; ++n) {
    for (const bool tied : {false, true}) {
      std::vector<double> values;
      for (std::size_t i = 0; i < n; ++i) {
        const double value = random.uniform(-1, 1);
        values.push_back(tied ? std::copysign(std::ceil(3 * std::abs(value)), value) : value);
      }
      const SignedRank test = wilcoxon_signed_rank(values);
      double less = 0;
      double greater = 0;
      for (unsigned signs = 0; signs < 1U << n; ++signs) {
        std::vector<double> flipped;
        for (std::size_t i = 0; i < n; ++i) {
          flipped.push_back(std::abs(values[i]) * ((signs >> i & 1U) != 0 ? 1 : -1));
        }
        const double statistic = wilcoxon_signed_rank(flipped).statistic;
        less += statistic <= test.statistic ? 1 : 0;
        greater += statistic >= test.statistic ? 1 : 0;
      }
      EXPECT_NEAR(test.p_less, less / std::pow(2, n), 1e-12) << n << tied;
      EXPECT_NEAR(test.p_greater, greater / std::pow(2, n), 1e-12) << n << tied;
    }
  }
}

TEST(SignedRank, ZerosAreIgnored) {
  const SignedRank test = wilcoxon_signed_rank(std::vector<double>{0, 0, 1, 2});
  EXPECT_EQ(test.n, 2U);
  EXPECT_EQ(test.statistic, 3);
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>(30, 0.5), 0.5).p_greater, 1);
}

// Returns n differences of distinct sizes. The ranks of the positive differences add up to
// `statistic`.
std::vector<double> differences_with(std::size_t n, std::size_t statistic) {
  std::vector<double> values;
  for (std::size_t rank = n; rank > 0; --rank) {
    const bool positive = rank <= statistic;
    if (positive) statistic -= rank;
    values.push_back((positive ? 1.0 : -1.0) * static_cast<double>(rank));
  }
  return values;
}

// The test statistic V is the sum of the ranks i = 1 … n of the positive differences. The normal
// approximation is the first term of the Edgeworth series of its distribution. Because V is
// symmetric, the next term is φ(z)(3z − z³)·κ₄/(24σ⁴), where z is the standardised V, φ the normal
// density, σ² the variance of V, and κ₄ = −Σi⁴/8 its fourth cumulant. φ(z)(3z − z³) is at most
// 0.551. Another 10 % are allowed for all further terms.
TEST(SignedRank, TheApproximationErrsByItsNextTermAtMost) {
  constexpr std::size_t n = max_exact_differences + 1;
  std::vector<double> share{1};
  double fourth = 0;
  double variance = 0;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    const auto r = static_cast<double>(rank);
    fourth += r * r * r * r / 8;
    variance += r * r / 4;
    share.resize(share.size() + rank, 0.0);
    for (std::size_t sum = share.size(); sum-- > 0;) {
      share[sum] = (share[sum] + (sum >= rank ? share[sum - rank] : 0)) / 2;
    }
  }
  const double bound = 1.1 * 0.551 * fourth / (24 * variance * variance);
  double less = 0;
  for (std::size_t statistic = 0; statistic < share.size(); ++statistic) {
    less += share[statistic];
    const SignedRank test = wilcoxon_signed_rank(differences_with(n, statistic));
    ASSERT_EQ(test.statistic, static_cast<double>(statistic));
    EXPECT_NEAR(test.p_less, less, bound) << statistic;
    EXPECT_NEAR(test.p_greater, 1 - less + share[statistic], bound) << statistic;
  }
}

// Of the n = 40 differences, 20 have the size 1 and 20 have the size 2. These two groups of ties
// reduce the variance of the rank sum, which is n(n+1)(2n+1)/24 − 2·(20³ − 20)/48 = 5202.5.
TEST(SignedRank, TiesNarrowTheApproximation) {
  std::vector<double> values(20, 1.0);
  values.insert(values.end(), 20, -2.0);
  const double variance = 40.0 * 41 * 81 / 24 - 2 * (8000.0 - 20) / 48;
  // The positive differences have the 20 smallest magnitudes, so their ranks add up to 210. If
  // positive and negative differences were equally likely, the mean of this sum would be
  // n(n+1)/4 = 410.
  const double z = (210.0 - 410 + 0.5) / std::sqrt(variance);
  EXPECT_NEAR(wilcoxon_signed_rank(values).p_less, estimation::student_t_upper_tail(-z, INFINITY),
              1e-12);
}

TEST(Shift, TheIntervalContainsTheShiftsThatTheTestAccepts) {
  core::Random random(8);
  for (const std::size_t n : {12U, 24U, 48U}) {
    std::vector<double> values;
    while (values.size() < n) values.push_back(0.02 * normal(random));
    const double tail = 0.01 / 6;
    const Interval interval = estimate_shift(values, tail).interval;
    const double hair = 1e-9;
    EXPECT_LE(wilcoxon_signed_rank(values, interval.low - hair).p_greater, tail) << n;
    EXPECT_GT(wilcoxon_signed_rank(values, interval.low + hair).p_greater, tail) << n;
    EXPECT_LE(wilcoxon_signed_rank(values, interval.high + hair).p_less, tail) << n;
    EXPECT_GT(wilcoxon_signed_rank(values, interval.high - hair).p_less, tail) << n;
  }
}

TEST(Shift, TooFewDifferencesHaveAnInfiniteInterval) {
  const Shift shift = estimate_shift(std::vector<double>{1, 2}, 0.01);
  EXPECT_EQ(shift.estimate, 1.5);
  EXPECT_TRUE(std::isinf(shift.interval.high));
  EXPECT_TRUE(std::isnan(estimate_shift({}, 0.01).estimate));
}

// Simulates a comparison of two programs on one machine. They share a slow drift, which is AR(1)
// from batch to batch. Each batch has its own noise, and other programs disturb some batches.
struct Machine {
  double noise = 0.01;
  double drift = 0.01;        // standard deviation of the drift
  double persistence = 0.98;  // correlation of the drift from one batch to the next
  double disturbed = 0.02;    // share of batches that take 1.5 times as long

  [[nodiscard]] std::vector<double> blocks(double shift, int count, core::Random& random) const {
    std::vector<double> differences;
    double level = drift * normal(random);
    const double step = drift * std::sqrt(1 - persistence * persistence);
    for (int i = 0; i < count; ++i) {
      const bool b_first = random.uniform() < 0.5;
      double difference = 0;
      for (int batch = 0; batch < 4; ++batch) {
        level = persistence * level + step * normal(random);
        const bool outer = batch == 0 || batch == 3;
        const bool b = outer == b_first;
        double ln_time = level + noise * normal(random) + (b ? shift : 0);
        if (random.uniform() < disturbed) ln_time += 0.4;
        difference += (b ? 0.5 : -0.5) * ln_time;
      }
      differences.push_back(difference);
    }
    return differences;
  }
};

struct Outcomes {
  int slower = 0, faster = 0, same = 0, undecided = 0, covered = 0;
  double blocks = 0;
};

Outcomes repeat(const Machine& machine, double shift, int times, std::uint64_t seed) {
  const SequentialDesign design = SequentialDesign::standard();
  core::Random random(seed);
  Outcomes outcomes;
  for (int i = 0; i < times; ++i) {
    const std::vector<double> all = machine.blocks(shift, design.looks.back(), random);
    Look look;
    int blocks = 0;
    while (look.verdict == PairVerdict::undecided && design.next_look(blocks) > 0) {
      blocks = design.next_look(blocks);
      look = look_at(std::span(all).first(static_cast<std::size_t>(blocks)), design);
    }
    outcomes.blocks += static_cast<double>(blocks) / times;
    outcomes.slower += look.verdict == PairVerdict::slower ? 1 : 0;
    outcomes.faster += look.verdict == PairVerdict::faster ? 1 : 0;
    outcomes.same += look.verdict == PairVerdict::same ? 1 : 0;
    outcomes.undecided += look.verdict == PairVerdict::undecided ? 1 : 0;
    const Interval& interval = look.shift.interval;
    outcomes.covered += interval.low <= shift && shift <= interval.high ? 1 : 0;
  }
  return outcomes;
}

// The design limits the probability of a wrong verdict to α = 0.01, separately for `slower`
// and for `faster`. With a probability above 0.99, there are then at most 8 wrong verdicts in 300
// repetitions.
constexpr int repetitions = 300;
constexpr int most_errors = 8;

TEST(Sequential, NothingIsReportedSlowerThanItself) {
  const Outcomes outcomes = repeat({}, 0, repetitions, 1);
  EXPECT_EQ(outcomes.slower + outcomes.faster, 0);
  EXPECT_GE(outcomes.same, repetitions * 9 / 10);
  EXPECT_GE(outcomes.covered, repetitions - 2 * most_errors);
}

TEST(Sequential, TolerableSlowdownsAreRarelyReported) {
  const Outcomes outcomes = repeat({}, std::log(1.01), repetitions, 2);
  EXPECT_LE(outcomes.slower, most_errors);
  EXPECT_GE(outcomes.covered, repetitions - 2 * most_errors);
}

TEST(Sequential, ImportantSlowdownsAreRarelyMissed) {
  const Outcomes outcomes = repeat({}, std::log(1.03), repetitions, 3);
  EXPECT_LE(outcomes.same, most_errors);
  EXPECT_GE(outcomes.slower, repetitions * 9 / 10);
  EXPECT_GE(outcomes.covered, repetitions - 2 * most_errors);
  const Outcomes mirrored = repeat({}, -std::log(1.03), repetitions, 4);
  EXPECT_LE(mirrored.same, most_errors);
  EXPECT_GE(mirrored.faster, repetitions * 9 / 10);
}

TEST(Sequential, NoiseProlongsButDoesNotMislead) {
  const Machine noisy{.noise = 0.1, .drift = 0.05};
  const Outcomes same = repeat(noisy, 0, 100, 5);
  EXPECT_EQ(same.slower + same.faster, 0);
  const Outcomes slower = repeat(noisy, std::log(1.05), 100, 6);
  EXPECT_EQ(slower.same + slower.faster, 0);
  EXPECT_GT(same.blocks, repeat({}, 0, 100, 5).blocks);
}

TEST(Sequential, LooksFollowOneAnother) {
  const SequentialDesign design = SequentialDesign::standard();
  EXPECT_EQ(design.next_look(0), 12);
  EXPECT_EQ(design.next_look(12), 24);
  // A look is an evaluation of the data measured so far. If a time budget ends the measurement
  // between two looks, the data are evaluated as at the later of the two.
  EXPECT_EQ(design.next_look(20), 24);
  EXPECT_EQ(design.next_look(384), 0);
  EXPECT_NEAR(design.alpha_of_a_look(), 0.01 / 6, 1e-15);
}

std::vector<double> process_runs(double shift, double between, core::Random& random) {
  std::vector<double> result;
  for (int i = 0; i < 5; ++i) result.push_back(shift + between * normal(random));
  return result;
}

TEST(Confirm, ARepeatedSlowdownIsConfirmed) {
  core::Random random(11);
  const std::vector<Suspect> suspects{{process_runs(std::log(1.05), 0.003, random), true},
                                      {process_runs(-std::log(1.05), 0.003, random), false}};
  const auto confirmed = confirm(suspects, 0.05, SequentialDesign::standard());
  EXPECT_EQ(confirmed[0].verdict, PairVerdict::slower);
  EXPECT_EQ(confirmed[1].verdict, PairVerdict::faster);
  EXPECT_NEAR(confirmed[0].shift.estimate, std::log(1.05), 0.005);
}

TEST(Confirm, ASlowdownInOneProcessRunIsNotConfirmed) {
  const std::vector<Suspect> suspects{{{0.001, -0.002, 0.0, 0.002, -0.001}, true}};
  const auto confirmed = confirm(suspects, 0.05, SequentialDesign::standard());
  EXPECT_EQ(confirmed[0].verdict, PairVerdict::same);
  const std::vector<Suspect> scattered{{{0.06, -0.02, 0.09, 0.01, 0.05}, true}};
  EXPECT_EQ(confirm(scattered, 0.05, SequentialDesign::standard())[0].verdict,
            PairVerdict::undecided);
}

// Suspects are configurations that seemed slower or faster. If 1000 more suspects are tested, the
// evidence against the first suspect must be stronger, because each test can be wrong by chance.
TEST(Confirm, CountsTheSuspectsAsHypotheses) {
  std::vector<Suspect> suspects{{{0.0135, 0.0175, 0.0095, 0.0155, 0.0115}, true}};
  EXPECT_EQ(confirm(suspects, 0.05, SequentialDesign::standard())[0].verdict, PairVerdict::slower);
  for (int i = 0; i < 1000; ++i) suspects.push_back({{0.001, 0.005, -0.003, 0.003, -0.001}, true});
  EXPECT_NE(confirm(suspects, 0.05, SequentialDesign::standard())[0].verdict, PairVerdict::slower);
}

TEST(Confirm, VariancesOfSuspectsArePooled) {
  core::Random random(12);
  std::vector<Suspect> suspects{{{0.0301, 0.0302, 0.0301, 0.0302, 0.0301}, true}};
  const double alone = confirm(suspects, 0.05, SequentialDesign::standard())[0].p;
  for (int i = 0; i < 20; ++i) suspects.push_back({process_runs(0, 0.02, random), true});
  EXPECT_GT(confirm(suspects, 0.05, SequentialDesign::standard())[0].p, alone);
}

TEST(Confirm, EqualProcessRunsDoNotDivideByZero) {
  const std::vector<Suspect> suspects{{std::vector<double>(5, std::log(1.05)), true}};
  EXPECT_EQ(confirm(suspects, 0.05, SequentialDesign::standard())[0].verdict, PairVerdict::slower);
}

TEST(Confirm, OneProcessRunHasNoScatter) {
  const std::vector<Suspect> suspects{{{0.5}, true}, {{}, true}, {std::vector(5, 0.05), true}};
  const auto confirmed = confirm(suspects, 0.05, SequentialDesign::standard());
  EXPECT_EQ(confirmed[0].verdict, PairVerdict::undecided);
  EXPECT_TRUE(std::isinf(confirmed[1].shift.interval.high));
  EXPECT_EQ(confirmed[2].verdict, PairVerdict::slower);
}

// Replaces measurements by given results. A process run is the lifetime of one worker process.
// process_runs[i] contains the results of suspect i, which are passed to confirm_in_looks() one at
// a time.
struct ProcessRuns {
  std::vector<std::vector<double>> process_runs;
  std::vector<std::vector<std::size_t>> asked;  // the suspects that each process run measured

  std::vector<Confirmation> confirm_all() {
    std::vector<Suspect> suspects(process_runs.size());
    return confirm_in_looks(
        suspects, {}, SequentialDesign::standard(),
        [&](std::span<const std::size_t> open, std::size_t number, std::size_t /*until*/) {
          asked.emplace_back(open.begin(), open.end());
          bool any = false;
          for (const std::size_t i : open) {
            if (number > process_runs[i].size()) continue;
            suspects[i].process_runs.push_back(process_runs[i][number - 1]);
            any = true;
          }
          return any;
        });
  }
};

// The first five process runs decide the obvious cases. Only the undecided case gets five more.
TEST(ConfirmInLooks, RepeatsOnlyUndecidedConfigurations) {
  core::Random random(21);
  std::vector<double> scattered{0.05, 0.01, 0.06, 0.012, 0.05, 0.035, 0.03, 0.04, 0.036, 0.03};
  ProcessRuns given{.process_runs = {std::vector(10, 0.05), scattered, std::vector(10, 0.0)},
                    .asked = {}};
  for (double& process_run : given.process_runs[0]) process_run += 0.001 * normal(random);
  for (double& process_run : given.process_runs[2]) process_run += 0.001 * normal(random);
  const auto confirmed = given.confirm_all();
  EXPECT_EQ(confirmed[0].verdict, PairVerdict::slower);
  EXPECT_EQ(confirmed[1].verdict, PairVerdict::slower);
  EXPECT_EQ(confirmed[2].verdict, PairVerdict::same);
  ASSERT_EQ(given.asked.size(), 10U);
  EXPECT_THAT(given.asked[4], testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(given.asked[5], testing::ElementsAre(1));
}

TEST(ConfirmInLooks, StopsAtTheLastProcessRun) {
  ProcessRuns few{.process_runs = {{0.05, 0.051, 0.049}}, .asked = {}};
  EXPECT_EQ(few.confirm_all()[0].verdict, PairVerdict::slower);
  EXPECT_EQ(few.asked.size(), 4U);
  ProcessRuns none{.process_runs = {{}}, .asked = {}};
  EXPECT_EQ(none.confirm_all()[0].verdict, PairVerdict::undecided);
  EXPECT_TRUE(ProcessRuns().confirm_all().empty());
}

// A process run (the lifetime of one worker process) shifts the times of all its blocks by the same
// random amount, so the interval computed from a single process run is far too narrow. A slowdown
// that only one process run shows must therefore not be reported. The test simulates 200 families
// of 24 configurations, none of which is slower than tolerated. On average, at most a share q =
// 0.02 of the families may have false discoveries, so the probability of more than 10 such families
// is below 0.003.
TEST(ConfirmInLooks, ProcessRunEffectsRarelyCauseFalseDiscoveries) {
  const SequentialDesign design = SequentialDesign::standard();
  const double between = 0.01;
  core::Random random(13);
  std::size_t suspected = 0;
  int families_wrong = 0;
  constexpr int families = 200;
  for (int family = 0; family < families; ++family) {
    ProcessRuns given;
    for (int i = 0; i < 24; ++i) {
      // Only configurations whose first process run appears slower become suspects.
      if (between * normal(random) < 0.015) continue;
      given.process_runs.emplace_back();
      for (int process_run = 0; process_run < 10; ++process_run) {
        given.process_runs.back().push_back(design.tolerated + between * normal(random));
      }
    }
    suspected += given.process_runs.size();
    families_wrong += std::ranges::any_of(given.confirm_all(),
                                          [](const Confirmation& each) {
                                            return each.verdict == PairVerdict::slower;
                                          })
                          ? 1
                          : 0;
  }
  EXPECT_GE(suspected, 200U);
  EXPECT_LE(families_wrong, 10);
}

}  // namespace
}  // namespace triptych::comparison
