// Trials put together from runs of two synthetic devices whose true times are known.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "fixture.hpp"
#include "judge/evaluation/runs.hpp"

namespace triptych::judge {
namespace {

constexpr const char* plan = "volume/correlation";
constexpr const char* anchors = "anchors/frozen";

class EvaluateRuns : public testing::Test {
 protected:
  EvaluateRuns() : store_(folder_.path() / "runs.sqlite", record::Store::Mode::append) {}

  static constexpr std::array<const char*, 2> devices{"gl:one", "vulkan:two"};

  void add_devices(const std::string& run) {
    for (const char* id : devices) {
      record::Device device;
      device.id = id;
      device.driver_version = "1";
      store_.add_device(run, device, {});
    }
  }

  void add(record::Record record, double log_ns) {
    record.scene = record.configuration;
    record.outcome = record::Outcome::measured;
    record.kernel_hash = "k";
    const double between = noise_ * scatter();
    for (const char* device : devices) {
      record.device = device;
      record.wall_ns.clear();
      const double speed = record.device == "gl:one" ? 0 : 0.7;
      for (int frame = 0; frame < 8; ++frame) {
        record.wall_ns.push_back(std::exp(log_ns + speed + between + noise_ * scatter()));
      }
      store_.add_record(record);
    }
  }

  // A run of 36 configurations, with its anchors before it.
  void measure(double percent) {
    const std::string id = fmt::format("run{}", ++runs_);
    const std::string anchors_id = id + "-anchors";
    store_.add_run({anchors_id, anchors, "", {}});
    add_devices(anchors_id);
    for (const char* technique : {"anchor_arithmetic", "anchor_fetch", "anchor_memory"}) {
      for (int size = 1; size <= 4; size *= 2) {
        record::Record record{.run = anchors_id, .suite = "anchors", .plan = anchors};
        record.technique = technique;
        record.factors = {{"technique", technique}, {"size", fmt::format("{}", size)}};
        record.configuration = fmt::format("size={},technique={}", size, technique);
        add(record, 14.5 + std::log(size));
      }
    }
    store_.add_run({id, plan, "", {}});
    add_devices(id);
    for (int i = 0; i < 36; ++i) {
      record::Record record{.run = id, .suite = "volume", .plan = plan};
      record.technique = "raycast";
      record.factors = {{"technique", "raycast"},
                        {"data", fmt::format("d{}", i % 3)},
                        {"step", fmt::format("{}", i / 3)}};
      record.configuration = fmt::format("data=d{},step={}", i % 3, i / 3);
      record.counters = {{"samples", 100000}};
      record.data_hash = record.factors.at("data");
      if (percent > 0) record.planted = fmt::format("slowdown:{}", percent);
      add(record, 14 + 0.08 * i + std::log1p(percent / 100));
    }
  }

  Tallies evaluate(std::uint64_t seed = 1) {
    const auto pools = pool_runs(store_);
    EXPECT_EQ(pools.size(), 1U);
    return evaluate_runs(pools.at(0), {.most = 6, .seed = seed},
                         folder_.path() / fmt::format("scratch{}", ++scratch_));
  }

  static Tally sum(const Tallies& tallies, std::string_view method, Spread spread,
                   double percent = 0, bool confirmed = false) {
    Tally total;
    const auto add = [](Rate& to, const Rate& from) {
      to.hits += from.hits;
      to.trials += from.trials;
    };
    for (const auto& [kind, tally] : tallies) {
      if (!kind.method.starts_with(method) || kind.spread != spread || kind.percent != percent ||
          kind.confirmed != confirmed) {
        continue;
      }
      for (const auto rate :
           {&Tally::detected, &Tally::found, &Tally::false_alarms, &Tally::false_discoveries,
            &Tally::undecided, &Tally::first_named, &Tally::split, &Tally::in_doubt,
            &Tally::left_open, &Tally::same_bytes, &Tally::to_be_caught}) {
        add(total.*rate, tally.*rate);
      }
    }
    return total;
  }

  double noise_ = 0.003;
  TemporaryFolder folder_;
  record::Store store_;

