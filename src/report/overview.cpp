#include "report/overview.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "core/exit_code.hpp"
#include "report/circumstances.hpp"
#include "report/words/check.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using judge::GateResult;
using judge::Verdict;
using record::name_of;

constexpr std::size_t max_named_devices = 3;

struct Tally {
  std::size_t decided = 0;
  std::map<Verdict, std::size_t> of;
};

bool decides(Verdict verdict) {
  return verdict != Verdict::advisory && verdict != Verdict::skipped;
}

// Returns, for each device, how many of its checks have this verdict: "vulkan:lavapipe: 18 of 66
// checks wrong; gl:zink: 1 of 66".
std::string places(const std::map<std::string, Tally>& by_device, Verdict verdict,
                   std::string_view word) {
  std::string text;
  std::size_t shown = 0;
  std::size_t rest = 0;
  for (const auto& [device, tally] : by_device) {
    const auto found = tally.of.find(verdict);
    if (found == tally.of.end()) continue;
    if (shown == max_named_devices) {
      ++rest;
      continue;
    }
    ++shown;
    text += fmt::format("{}{}: {} of {}", text.empty() ? "" : "; ",
                        device.empty() ? "the plan" : device, found->second, tally.decided);
    if (shown == 1) text += fmt::format(" checks {}", word);
  }
  return rest > 0 ? text + fmt::format("; {} more devices", rest) : text;
}

// Returns whether a check was requested but not made, because there are no baselines.
bool lacks_baselines(std::string_view topic, std::span<const GateResult* const> results) {
  return std::ranges::any_of(results, [&](const GateResult* result) {
    return std::ranges::any_of(result->findings, [&](const Finding& each) {
      return each.cause == judge::Cause::no_baselines &&
             std::ranges::find(each.names, topic) != each.names.end();
    });
  });
}

std::string_view word_of(Verdict verdict) {
  if (verdict == Verdict::regression) return "FAIL";
  return verdict == Verdict::waived ? "waived" : "no verdict";
}

// Returns the row of a topic that is not a check, or nullopt if it has no findings.
std::optional<CheckRow> notice_of(const words::NoticeWords& kind,
                                  std::span<const GateResult* const> results) {
  std::optional<Verdict> worst;
  std::set<std::string> places;
  for (const GateResult* result : results) {
    for (const Finding& finding : result->findings) {
      if (judge::topic_of(finding) != kind.topic) continue;
      worst = worst ? std::max(*worst, finding.verdict) : finding.verdict;
      places.insert(finding.device.empty() ? result->plan : finding.device);
    }
  }
  if (!worst) return std::nullopt;
  return CheckRow{kind.topic, kind.label, word_of(*worst), *worst,
                  fmt::format("{}: {}", kind.sentence, fmt::join(places, ", "))};
}

CheckRow row_of(const words::TopicWords& kind, std::span<const GateResult* const> results) {
  std::map<std::string, Tally> by_device;
  std::map<Verdict, std::size_t> all;
  std::size_t right = 0;
  for (const GateResult* result : results) {
    for (const Finding& finding : result->findings) {
      if (judge::topic_of(finding) != kind.topic) continue;
      // A finding without a device is about the reference image. If it passes, it does not count as
      // an image that is within its bound.
      const bool about_reference = finding.check == Check::image && finding.device.empty();
      const bool is_right =
          finding.verdict == Verdict::pass || finding.verdict == Verdict::improved;
      if (is_right && !about_reference) ++right;
      Tally& tally = by_device[finding.device];
      ++tally.of[finding.verdict];
      ++all[finding.verdict];
      if (decides(finding.verdict)) ++tally.decided;
    }
  }
  const bool shown =  // times are shown but do not affect the verdict
      kind.topic == name_of(Check::timing) &&
      std::ranges::none_of(results, [](const GateResult* each) { return each->times_decided; });
  CheckRow row{
      kind.topic, kind.label, "–", Verdict::skipped,
      std::string(lacks_baselines(kind.topic, results) ? words::nothing_to_compare : kind.none)};
  if (all[Verdict::regression] > 0) {
    row = {kind.topic, kind.label, "FAIL", Verdict::regression,
           places(by_device, Verdict::regression, kind.wrong)};
  } else if (all[Verdict::cannot_judge] > 0) {
    row = {kind.topic, kind.label, "no verdict", Verdict::cannot_judge,
           places(by_device, Verdict::cannot_judge, "not judged")};
    if (right > 0) row.sentence += fmt::format("; {} {}", right, kind.passed);
  } else if (right > 0 && shown) {
    row.sentence = fmt::format("{} shown, not judged", right);
  } else if (right > 0) {
    row = {kind.topic, kind.label, "pass", Verdict::pass, fmt::format("{} {}", right, kind.passed)};
  } else if (all[Verdict::waived] > 0) {
    row = {kind.topic, kind.label, "waived", Verdict::waived, ""};
  }
  for (const auto& [verdict, word] : {std::pair(Verdict::waived, "waived"),
                                      {Verdict::improved, "better"},
                                      {Verdict::advisory, "with an advisory"},
                                      {Verdict::skipped, "skipped"}}) {
    if (all[verdict] == 0) continue;
    row.sentence += fmt::format("{}{} {}", row.sentence.empty() ? "" : "; ", all[verdict], word);
  }
  return row;
}

