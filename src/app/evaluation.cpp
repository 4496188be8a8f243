#include "app/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "app/paths.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "judge/timing/anchor.hpp"
#include "measure/runner.hpp"
#include "measure/stopwatch.hpp"
#include "measure/turns.hpp"

namespace triptych::app {
namespace {

using measure::Side;
using measure::TurnClock;

std::string fault_of(double percent) {
  return fmt::format("slowdown:{}", percent);
}

std::vector<std::string> worker_command() {
  return {own_program(), "worker", "--device"};
}

// One device and plan, its two sides held by one pair of workers after another.
class BlockMeasuring {
 public:
  BlockMeasuring(const EvaluationMaterial& material, const measure::Plan& plan,
                 const measure::Suite& suite, const std::string& device)
      : material_(material),
        plan_(plan),
        suite_(suite),
        device_(device),
        configurations_(covering(plan, static_cast<std::size_t>(material.configurations))),
        turns_({.suite = plan.suite,
                .kinds = measure::work_kinds(plan),
                .limit = material.limit,
                .seed = material.seed},
               {.device = device, .command = worker_command(), .environment = {}},
               {.device = device, .command = worker_command(), .environment = {}}) {}

  // False when nothing can be measured any more.
  bool launch(int number, std::ostream& out, const TellStep& tell) {
    if (std::exchange(launched_, true)) turns_.relaunch();
    std::erase_if(configurations_, [&](const measure::Configuration& configuration) {
      const std::string key = measure::configuration_key(suite_, configuration);
      tell(fmt::format("{} {} launch {}: {}", device_, plan_.name, number, key));
      try {
        one(number, configuration, key, out);
      } catch (const measure::SideEnded& ended) {
        tell(fmt::format("left out: {}", ended.what()));
        return true;
      }
      return false;
    });
    turns_.release();
    return !configurations_.empty();
  }

 private:
  // By an ordinary measurement, once.
  TurnClock clock_of(const measure::Configuration& configuration, const std::string& key) {
    const auto known = clocks_.find(key);
    if (known != clocks_.end()) return known->second;
    const measure::Answer answer = turns_.measure(Side::a, {.name = key,
                                                            .configuration = configuration,
                                                            .protocol = {.warm_up_frames = 2,
                                                                         .timed_frames = 8,
                                                                         .least_loop_ns = 0,
                                                                         .most_loop_frames = 1,
                                                                         .statistics = false,
                                                                         .counters = false},
                                                            .plants = {}});
    const TurnClock clock =
        answer.record.device_clock_trusted ? TurnClock::device : TurnClock::wall;
    return clocks_.emplace(key, clock).first->second;
  }

  // As many as a comparison's first launch would take, and no fewer than a fresh one.
  std::vector<measure::Block> until_told(TurnClock clock) {
    const judge::ReplayDesign design;
    std::vector<measure::Block> blocks;
    const auto told = [&] {
      return judge::look_at(measure::differences(blocks, clock), design.looks).verdict !=
             judge::PairVerdict::undecided;
    };
    for (const int look : design.looks.looks) {
      if (look > material_.blocks && !blocks.empty()) break;
      while (static_cast<int>(blocks.size()) < look) blocks.push_back(turns_.block());
      if (blocks.size() >= design.confirmation.blocks_per_launch && told()) break;
    }
    return blocks;
  }

  void one(int number, const measure::Configuration& configuration, const std::string& key,
           std::ostream& out) {
    const TurnClock clock = clock_of(configuration, key);
    std::vector<double> sizes = material_.sizes;
    sizes.insert(sizes.begin(), 0);
    for (const double percent : sizes) {
      const measure::Stopwatch stopwatch;
      std::vector<std::string> planted;
      if (percent > 0) planted.push_back(fault_of(percent));
      turns_.hold(configuration, {std::vector<std::string>{}, planted}, clock);
      const std::vector<measure::Block> blocks = until_told(clock);
      const bool by_device = clock == TurnClock::device && measure::device_clock_holds(blocks);
      const TurnClock used = by_device ? TurnClock::device : TurnClock::wall;
      core::Json line{{"plan", plan_.name},
                      {"configuration", key},
                      {"factors", configuration},
                      {"device", device_},
                      {"key", turns_.hello(Side::a).device.key()},
                      {"percent", percent},
                      {"launch", number},
                      {"clock", by_device ? "device" : "wall"},
                      {"frames_per_turn", turns_.frames_per_turn()},
                      {"times_per_block", turns_.times_per_block()},
                      {"seconds", stopwatch.seconds()},
                      {"differences", core::Json::array()}};
      // A ten-millionth of a turn is nothing.
      for (const double d : measure::differences(blocks, used)) {
        line["differences"].push_back(std::round(d * 1e7) / 1e7);
      }
      out << core::json_text(line) << '\n' << std::flush;
    }
  }

