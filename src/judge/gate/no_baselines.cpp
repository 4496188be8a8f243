// Reports that a plan has no baselines, and which checks need them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "judge/gate/run_view.hpp"

namespace triptych::judge {
namespace {

// Returns advice for a plan without baselines. A plan of the user should not be accepted in the
// default folder, which contains the baselines of the suites' plans.
AdviceWithCommand first_accept_advice(const RunView& view) {
  AdviceWithCommand advice = view.accept_advice();
  if (!record::is_plan_file(view.request.plan) || !view.request.baselines_option.empty()) {
    return advice;
  }
  return {Advice::accept_own, advice.command + " --baselines own-baselines"};
}

}  // namespace

void report_no_baselines(const RunView& view, const std::set<Check>& comparing,
                         std::vector<Finding>& findings) {
  Observation what{.cause = Cause::no_baselines, .detail = view.baselines.problem()};
  AdviceWithCommand advice = first_accept_advice(view);
  if (!what.detail.empty()) {
    advice = view.accept_advice(Advice::restore_baselines);
    advice.command += " --drop";
  }
  if (advice.advice != Advice::accept_own) what.facts["folder"] = view.baselines.folder().string();
  std::vector<std::string_view> checked;
  for (const Check check : view.checks) {
    if (comparing.contains(check)) {
      what.names.emplace_back(name_of(check));
    } else {
      checked.push_back(name_of(check));
    }
  }
  what.facts["checked"] = fmt::format("{}", fmt::join(checked, ", "));
  findings.push_back(finding_about(view, *view.checks.begin(), Verdict::cannot_judge,
                                   std::move(what), std::move(advice)));
}

}  // namespace triptych::judge
