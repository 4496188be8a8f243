#include "app/evaluation_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/json.hpp"
#include "judge/statistics/statistics.hpp"

namespace triptych::app {
namespace {

using judge::Rate;
using judge::Tally;
using judge::TrialKind;

constexpr std::array<std::pair<const char*, Rate Tally::*>, 11> rates{{
    {"detected", &Tally::detected},
    {"found", &Tally::found},
    {"to_be_caught", &Tally::to_be_caught},
    {"false_alarms", &Tally::false_alarms},
    {"false_discoveries", &Tally::false_discoveries},
    {"cannot_tell", &Tally::undecided},
    {"first_named", &Tally::first_named},
    {"work_or_throughput", &Tally::split},
    {"left_open", &Tally::left_open},
    {"measured_again", &Tally::in_doubt},
    {"same_bytes", &Tally::same_bytes},
}};

std::string text_of(const Rate& rate) {
  if (rate.trials == 0) return "-";
  const judge::Interval interval = rate.interval();
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}] {}/{}", 100 * rate.share(), 100 * interval.low,
                     100 * interval.high, rate.hits, rate.trials);
}

core::Json json_of(const Rate& rate) {
  const judge::Interval interval = rate.interval();
  return {{"hits", rate.hits},
          {"trials", rate.trials},
          {"share", rate.share()},
          {"low", interval.low},
          {"high", interval.high}};
}

core::Json json_of(const TrialKind& kind) {
  return {{"method", kind.method},
          {"plan", kind.plan},
          {"subject", kind.subject},
          {"spread", judge::name_of(kind.spread)},
          {"confirmed", kind.confirmed}};
}

double seconds_each(const Tally& tally) {
  return tally.seconds / static_cast<double>(tally.configurations);
}

// As a ratio of times.
std::optional<double> cost_of(const Tally& tally) {
  if (tally.costs.empty()) return std::nullopt;
  return std::exp(judge::median(tally.costs));
}

// Trials that one run judged and no second one could confirm.
std::size_t without_second_run(const judge::Tallies& tallies, const TrialKind& kind) {
  const bool could_be = kind.method == "history" || kind.method.starts_with("correlation");
  if (!could_be || kind.confirmed || kind.spread == judge::Spread::scrambled) return 0;
  TrialKind confirmed = kind;
  confirmed.confirmed = true;
  const auto own = tallies.find(confirmed);
  return tallies.at(kind).false_alarms.trials -
         (own == tallies.end() ? 0 : own->second.false_alarms.trials);
}

std::string heading(const TrialKind& kind) {
  return fmt::format("{}, {}, {}", kind.method, kind.plan, kind.subject);
}

std::string smallest_text(const judge::Tallies& tallies) {
  std::string text = "\nsmallest size from which on 95 % of the trials were found\n";
  for (const auto& [kind, percent] : judge::smallest_found(tallies)) {
    text += fmt::format("  {:<8} {}, {}{}\n", percent ? fmt::format("{} %", *percent) : "none",
                        heading(kind), judge::name_of(kind.spread),
                        kind.confirmed ? ", confirmed" : "");
  }
  return text;
}

std::string by_cost_text(const judge::Tallies& tallies) {
  const auto found = judge::found_by_cost(tallies);
  if (found.empty()) return {};
  std::string text = "\nof single configurations in turns, found by what the planted work cost\n";
  for (const auto& [percent, rate] : found) {
    text += fmt::format("  {:>2.0f} % and more  {}\n", percent, text_of(rate));
  }
  return text;
}

std::string judging_text(const judge::Tallies& tallies) {
  const auto pairs = judge::judging_pairs(tallies);
  if (pairs.empty()) return {};
  std::string text = "\npairs of devices that judge: admitted in most A/A runs\n";
  for (const judge::JudgingPair& pair : pairs) {
    text += fmt::format("  {}, {}, {}\n", pair.method, pair.plan, pair.subject);
  }
  return text;
}

std::string aims_text(const judge::Tallies& tallies) {
  std::string text = "\naims\n";
  for (const judge::Aim& aim : judge::aims(tallies)) {
    const auto met = aim.met();
    text += fmt::format("  {:<10} {} ({} {:.0f} %): {}\n",
                        !met   ? "not tried"
                        : *met ? "met"
                               : "missed",
                        aim.text, aim.at_least ? "at least" : "at most", 100 * aim.bound,
                        text_of(aim.rate));
  }
  return text;
}

}  // namespace

std::string to_text(const judge::Tallies& tallies) {
  std::string text;
  std::string last;
  for (const auto& [kind, tally] : tallies) {
    if (heading(kind) != last) text += (last = heading(kind)) + "\n";
    text += fmt::format("  {}", judge::name_of(kind.spread));
    if (kind.percent > 0) text += fmt::format(" {} %", kind.percent);
    if (kind.confirmed) text += ", confirmed";
    if (const auto cost = cost_of(tally)) {
      text += fmt::format(", which cost {:+.1f} %", 100 * (*cost - 1));
    }
    for (const auto& [name, rate] : rates) {
      if ((tally.*rate).trials > 0) text += fmt::format("; {} {}", name, text_of(tally.*rate));
    }
    if (tally.seconds > 0) text += fmt::format("; {:.1f} s a configuration", seconds_each(tally));
    const std::size_t alone = without_second_run(tallies, kind);
    if (alone > 0) text += fmt::format("; {} trials without a second run", alone);
    text += "\n";
  }
  return text + smallest_text(tallies) + by_cost_text(tallies) + judging_text(tallies) +
         aims_text(tallies);
}

nlohmann::json to_json(const judge::Tallies& tallies) {
  core::Json json{{"trials", core::Json::array()},
                  {"smallest_found", core::Json::array()},
                  {"found_by_cost", core::Json::array()},
                  {"judging_pairs", core::Json::array()},
                  {"aims", core::Json::array()}};
  for (const auto& [kind, tally] : tallies) {
    core::Json row = json_of(kind);
    row["percent"] = kind.percent;
    for (const auto& [name, rate] : rates) {
      if ((tally.*rate).trials > 0) row[name] = json_of(tally.*rate);
    }
    if (const auto cost = cost_of(tally)) row["cost"] = *cost;
    const std::size_t alone = without_second_run(tallies, kind);
    if (alone > 0) row["without_second_run"] = alone;
    if (tally.seconds > 0) row["seconds_per_configuration"] = seconds_each(tally);
    json["trials"].push_back(std::move(row));
  }
  for (const auto& [kind, percent] : judge::smallest_found(tallies)) {
    core::Json row = json_of(kind);
    row["percent"] = percent ? core::Json(*percent) : core::Json();
    json["smallest_found"].push_back(std::move(row));
  }
  for (const auto& [percent, rate] : judge::found_by_cost(tallies)) {
    core::Json row = json_of(rate);
    row["percent"] = percent;
    json["found_by_cost"].push_back(std::move(row));
  }
  for (const judge::JudgingPair& pair : judge::judging_pairs(tallies)) {
    json["judging_pairs"].push_back(
        {{"method", pair.method}, {"plan", pair.plan}, {"subject", pair.subject}});
  }
  for (const judge::Aim& aim : judge::aims(tallies)) {
    core::Json row = aim.rate.trials > 0 ? json_of(aim.rate) : core::Json::object();
    row["aim"] = aim.text;
    row["bound"] = aim.bound;
    row["at_least"] = aim.at_least;
    row["met"] = aim.met() ? core::Json(*aim.met()) : core::Json();
    json["aims"].push_back(std::move(row));
  }
  return json;
}

}  // namespace triptych::app
