#include <fmt/format.h>

#include <algorithm>

#include "core/glob.hpp"
#include "judge/gate/flakes.hpp"
#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// `configuration`: empty for a finding about a whole device or plan.
bool covers(const Waiver& waiver, const std::string& device, const std::string& test,
            const std::string& configuration) {
  return core::glob_matches(waiver.device, device) && core::glob_matches(waiver.test, test) &&
         core::glob_matches(waiver.configuration, configuration);
}

bool has_expired(const Waiver& waiver, const RunView& view) {
  return !waiver.expiry.empty() && view.request.today >= waiver.expiry;
}

// What the request knows of a finding's place, of these kinds.
const Waiver* known_of(const RunView& view, const Finding& finding, const std::set<Known>& kinds) {
  const auto found = std::ranges::find_if(*view.request.known, [&](const Waiver& each) {
    return kinds.contains(each.known) && !has_expired(each, view) &&
           covers(each, finding.device, finding.test, finding.configuration);
  });
  return found == view.request.known->end() ? nullptr : &*found;
}

void hold_against_known(const RunView& view, Finding& finding) {
  switch (finding.verdict) {
    case Verdict::regression:
      if (const Waiver* known = known_of(view, finding, {Known::fail, Known::flake})) {
        finding.verdict = Verdict::waived;
        finding.message =
            fmt::format("{}{}: {}", known_prefix, name_of(known->known), finding.message);
      }
      break;
    case Verdict::skipped:
      if (known_of(view, finding, {Known::skip}) == nullptr) {
        finding.verdict = Verdict::cannot_judge;
        finding.message = "skipped, which was not expected: " + finding.message;
      }
      break;
    case Verdict::pass:
    case Verdict::improved:
      if (const Waiver* known = known_of(view, finding, {Known::fail, Known::skip})) {
        finding.verdict = Verdict::improved;
        finding.message = fmt::format("passes, which was not expected: take its entry out ({}: {})",
                                      name_of(known->known), known->reason);
      }
      break;
    default:
      break;
  }
}

// Whether the waiver is about anything this gate looked at; others belong to other plans.
bool concerns(const Waiver& waiver, const RunView& view) {
  return std::ranges::any_of(view.records, [&](const record::Record& record) {
    return std::ranges::any_of(view.checks, [&](Check check) {
      return covers(waiver, record.device, record.test_id(name_of(check)), record.configuration);
    });
  });
}

// One that names this plan, and no test that the plan can have.
bool matches_no_test(const Waiver& waiver, const RunView& view) {
  const record::Checks checks = record::every_check();
  const std::string image = view.plan_test(Check::image);
  const std::string plan = image.substr(0, image.rfind('.') + 1);
  return waiver.test.starts_with(plan) &&
         std::ranges::none_of(view.records, [&](const record::Record& record) {
           return std::ranges::any_of(checks, [&](Check check) {
             return core::glob_matches(waiver.test, record.test_id(name_of(check)));
           });
         });
}

}  // namespace

bool is_waived(const RunView& view, const record::Record& record, Check check) {
  return std::ranges::any_of(view.baselines.waivers(), [&](const Waiver& waiver) {
    return !has_expired(waiver, view) &&
           covers(waiver, record.device, record.test_id(name_of(check)), record.configuration);
  });
}

void apply_known(const RunView& view, std::vector<Finding>& findings) {
  if (!view.request.known) return;
  for (Finding& finding : findings) {
    if (!finding.configuration.empty()) hold_against_known(view, finding);
  }
}

void apply_waivers(const RunView& view, std::vector<Finding>& findings) {
  for (const Waiver& waiver : view.baselines.waivers()) {
    bool used = false;
    for (Finding& finding : findings) {
      if (finding.verdict != Verdict::regression ||
          !covers(waiver, finding.device, finding.test, finding.configuration)) {
        continue;
      }
      used = true;
      if (has_expired(waiver, view)) {
        finding.message +=
            fmt::format("; a waiver for this expired on {} ({})", waiver.expiry, waiver.reason);
      } else {
        finding.verdict = Verdict::waived;
        finding.message =
            fmt::format("waived until {} ({}): {}", waiver.expiry, waiver.reason, finding.message);
      }
    }
    if (!used && has_expired(waiver, view) && concerns(waiver, view)) {
      findings.push_back(finding_about(
          view, *view.checks.begin(), Verdict::advisory,
          fmt::format("the waiver of {} on {} expired on {} and excuses nothing: take it out ({})",
                      waiver.test, waiver.device, waiver.expiry, waiver.reason)));
    }
    if (matches_no_test(waiver, view)) {
      findings.push_back(finding_about(
          view, *view.checks.begin(), Verdict::advisory,
          fmt::format(
              "the waiver of {} matches no test; one is called SUITE.PLAN.CHECK.DEVICE, and "
              "`configuration` limits a waiver to some of its pictures",
              waiver.test)));
    }
  }
}

}  // namespace triptych::judge