 private:
  double scatter() { return random_.uniform(-1, 1) + random_.uniform(-1, 1); }
  core::Random random_{17};
  int runs_ = 0;
  int scratch_ = 0;
};

void expect_all(const Rate& rate) {
  EXPECT_GT(rate.trials, 0U);
  EXPECT_EQ(rate.hits, rate.trials);
}

void expect_none(const Rate& rate) {
  EXPECT_GT(rate.trials, 0U);
  EXPECT_EQ(rate.hits, 0U);
}

TEST_F(EvaluateRuns, PoolsHoldWholeRunsWithTheirAnchors) {
  measure(0);
  measure(25);
  measure(0);
  store_.add_run({"broken", plan, "", {}});
  const auto pools = pool_runs(store_);
  ASSERT_EQ(pools.size(), 1U);
  ASSERT_EQ(pools[0].unplanted.size(), 2U);
  EXPECT_EQ(pools[0].unplanted[1].run, "run3");
  EXPECT_EQ(pools[0].unplanted[1].anchors.at(0).run, "run3-anchors");
  ASSERT_EQ(pools[0].planted.size(), 1U);
  EXPECT_EQ(pools[0].planted[0].percent, 25);
}

TEST_F(EvaluateRuns, APlantedRunIsBesideTheNearestUnplantedOne) {
  for (const double percent : {0, 25, 10, 5, 0, 25, 0}) measure(percent);
  const auto pools = pool_runs(store_);
  ASSERT_EQ(pools.size(), 1U);
  std::vector<std::size_t> beside;
  for (const PooledRun& run : pools[0].planted) beside.push_back(run.beside);
  EXPECT_EQ(beside, (std::vector<std::size_t>{0, 0, 1, 1}));
}

// What two launches share, they would confirm.
TEST_F(EvaluateRuns, NoTwoPlantedRunsOfASizeAreBesideOneUnplantedRun) {
  for (const double percent : {0, 0, 25, 25, 10, 25}) measure(percent);
  const auto pools = pool_runs(store_);
  ASSERT_EQ(pools.size(), 1U);
  std::vector<std::size_t> beside;
  for (const PooledRun& run : pools[0].planted) beside.push_back(run.beside);
  EXPECT_EQ(beside, (std::vector<std::size_t>{1, 0, 1, 1}));  // the last found both taken
}

TEST_F(EvaluateRuns, FindsWhatIsPlantedAndNamesIt) {
  for (int round = 0; round < 6; ++round) {
    measure(0);
    if (round == 2) measure(25);
  }
  const Tallies tallies = evaluate();
  for (const char* method : {"history", "correlation"}) {
    SCOPED_TRACE(method);
    for (const Spread spread :
         {Spread::configuration, Spread::level, Spread::api, Spread::global}) {
      SCOPED_TRACE(name_of(spread));
      expect_all(sum(tallies, method, spread, 25).detected);
    }
    EXPECT_EQ(sum(tallies, method, Spread::none).false_alarms.hits, 0U);
    EXPECT_EQ(sum(tallies, method, Spread::none).undecided.hits, 0U);
    // Nothing of one trial is left in the next.
    expect_none(sum(tallies, method, Spread::configuration, 25).false_alarms);
  }
  expect_none(sum(tallies, "correlation", Spread::device, 25).false_alarms);
  expect_none(sum(tallies, "history", Spread::device, 25).false_alarms);
  expect_all(sum(tallies, "correlation", Spread::configuration, 25).first_named);
  expect_all(sum(tallies, "correlation", Spread::configuration, 25).split);
  for (const auto& [kind, tally] : tallies) {
    if (kind.percent == 0 || kind.spread == Spread::device || kind.confirmed) continue;
    ASSERT_FALSE(tally.costs.empty());
    for (const double cost : tally.costs) EXPECT_NEAR(cost, std::log(1.25), 0.05);
  }
  expect_all(sum(tallies, "correlation", Spread::level, 25).first_named);
  // Every level costs more than a twentieth, about half of the configurations a quarter or more.
  const Tally levels = sum(tallies, "correlation", Spread::level, 25);
  EXPECT_EQ(levels.to_be_caught.trials, levels.detected.trials);
  const Tally single = sum(tallies, "correlation", Spread::configuration, 25);
  EXPECT_GT(single.to_be_caught.trials, 0U);
  EXPECT_LT(single.to_be_caught.trials, single.detected.trials);
  expect_all(sum(tallies, "correlation", Spread::scrambled).detected);
  expect_all(sum(tallies, "gate", Spread::none).same_bytes);
  // Two devices, accepted or not.
  EXPECT_EQ(sum(tallies, "correlation", Spread::none).false_alarms.trials, 4U * 6U);
}

TEST_F(EvaluateRuns, WhatASecondRunShowsTooIsConfirmed) {
  for (int round = 0; round < 7; ++round) {
    measure(0);
    if (round == 2 || round == 4) measure(25);
  }
  const Tallies tallies = evaluate();
  for (const char* method : {"history", "correlation"}) {
    SCOPED_TRACE(method);
    for (const Spread spread : {Spread::configuration, Spread::level, Spread::global}) {
      SCOPED_TRACE(name_of(spread));
      expect_all(sum(tallies, method, spread, 25, true).detected);
      EXPECT_EQ(sum(tallies, method, spread, 25, true).detected.trials,
                sum(tallies, method, spread, 25).detected.trials);
    }
  }
}

// One run in seven is slow in a third of its configurations, on each device: a suspect of that run
// and of no other.
TEST_F(EvaluateRuns, ASlowMinuteIsNotConfirmed) {
  for (int round = 0; round < 7; ++round) measure(0);
  std::vector<record::Record> slow = store_.records("run3");
  for (std::size_t i = 0; i < slow.size(); i += 3) {
    for (double& ns : slow[i].wall_ns) ns *= 1.4;
    store_.add_record(slow[i]);
  }
  const Tallies tallies = evaluate();
  const Rate once = sum(tallies, "history", Spread::none).false_alarms;
  const Rate confirmed = sum(tallies, "history", Spread::none, 0, true).false_alarms;
  EXPECT_GE(once.hits, 2U);
  EXPECT_EQ(confirmed.hits, 0U);
  EXPECT_EQ(confirmed.trials, once.trials);
  const Rate again = sum(tallies, "history", Spread::none).in_doubt;
  EXPECT_GE(again.hits, once.hits);
  EXPECT_LT(again.hits, again.trials);
  EXPECT_EQ(sum(tallies, "history", Spread::none, 0, true).in_doubt.trials, 0U);
}

// A third of a run's times are longer, and its rounds too far apart to call that slower.
TEST_F(EvaluateRuns, WhatNoiseLeavesOpenASecondLaunchTells) {
  for (int round = 0; round < 7; ++round) measure(0);
  std::vector<record::Record> noisy = store_.records("run3");
  for (std::size_t i = 0; i < noisy.size(); i += 3) {
    for (double& ns : noisy[i].wall_ns) ns *= 1.4;
    noisy[i].rounds_ns = {noisy[i].wall_ns.front(), 2 * noisy[i].wall_ns.front()};
    store_.add_record(noisy[i]);
  }
  const Tallies tallies = evaluate();
  const Rate once = sum(tallies, "history", Spread::none).left_open;
  const Rate confirmed = sum(tallies, "history", Spread::none, 0, true).left_open;
  EXPECT_GT(once.hits, 0U);
  EXPECT_LT(confirmed.hits, once.hits);
  EXPECT_EQ(confirmed.trials, once.trials);
  EXPECT_GE(sum(tallies, "history", Spread::none).in_doubt.hits, once.hits);
}

TEST_F(EvaluateRuns, OnePlantedRunHasNoSecond) {
  for (int round = 0; round < 7; ++round) {
    measure(0);
    if (round == 2) measure(25);
  }
  const Tallies tallies = evaluate();
  EXPECT_GT(sum(tallies, "history", Spread::level, 25).detected.trials, 0U);
  EXPECT_EQ(sum(tallies, "history", Spread::level, 25, true).detected.trials, 0U);
  EXPECT_GT(sum(tallies, "history", Spread::none, 0, true).false_alarms.trials, 0U);
}

// Five are left to judge the first by, four to judge the second.
TEST_F(EvaluateRuns, SixRunsAreTooFewToConfirm) {
  for (int round = 0; round < 6; ++round) measure(0);
  const Tallies tallies = evaluate();
  EXPECT_GT(sum(tallies, "history", Spread::none).false_alarms.trials, 0U);
  EXPECT_EQ(sum(tallies, "", Spread::none, 0, true).false_alarms.trials, 0U);
}

TEST_F(EvaluateRuns, TooFewRunsTellNothingOfHistory) {
  for (int round = 0; round < 3; ++round) measure(0);
  const Tallies tallies = evaluate();
  expect_all(sum(tallies, "history", Spread::none).undecided);
  expect_none(sum(tallies, "history", Spread::none).false_alarms);
}

TEST_F(EvaluateRuns, NoiseHidesASlowdownAndIsCounted) {
  noise_ = 0.2;
  for (int round = 0; round < 6; ++round) {
    measure(0);
    if (round == 2) measure(5);
  }
  const Tally planted = sum(evaluate(), "history", Spread::configuration, 5);
  EXPECT_LT(planted.detected.hits, planted.detected.trials / 2);
  EXPECT_GT(planted.undecided.share(), 0.5);
}

TEST_F(EvaluateRuns, OneRunIsNoMaterial) {
  measure(0);
  EXPECT_TRUE(evaluate().empty());
}

}  // namespace
}  // namespace triptych::judge
