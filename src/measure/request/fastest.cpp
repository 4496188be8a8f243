#include "measure/request/fastest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

using record::Record;

std::string scene_of(const Suite& suite, Configuration configuration,
                     const std::set<std::string>& chosen) {
  std::string key;
  for (const auto& [factor, level] :
       record::parse_factor_list(configuration_key(suite, std::move(configuration)))) {
    if (!chosen.contains(factor)) key += (key.empty() ? "" : ",") + factor + "=" + level;
  }
  return key;
}

std::string chosen_levels(const Record& record, const std::set<std::string>& chosen) {
  std::string text;
  for (const std::string& factor : chosen) {
    text += (text.empty() ? "" : ",") + record.factors.at(factor);
  }
  return text;
}

std::optional<Contestant> counted(const Record& record) {
  const auto instructions = record.instructions();
  if (!instructions) return std::nullopt;
  const auto amount = static_cast<double>(*instructions);
  return Contestant{&record, amount, amount};
}

std::optional<Contestant> timed(const Record& record, std::string_view clock) {
  const auto summary = record::summarise(record.time_ns_by(clock));
  if (!summary) return std::nullopt;
  return Contestant{&record, summary->minimum, summary->median};
}

Ruler ruler_of(const std::vector<const Record*>& measured) {
  if (std::ranges::any_of(measured, [](const Record* each) { return !each->cost.empty(); })) {
    return Ruler::instructions;
  }
  const auto by_device = [](const Record* each) { return each->clock() == "device"; };
  return std::ranges::all_of(measured, by_device) ? Ruler::device_clock : Ruler::wall_clock;
}

// Sorts the contestants (measured records that are compared), and keeps only the fastest contestant
// for each combination of levels of the chosen factors.
void keep_fastest(std::vector<Contestant>& contestants, const std::set<std::string>& chosen) {
  std::ranges::stable_sort(contestants, {}, &Contestant::amount);
  std::set<std::string> seen;
  std::erase_if(contestants, [&](const Contestant& each) {
    return !seen.insert(chosen_levels(*each.record, chosen)).second;
  });
}

FastestAnswer answer_of(const std::vector<const Record*>& records,
                        const std::set<std::string>& chosen) {
  FastestAnswer answer;
  std::vector<const Record*> measured;
  for (const Record* each : records) {
    (each->outcome == record::Outcome::measured ? measured : answer.not_drawn).push_back(each);
  }
  answer.ruler = ruler_of(measured);
  for (const Record* each : measured) {
    const auto contestant =
        answer.ruler == Ruler::instructions
            ? counted(*each)
            : timed(*each, answer.ruler == Ruler::device_clock ? "device" : "wall");
    if (contestant) answer.contestants.push_back(*contestant);
  }
  keep_fastest(answer.contestants, chosen);
  return answer;
}

std::string praise(const Contestant& contestant, Ruler ruler) {
  if (ruler == Ruler::instructions) {
    return fmt::format("executes the fewest instructions, {:.1f} million", contestant.amount / 1e6);
  }
  return fmt::format("is the fastest, minimum {:.3f} ms, median {:.3f} ms ({} clock)",
                     contestant.amount / 1e6, contestant.usually / 1e6,
                     ruler == Ruler::device_clock ? "device" : "wall");
}

// Removes from the plan the techniques that needed more than twice the time (or the instructions)
// of the fastest technique.
void keep_in_question(Plan& plan, const FastestAnswer& answer) {
  std::set<std::string> techniques;
  for (const Contestant& each : answer.contestants) {
    if (each.amount <= 2 * answer.contestants.front().amount) {
      techniques.insert(each.record->technique);
    }
  }
  std::erase_if(plan.configurations,
                [&](const auto& each) { return !techniques.contains(each.at("technique")); });
}

}  // namespace

std::vector<FastestAnswer> answer_fastest(const std::vector<Record>& records, const Suite& suite,
                                          const std::set<std::string>& chosen) {
  std::map<std::pair<std::string, std::string>, std::vector<const Record*>> groups;
  for (const Record& each : records) {
    groups[{each.device, scene_of(suite, each.factors, chosen)}].push_back(&each);
  }
  std::vector<FastestAnswer> answers;
  for (const auto& [key, group] : groups) {
    const auto levels = [&](const Record* each) { return chosen_levels(*each, chosen); };
    const std::string first = levels(group.front());
    if (std::ranges::all_of(group, [&](const auto* each) { return levels(each) == first; })) {
      continue;
    }
    answers.push_back(answer_of(group, chosen));
    answers.back().device = key.first;
    answers.back().scene = key.second;
  }
  return answers;
}

FastestTried try_for_fastest(Plan plan, const Suite& suite,
                             const std::function<std::vector<record::Record>(const Plan&)>& trial) {
  FastestTried tried{.records = trial(plan), .answers = {}};
  const auto answer = [&] { tried.answers = answer_fastest(tried.records, suite, plan.automatic); };
  answer();
  if (tried.answers.empty() || tried.answers.front().contestants.empty()) return tried;
  keep_in_question(plan, tried.answers.front());
  if (plan.configurations.size() > 1) {
    std::ranges::move(trial(plan), std::back_inserter(tried.records));
    answer();
  }
  return tried;
}

std::string describe(const FastestAnswer& answer, const std::set<std::string>& chosen) {
  std::string text = fmt::format("{} {}: ", answer.device, answer.scene);
  if (answer.contestants.empty()) {
    text += "no technique was measured, so none can be recommended";
  } else {
    const Contestant& best = answer.contestants.front();
    const bool counted = answer.ruler == Ruler::instructions;
    text += fmt::format("{} {}", chosen_levels(*best.record, chosen), praise(best, answer.ruler));
    for (std::size_t i = 1; i < answer.contestants.size(); ++i) {
      const Contestant& each = answer.contestants[i];
      text += fmt::format("{}{} {} {:.2f} times as {}{}", i == 1 ? "; " : ", ",
                          chosen_levels(*each.record, chosen), counted ? "executes" : "takes",
                          each.amount / best.amount, counted ? "many" : "long",
                          each.amount <= best.usually ? " (no clear difference)" : "");
    }
  }
  for (std::size_t i = 0; i < answer.not_drawn.size(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "; not drawn: " : ", ",
                        chosen_levels(*answer.not_drawn[i], chosen));
  }
  return text;
}

}  // namespace triptych::measure
