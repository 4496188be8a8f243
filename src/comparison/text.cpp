#include "comparison/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/json.hpp"
#include "core/quoting.hpp"
#include "record/factor_list.hpp"

namespace triptych::comparison {
namespace {

using judge::Difference;
using judge::DifferenceKind;

// The command that measures this configuration alone, as long as it takes.
std::string settle(const Compared& compared, const ComparisonCommand& command) {
  std::string text =
      fmt::format("triptych compare {} {}", core::shell_quoted(command.plan), command.sides);
  for (const std::string& factor : command.varied) {
    const std::string level = record::factor_list({{factor, compared.configuration.at(factor)}});
    text += " --set " + core::shell_quoted(level);
  }
  return text;
}

std::string_view name_of(measure::TurnClock clock) {
  return clock == measure::TurnClock::device ? "device" : "wall";
}

// "1.052 [1.047, 1.058]"
std::string ratio_of(const judge::Shift& shift) {
  return fmt::format("{:.4f} [{:.4f}, {:.4f}]", std::exp(shift.estimate),
                     std::exp(shift.interval.low), std::exp(shift.interval.high));
}

std::string line_of(const Compared& compared, const ComparisonCommand& command) {
  std::string line = fmt::format("{:<12}", compared.verdict_name());
  if (compared.blocks > 0 && !compared.ended) {
    line += fmt::format("{}  {} blocks", ratio_of(compared.shift), compared.blocks);
    if (compared.launches > 0) line += fmt::format(" and {} fresh launches", compared.launches);
    line += fmt::format(", {} clock", name_of(compared.clock));
  }
  line += fmt::format("  {:.1f} s  {}", compared.seconds, compared.key);
  if (!compared.reason.empty()) line += "\n              " + compared.reason;
  const bool undecided = !compared.ended && compared.verdict == judge::PairVerdict::undecided;
  if (undecided && compared.blocks > 0) line += "; settle it: " + settle(compared, command);
  const auto& work = compared.work;
  if (work && work->log_ratio != 0) {
    line += fmt::format("\n              {:+.2f} % {}, {:+.2f} % time for each",
                        100 * std::expm1(work->log_ratio), work->unit,
                        100 * std::expm1(compared.shift.estimate - work->log_ratio));
  }
  return line + "\n";
}

// Differences of one kind about one thing stand together: one line for how many configurations.
struct Group {
  const Difference* first = nullptr;
  const Compared* where = nullptr;
  int count = 0;
};

std::string differences_text(const ComparisonResult& result) {
  std::map<std::pair<DifferenceKind, std::string>, Group> groups;
  for (const Compared& compared : result.configurations) {
    for (const Difference& difference : compared.differences) {
      Group& group = groups[{difference.kind, difference.about}];
      if (group.count++ > 0) continue;
      group.first = &difference;
      group.where = &compared;
    }
  }
  std::string text;
  for (const auto& [key, group] : groups) {
    const std::string more =
        group.count > 1 ? fmt::format("; and in {} more", group.count - 1) : "";
    text += fmt::format("{:<12}{}: {} ({}{})\n", judge::name_of(key.first), key.second,
                        group.first->text, group.where->key, more);
  }
  return text;
}

std::string clocks_text(const ComparisonResult& result) {
  std::map<std::string, int> reasons;
  for (const Compared& compared : result.configurations) {
    if (!compared.why_wall.empty()) ++reasons[compared.why_wall];
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    text += fmt::format("wall clock in {} configurations: {}\n", count, reason);
  }
  return text;
}

std::string headline(const ComparisonResult& result) {
  std::map<std::string_view, int> counts;
  int regressions = 0;
  for (const Compared& compared : result.configurations) {
    ++counts[compared.verdict_name()];
    for (const Difference& difference : compared.differences) {
      regressions += difference.kind == DifferenceKind::regression ? 1 : 0;
    }
  }
  std::string text;
  switch (result.exit_code()) {
    case core::ExitCode::pass:
      text = "PASS";
      break;
    case core::ExitCode::regression:
      text = "FAIL";
      break;
    default:
      text = "CANNOT TELL";
  }
  text += ":";
  for (const std::string_view verdict : {"slower", "faster", "same", "cannot tell", "skipped"}) {
    if (const auto found = counts.find(verdict); found != counts.end()) {
      text += fmt::format(" {} {},", found->second, verdict);
    }
  }
  return fmt::format("{} {} regressions in what is drawn or counted; {:.0f} s", text, regressions,
                     result.seconds);
}

core::Json to_json(const Compared& compared, const ComparisonCommand& command) {
  core::Json json{{"configuration", compared.key},
                  {"verdict", compared.verdict_name()},
                  {"blocks", compared.blocks},
                  {"seconds", compared.seconds}};
  if (!compared.reason.empty()) json["reason"] = compared.reason;
  if (compared.blocks > 0) {
    json["clock"] = name_of(compared.clock);
    json["frames_per_turn"] = compared.frames_per_turn;
    if (!compared.why_wall.empty()) json["why_wall"] = compared.why_wall;
    if (compared.launches > 0) json["launches"] = compared.launches;
  }
  if (compared.blocks > 0 && !compared.ended) {
    const auto set = [&json](const char* name, double ln) {
      if (std::isfinite(ln)) json[name] = std::exp(ln);
    };
    set("ratio", compared.shift.estimate);
    set("ratio_low", compared.shift.interval.low);
    set("ratio_high", compared.shift.interval.high);
    if (compared.verdict == judge::PairVerdict::undecided) {
      json["settle"] = settle(compared, command);
    }
  }
  if (compared.work) {
    json["work"] = {{"counter", compared.work->unit},
                    {"ln_work", compared.work->log_ratio},
                    {"ln_time_per_work", compared.shift.estimate - compared.work->log_ratio}};
  }
  json["differences"] = core::Json::array();
  for (const Difference& each : compared.differences) {
    json["differences"].push_back(
        {{"kind", judge::name_of(each.kind)}, {"about", each.about}, {"text", each.text}});
  }
  return json;
}

}  // namespace

std::string to_text(const ComparisonResult& result, const ComparisonCommand& command) {
  std::string text = fmt::format("a: {}\nb: {}\nratios are time of b over time of a\n",
                                 result.a.key(), result.b.key());
  for (const Compared& compared : result.configurations) text += line_of(compared, command);
  text += clocks_text(result);
  const std::string differences = differences_text(result);
  if (!differences.empty()) text += "besides time:\n" + differences;
  return text + headline(result) + "\n";
}

core::Json to_json(const ComparisonResult& result, const ComparisonCommand& command) {
  core::Json json{{"plan", command.plan},
                  {"sides", command.sides},
                  {"a", result.a},
                  {"b", result.b},
                  {"seconds", result.seconds},
                  {"exit_code", static_cast<int>(result.exit_code())},
                  {"headline", headline(result)},
                  {"configurations", core::Json::array()}};
  for (const Compared& compared : result.configurations) {
    json["configurations"].push_back(to_json(compared, command));
  }
  return json;
}

}  // namespace triptych::comparison
