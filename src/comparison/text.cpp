#include "comparison/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "core/quoting.hpp"
#include "record/factor_list.hpp"

namespace triptych::comparison {
namespace {

// The command that measures this configuration alone, as long as necessary.
std::string settle(const Compared& compared, const ComparisonCommand& command) {
  std::string text =
      fmt::format("triptych compare {} {}", core::shell_quoted(command.plan), command.sides);
  for (const std::string& factor : command.varied) {
    const std::string level = record::factor_list({{factor, compared.configuration.at(factor)}});
    text += " --set " + core::shell_quoted(level);
  }
  return text;
}

std::string_view name_of(measure::SideClock clock) {
  return clock == measure::SideClock::device ? "device" : "wall";
}

// Formats a shift as "1.052 [1.047, 1.058]".
std::string ratio_of(const Shift& shift) {
  return fmt::format("{:.4f} [{:.4f}, {:.4f}]", std::exp(shift.estimate),
                     std::exp(shift.interval.low), std::exp(shift.interval.high));
}

// Whether its shift is the result of a measurement.
bool has_time(const Compared& compared) {
  return compared.blocks > 0 && !compared.ended;
}

// "+1.20 % samples, +0.31 % time for each", with the second part if it has a time; empty if the
// work is the same.
std::string work_of(const Compared& compared) {
  const auto& work = compared.work;
  if (!work || work->log_ratio == 0) return {};
  const auto percent = [](double ln) { return fmt::format("{:+.2f} %", 100 * std::expm1(ln)); };
  std::string text = fmt::format("{} {}", percent(work->log_ratio), work->unit);
  if (has_time(compared)) {
    text += fmt::format(", {} time for each", percent(compared.shift.estimate - work->log_ratio));
  }
  return text;
}

std::string line_of(const Compared& compared, const ComparisonCommand& command) {
  std::string line = fmt::format("{:<12}", compared.verdict_name());
  if (has_time(compared)) {
    line += fmt::format("{}  {} blocks", ratio_of(compared.shift), compared.blocks);
    if (compared.process_runs > 0)
      line += fmt::format(" and {} fresh process runs", compared.process_runs);
    line += fmt::format(", {} clock", name_of(compared.clock));
  }
  line += fmt::format("  {:.1f} s  {}", compared.seconds, compared.key);
  if (!compared.reason.empty()) line += "\n              " + compared.reason;
  const bool undecided = has_time(compared) && compared.verdict == PairVerdict::undecided;
  if (undecided) line += "; settle it: " + settle(compared, command);
  if (const std::string work = work_of(compared); !work.empty()) {
    line += "\n              " + work;
  }
  return line + "\n";
}

std::vector<std::string_view> parts_of(std::string_view key) {
  constexpr std::string_view between = "; ";
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find(between, begin), key.size());
    parts.push_back(key.substr(begin, end - begin));
    begin = end + between.size();
  }
  return parts;
}

bool has(const std::vector<std::string_view>& parts, std::string_view part) {
  return std::ranges::find(parts, part) != parts.end();
}

// The parts that `b` has and `a` does not. For a variable that only `a` sets, the text says that it
// is not set.
std::vector<std::string> differing(const std::vector<std::string_view>& a,
                                   const std::vector<std::string_view>& b) {
  std::vector<std::string> parts;
  for (const std::string_view part : b) {
    if (!has(a, part)) parts.emplace_back(part);
  }
  for (const std::string_view part : a) {
    const std::string name(part.substr(0, part.find('=') + 1));  // empty: not a variable
    const bool set = std::ranges::any_of(b, [&](auto each) { return each.starts_with(name); });
    if (!set) parts.push_back("without " + std::string(part));
  }
  return parts;
}

// Common parts are printed once. The features of one processor are left out.
std::string sides_text(const record::Device& a, const record::Device& b) {
  const std::string key_a = a.key();
  const std::string key_b = b.key();
  auto parts_a = parts_of(key_a);
  auto parts_b = parts_of(key_b);
  const auto is_shared_processor = [](const auto& other) {
    return [&](std::string_view part) { return part.starts_with("CPU ") && has(other, part); };
  };
  const auto all_b = parts_b;
  std::erase_if(parts_b, is_shared_processor(parts_a));
  std::erase_if(parts_a, is_shared_processor(all_b));
  std::string text_b = fmt::format("{}", fmt::join(parts_b, "; "));
  if (a.id == b.id) {
    const auto parts = differing(parts_a, parts_b);
    text_b = parts.empty() ? "the same" : fmt::format("the same, but {}", fmt::join(parts, "; "));
  }
  return fmt::format("a: {}\nb: {}\n", fmt::join(parts_a, "; "), text_b);
}

