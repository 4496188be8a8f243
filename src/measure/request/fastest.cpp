#include "measure/request/fastest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/quoting.hpp"
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

std::optional<Candidate> counted(const Record& record) {
  const auto instructions = record.instructions();
  if (!instructions) return std::nullopt;
  const auto amount = static_cast<double>(*instructions);
  return Candidate{&record, amount, amount};
}

std::optional<Candidate> timed(const Record& record, std::string_view clock) {
  const auto summary = record::summarise(record.time_ns_by(clock));
  if (!summary) return std::nullopt;
  return Candidate{&record, summary->minimum, summary->median};
}

ComparedQuantity quantity_of(const std::vector<const Record*>& measured) {
  if (std::ranges::any_of(measured, [](const Record* each) { return !each->cost.empty(); })) {
    return ComparedQuantity::instructions;
  }
  const auto by_device = [](const Record* each) { return each->clock() == "device"; };
  return std::ranges::all_of(measured, by_device) ? ComparedQuantity::device_clock
                                                  : ComparedQuantity::wall_clock;
}

// Sorts the candidates (measured records that are compared), and keeps only the fastest candidate
// for each combination of levels of the chosen factors.
void keep_fastest(std::vector<Candidate>& candidates, const std::set<std::string>& chosen) {
  std::ranges::stable_sort(candidates, {}, &Candidate::amount);
  std::set<std::string> seen;
  std::erase_if(candidates, [&](const Candidate& each) {
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
  answer.quantity = quantity_of(measured);
  for (const Record* each : measured) {
    const auto candidate =
        answer.quantity == ComparedQuantity::instructions
            ? counted(*each)
            : timed(*each, answer.quantity == ComparedQuantity::device_clock ? "device" : "wall");
    if (candidate) answer.candidates.push_back(*candidate);
  }
  keep_fastest(answer.candidates, chosen);
  return answer;
}

std::string describe_fastest(const Candidate& candidate, ComparedQuantity quantity) {
  if (quantity == ComparedQuantity::instructions) {
    return fmt::format("executes the fewest instructions, {:.1f} million", candidate.amount / 1e6);
  }
  return fmt::format("is the fastest, minimum {:.3f} ms, median {:.3f} ms ({} clock)",
                     candidate.amount / 1e6, candidate.median / 1e6,
                     quantity == ComparedQuantity::device_clock ? "device" : "wall");
}

// Removes from the plan the techniques that needed more than twice the time (or the instructions)
// of the fastest technique.
void drop_slow_techniques(Plan& plan, const FastestAnswer& answer) {
  std::set<std::string> techniques;
  for (const Candidate& each : answer.candidates) {
    if (each.amount <= 2 * answer.candidates.front().amount) {
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

FastestTrials find_fastest(Plan plan, const Suite& suite,
                           const std::function<std::vector<record::Record>(const Plan&)>& trial) {
  FastestTrials trials{.records = trial(plan), .answers = {}};
  const auto answer = [&] {
    trials.answers = answer_fastest(trials.records, suite, plan.automatic);
  };
  answer();
  if (trials.answers.empty() || trials.answers.front().candidates.empty()) return trials;
  drop_slow_techniques(plan, trials.answers.front());
  if (plan.configurations.size() > 1) {
    std::ranges::move(trial(plan), std::back_inserter(trials.records));
    answer();
  }
  return trials;
}

namespace {

// Groups the levels that were not drawn by the reason, in a few words. The groups keep the order of
// the records.
std::vector<std::pair<std::string, std::vector<std::string>>> not_drawn_by_reason(
    const FastestAnswer& answer, const std::set<std::string>& chosen) {
  constexpr std::size_t longest_reason = 60;
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const Record* record : answer.not_drawn) {
    const std::string& detail = record->reason.detail;
    const std::string reason = detail.empty() ? std::string(record::name_of(record->outcome))
                                              : core::printable(detail, longest_reason);
    auto group = std::ranges::find(groups, reason, [](const auto& each) { return each.first; });
    if (group == groups.end()) group = groups.insert(group, {reason, {}});
    group->second.push_back(chosen_levels(*record, chosen));
  }
  return groups;
}

}  // namespace

std::string describe(const FastestAnswer& answer, const std::set<std::string>& chosen) {
  std::string text = fmt::format("{} {}: ", answer.device, answer.scene);
  if (answer.candidates.empty()) {
    text += "no technique was measured, so none can be recommended";
  } else {
    const Candidate& best = answer.candidates.front();
    const bool counted = answer.quantity == ComparedQuantity::instructions;
    text += fmt::format("{} {}", chosen_levels(*best.record, chosen),
                        describe_fastest(best, answer.quantity));
    for (std::size_t i = 1; i < answer.candidates.size(); ++i) {
      const Candidate& each = answer.candidates[i];
      text += fmt::format("{}{} {} {:.2f} times as {}{}", i == 1 ? "; " : ", ",
                          chosen_levels(*each.record, chosen), counted ? "executes" : "takes",
                          each.amount / best.amount, counted ? "many" : "long",
                          each.amount <= best.median ? " (no clear difference)" : "");
    }
  }
  std::string_view separator = "; not drawn: ";
  for (const auto& [reason, levels] : not_drawn_by_reason(answer, chosen)) {
    text +=
        fmt::format("{}{} ({})", std::exchange(separator, "; "), fmt::join(levels, ", "), reason);
  }
  return text;
}

}  // namespace triptych::measure
