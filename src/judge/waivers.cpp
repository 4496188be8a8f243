#include <fmt/format.h>

#include <algorithm>

#include "judge/glob.hpp"
#include "judge/run_view.hpp"

namespace triptych::judge {
namespace {

bool covers(const Waiver& waiver, const std::string& device, const std::string& test) {
  return glob_matches(waiver.device, device) && glob_matches(waiver.test, test);
}

// Whether the waiver is about anything this gate looked at; others belong to other plans.
bool concerns(const Waiver& waiver, const RunView& view) {
  return std::ranges::any_of(view.records, [&](const record::Record& record) {
    return std::ranges::any_of(view.checks, [&](Check check) {
      return covers(waiver, record.device, record.test_id(name_of(check)));
    });
  });
}

}  // namespace

void apply_waivers(const RunView& view, std::vector<Finding>& findings) {
  const auto expired = [&](const Waiver& waiver) { return view.request.today >= waiver.expiry; };
  for (const Waiver& waiver : view.baselines.waivers()) {
    bool used = false;
    for (Finding& finding : findings) {
      if (finding.verdict != Verdict::regression || !covers(waiver, finding.device, finding.test)) {
        continue;
      }
      used = true;
      if (expired(waiver)) {
        finding.message +=
            fmt::format("; a waiver for this expired on {} ({})", waiver.expiry, waiver.reason);
      } else {
        finding.verdict = Verdict::waived;
        finding.message =
            fmt::format("waived until {} ({}): {}", waiver.expiry, waiver.reason, finding.message);
      }
    }
    if (!used && expired(waiver) && concerns(waiver, view)) {
      findings.push_back(finding_about(
          view, *view.checks.begin(), Verdict::advisory,
          fmt::format("the waiver of {} on {} expired on {} and excuses nothing: take it out ({})",
                      waiver.test, waiver.device, waiver.expiry, waiver.reason)));
    }
  }
}

}  // namespace triptych::judge