std::string differences_text(const ComparisonResult& result) {
  DifferenceGroups groups;
  groups.add(result.device, "");
  for (const Compared& compared : result.configurations) {
    groups.add(compared.differences, compared.key);
  }
  if (!groups.empty()) return groups.text();
  const bool looked =
      std::ranges::any_of(result.configurations, [](const Compared& each) { return !each.ended; });
  if (!looked) {
    return nothing_compared(result.configurations.empty() ? std::string()
                                                          : result.configurations.front().reason);
  }
  const bool timed = std::ranges::any_of(result.configurations,
                                         [](const Compared& each) { return each.blocks > 0; });
  return timed ? "nothing differs but time\n" : "nothing differs\n";
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

core::Json to_json(const Difference& difference) {
  core::Json json{
      {"kind", name_of(difference.kind)}, {"about", difference.about}, {"text", difference.text}};
  if (difference.ratio) json["ratio"] = *difference.ratio;
  return json;
}

core::Json to_json(const Compared& compared, bool timed, const ComparisonCommand& command) {
  core::Json json{{"configuration", compared.key}};
  if (!compared.reason.empty()) json["reason"] = compared.reason;
  if (timed) {
    json["verdict"] = compared.verdict_name();
    json["blocks"] = compared.blocks;
    json["seconds"] = compared.seconds;
  }
  if (compared.blocks > 0) {
    json["clock"] = name_of(compared.clock);
    json["frames_per_batch"] = compared.frames_per_batch;
    if (!compared.why_wall.empty()) json["why_wall"] = compared.why_wall;
    if (compared.process_runs > 0) json["process_runs"] = compared.process_runs;
  }
  if (has_time(compared)) {
    const auto set = [&json](const char* name, double ln) {
      if (std::isfinite(ln)) json[name] = std::exp(ln);
    };
    set("ratio", compared.shift.estimate);
    set("ratio_low", compared.shift.interval.low);
    set("ratio_high", compared.shift.interval.high);
    if (compared.verdict == PairVerdict::undecided) {
      json["settle"] = settle(compared, command);
    }
  }
  if (compared.work) {
    json["work"] = {{"counter", compared.work->unit}, {"ln_work", compared.work->log_ratio}};
    if (has_time(compared)) {
      json["work"]["ln_time_per_work"] = compared.shift.estimate - compared.work->log_ratio;
    }
  }
  json["differences"] = comparison::to_json(compared.differences);
  return json;
}

}  // namespace

core::Json to_json(const std::vector<Difference>& differences) {
  core::Json json = core::Json::array();
  for (const Difference& each : differences) json.push_back(to_json(each));
  return json;
}

std::string headline(const ComparisonResult& result) {
  std::map<std::string_view, int> times;
  std::map<DifferenceKind, int> differences;
  for (const Compared& compared : result.configurations) {
    ++times[compared.verdict_name()];
    for (const Difference& difference : compared.differences) ++differences[difference.kind];
  }
  std::string text;
  switch (result.exit_code()) {
    case core::ExitCode::pass:
      text = "PASS:";
      break;
    case core::ExitCode::regression:
      text = "FAIL:";
      break;
    default:
      text = "CANNOT TELL:";
  }
  if (result.timed) {
    for (const std::string_view verdict : {"slower", "faster", "same", "cannot tell", "skipped"}) {
      if (const auto found = times.find(verdict); found != times.end()) {
        text += fmt::format(" {} {},", found->second, verdict);
      }
    }
  }
  return fmt::format("{} {} regressions in what repeats, {} fixed, {} changed; {:.0f} s", text,
                     differences[DifferenceKind::regression], differences[DifferenceKind::fixed],
                     differences[DifferenceKind::changed], result.seconds);
}

std::string to_text(const ComparisonResult& result, const ComparisonCommand& command) {
  std::string text =
      command.plan + "\n" + sides_text(result.a, result.b) + differences_text(result);
  if (result.timed) {
    text += "time of b over time of a:\n";
    for (const Compared& compared : result.configurations) text += line_of(compared, command);
    text += clocks_text(result);
  }
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
                  {"differences", to_json(result.device)},
                  {"configurations", core::Json::array()}};
  for (const Compared& compared : result.configurations) {
    json["configurations"].push_back(to_json(compared, result.timed, command));
  }
  return json;
}

}  // namespace triptych::comparison