bool was_checked(const words::TopicWords& kind, std::span<const GateResult* const> results) {
  return std::ranges::any_of(results, [&](const GateResult* result) {
    return std::ranges::any_of(
        result->findings, [&](const Finding& each) { return judge::topic_of(each) == kind.topic; });
  });
}

// Adds a group. Merges it with a group from another plan that has the same cause.
void add(std::vector<Cause>& causes, const GateResult& result, FindingGroup group) {
  const auto same = std::ranges::find_if(
      causes, [&](const Cause& cause) { return have_same_cause(cause.group, group); });
  if (same == causes.end()) {
    causes.push_back({&result, std::move(group)});
    return;
  }
  if (merge_into(same->group, group)) same->result = &result;
  ++same->plans;
}

std::map<Check, std::set<std::string>> undecided_checks(
    std::span<const GateResult* const> results) {
  std::set<Check> decided;
  for (const GateResult* result : results) {
    const auto undecided = result->undecided_checks();
    for (const Check check : result->checks) {
      const auto found = undecided.find(check);
      if (found == undecided.end() || !found->second.empty()) decided.insert(check);
    }
  }
  std::map<Check, std::set<std::string>> all;
  for (const GateResult* result : results) {
    for (auto& [check, devices] : result->undecided_checks()) {
      std::set<std::string>& merged = all[check];
      if (!decided.contains(check)) continue;
      const std::set<std::string>& more = devices.empty() ? result->devices : devices;
      merged.insert(more.begin(), more.end());
    }
  }
  return all;
}

std::vector<TestedDriver> tested_drivers(std::span<const GateResult* const> results) {
  std::map<std::string, std::set<std::string>> by_driver;
  for (const GateResult* result : results) {
    for (const auto& [id, device] : result->tested) {
      by_driver[words::driver_text(device)].insert(id);
    }
  }
  std::vector<TestedDriver> drivers;
  for (const auto& [driver, devices] : by_driver) {
    drivers.push_back({driver, {devices.begin(), devices.end()}});
  }
  std::ranges::sort(drivers, {}, &TestedDriver::devices);
  return drivers;
}

}  // namespace

Overview overview(std::span<const GateResult* const> results) {
  Overview all;
  std::set<std::string_view> devices;
  if (!results.empty()) all.code = core::ExitCode::pass;
  for (const GateResult* result : results) {
    all.code = core::worse_of(all.code, result->exit_code());
    all.part = all.part || result->part;
    for (const Finding& finding : result->findings) {
      if (!finding.device.empty()) devices.insert(finding.device);
    }
    for (FindingGroup& group : grouped(result->findings)) {
      if (group.first->verdict == Verdict::pass) continue;
      add(is_open(*group.first) ? all.open : all.remarks, *result, std::move(group));
    }
  }
  all.devices = devices.size();
  for (std::vector<Cause>* causes : {&all.open, &all.remarks}) {
    std::ranges::stable_sort(*causes, std::greater{},
                             [](const Cause& cause) { return cause.group.first->verdict; });
  }
  all.bounds = nearest_bounds(results);
  all.drivers = tested_drivers(results);
  all.undecided = undecided_checks(results);
  all.circumstances = circumstances(results);
  const auto add_row = [&](const words::TopicWords& kind) {
    if (!kind.always && !was_checked(kind, results)) return;
    CheckRow& row = all.rows.emplace_back(row_of(kind, results));
    if (kind.topic != name_of(Check::image) || row.worst != Verdict::pass) return;
    const std::string nearest = nearest_text(all.bounds);
    if (!nearest.empty()) row.sentence += "; " + nearest;
  };
  for (const words::CheckWords& kind : words::check_words) {
    add_row({name_of(kind.check), kind.label, kind.wrong, kind.passed, kind.none, kind.always});
  }
  for (const words::NoticeWords& kind : words::notice_words) {
    if (auto row = notice_of(kind, results)) all.rows.push_back(std::move(*row));
  }
  return all;
}

Overview overview(std::span<const GateResult> results) {
  std::vector<const GateResult*> all;
  for (const GateResult& result : results) all.push_back(&result);
  return overview(std::span<const GateResult* const>(all));
}

}  // namespace triptych::report