  const EvaluationMaterial& material_;
  const measure::Plan& plan_;
  const measure::Suite& suite_;
  std::string device_;
  std::vector<measure::Configuration> configurations_;
  measure::Turns turns_;
  std::map<std::string, TurnClock> clocks_;
  bool launched_ = false;
};

int last_launch(const std::filesystem::path& file, const TellStep& tell) {
  int last = 0;
  for (const judge::BlockSeries& series : read_blocks(file, tell)) {
    last = std::max(last, series.launch);
  }
  return last;
}

// What is added to the file begins a line of its own.
void cut_unfinished_line(const std::filesystem::path& file) {
  std::uintmax_t ended = 0;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line) && !in.eof();) ended += line.size() + 1;
  if (in.is_open()) std::filesystem::resize_file(file, ended);
}

}  // namespace

std::vector<measure::Configuration> covering(const measure::Plan& plan, std::size_t count) {
  std::vector<measure::Configuration> chosen;
  std::vector<bool> taken(plan.configurations.size(), false);
  std::set<std::pair<std::string, std::string>> covered;
  const auto gain = [&](const measure::Configuration& each) {
    return std::ranges::count_if(plan.varied, [&](const std::string& factor) {
      return !covered.contains({factor, each.at(factor)});
    });
  };
  while (chosen.size() < std::min(count, plan.configurations.size())) {
    std::size_t best = plan.configurations.size();
    for (std::size_t i = 0; i < plan.configurations.size(); ++i) {
      if (taken[i]) continue;
      const bool better = best == plan.configurations.size() ||
                          gain(plan.configurations[i]) > gain(plan.configurations[best]);
      if (better) best = i;
    }
    taken[best] = true;
    chosen.push_back(plan.configurations[best]);
    for (const std::string& factor : plan.varied) {
      covered.emplace(factor, chosen.back().at(factor));
    }
    const bool all =
        std::ranges::none_of(plan.configurations, [&](const auto& each) { return gain(each) > 0; });
    if (all) covered.clear();
  }
  return chosen;
}

void measure_blocks(const EvaluationMaterial& material, const Registry& registry,
                    const std::filesystem::path& file, const TellStep& tell) {
  const int before = last_launch(file, tell);
  cut_unfinished_line(file);
  std::ofstream out(file, std::ios::app);
  const auto parts = static_cast<double>(material.plans.size() * material.devices.size());
  for (const std::string& device : material.devices) {
    for (const measure::Plan& plan : material.plans) {
      const measure::Stopwatch stopwatch;
      const auto in_time = [&] {
        return !material.budget ||
               stopwatch.seconds() < static_cast<double>(material.budget->count()) / parts;
      };
      BlockMeasuring measuring(material, plan, registry.suite(plan.suite), device);
      for (int i = 1; i <= material.launches && (i == 1 || in_time()); ++i) {
        if (!measuring.launch(before + i, out, tell)) break;
        if (!out) throw core::IoError(fmt::format("cannot write {}", file.string()));
      }
    }
  }
}

void measure_runs(const EvaluationMaterial& material, const Registry& registry,
                  record::Store& store, const TellStep& tell) {
  const measure::Stopwatch stopwatch;
  const measure::Plan anchors = measure::load_plan(judge::anchors_plan, {}, registry.find_suite());
  const measure::RunOptions plain{.limit = material.limit, .worker_command = worker_command()};
  const auto run = [&](double percent) {
    const bool late =
        material.budget && stopwatch.seconds() >= static_cast<double>(material.budget->count());
    if (late) return;
    measure::RunOptions options = plain;
    if (percent > 0) options.plants.push_back({.fault = fault_of(percent), .only = {}});
    std::vector<measure::PlannedRun> runs{{anchors, registry.suite(anchors.suite), plain}};
    for (const measure::Plan& plan : material.plans) {
      runs.push_back({plan, registry.suite(plan.suite), options});
    }
    tell(fmt::format("runs with {} % planted", percent));
    static_cast<void>(measure::run_plans(runs, material.devices, store, {}));
  };
  for (int round = 0; round < material.rounds; ++round) {
    run(0);
    if (round >= material.planted_rounds) continue;
    for (const double percent : material.sizes) run(percent);
  }
}

std::vector<judge::BlockSeries> read_blocks(const std::filesystem::path& file,
                                            const TellStep& tell) {
  std::vector<judge::BlockSeries> result;
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (in.eof()) {
      tell(fmt::format("{}:{}: left out, its writer did not end it", file.string(), number));
      break;
    }
    try {
      const core::Json json = core::Json::parse(line);
      result.push_back({.plan = json.at("plan"),
                        .configuration = json.at("configuration"),
                        .factors = json.at("factors"),
                        .device = json.at("device"),
                        .percent = json.at("percent"),
                        .launch = json.at("launch"),
                        .seconds = json.at("seconds"),
                        .differences = json.at("differences")});
    } catch (const core::Json::exception& error) {
      throw core::InputError(
          fmt::format("{}:{}: expected a line as `triptych evaluate --measure` writes it: {}",
                      file.string(), number, error.what()));
    }
    const bool finite =
        std::ranges::all_of(result.back().differences, [](double d) { return std::isfinite(d); });
    if (!finite || result.back().differences.empty()) {
      throw core::InputError(
          fmt::format("{}:{}: expected differences of blocks", file.string(), number));
    }
  }
  return result;
}

}  // namespace triptych::app
