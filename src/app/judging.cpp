#include "app/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "app/paths.hpp"
#include "measure/plan.hpp"
#include "report/finding_groups.hpp"
#include "report/page.hpp"

namespace triptych::app {

record::Store open_to_judge(const std::string& file) {
  require_store(file);
  try {
    return {file, record::Store::Mode::append};
  } catch (const core::IoError&) {
    return {file, record::Store::Mode::read};
  }
}

std::string latest_run_of(const record::Store& store, const std::string& plan,
                          const std::string& file) {
  const std::string name = measure::plan_name(plan);
  const std::optional<record::Run> run = store.latest_run(name);
  if (run) return run->id;
  throw core::NotSupported(
      fmt::format("{} holds no run of {}: measure first with `triptych run {} --store {}`", file,
                  name, plan, file));
}

std::string text_of(const judge::GateResult& result) {
  std::string text;
  for (const report::FindingGroup& group : report::grouped(result.findings)) {
    const judge::Finding& finding = *group.first;
    if (finding.verdict == judge::Verdict::pass) continue;
    const std::string subject = group.subject();
    text += fmt::format("{:<12} {}{}{}: {}\n", judge::name_of(finding.verdict), finding.test,
                        subject.empty() ? "" : " ", subject, finding.message);
  }
  std::map<judge::Verdict, int> counts;
  for (const judge::Finding& finding : result.findings) ++counts[finding.verdict];
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{} {}  ", count, judge::name_of(verdict));
  }
  return text + fmt::format("\n{}\n", result.headline());
}

std::vector<record::Run> latest_runs(const record::Store& store) {
  std::set<std::string> plans;
  for (const record::Run& run : store.runs()) plans.insert(run.plan);
  std::vector<record::Run> runs;
  for (const std::string& plan : plans) runs.push_back(*store.latest_run(plan));
  return runs;
}

std::string page_of(const record::Store& store, Truths& truths, const std::string& baselines) {
  report::PageRequest request{
      .plans = {}, .truth = [&](const record::Record& record) { return truths.of(record); }};
  for (const record::Run& run : latest_runs(store)) {
    request.plans.push_back(
        {.run = run,
         .verdict = judge::judge_run(store, run.id, judge::Baselines(baselines, run.plan),
                                     request_of(truths, run.plan))});
  }
  return report::page(store, request);
}

core::ExitCode worse_of(core::ExitCode a, core::ExitCode b) {
  using core::ExitCode;
  constexpr std::array by_weight{ExitCode::pass, ExitCode::skip, ExitCode::cannot_judge,
                                 ExitCode::regression, ExitCode::usage};
  return std::max(a, b, [&](ExitCode one, ExitCode other) {
    return std::ranges::find(by_weight, one) < std::ranges::find(by_weight, other);
  });
}

}  // namespace triptych::app
