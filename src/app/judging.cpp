#include "app/judging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "app/paths.hpp"
#include "core/foreign_error.hpp"
#include "core/quoting.hpp"
#include "measure/plan.hpp"
#include "report/finding_groups.hpp"
#include "report/page.hpp"

namespace triptych::app {

record::Store open_to_judge(const std::string& file) {
  require_store(file);
  record::Store store = [&]() -> record::Store {
    try {
      return {file, record::Store::Mode::append};
    } catch (const core::IoError&) {
      return {file, record::Store::Mode::read};
    }
  }();
  store.require_whole();
  return store;
}

std::string latest_run_of(const record::Store& store, const std::string& plan,
                          const std::string& file) {
  const std::string name = measure::plan_name(plan);
  const std::optional<record::Run> run = store.latest_run(name);
  if (run) return run->id;
  throw core::NotSupported(
      fmt::format("{} holds no run of {}: measure first with `triptych run {} --store {}`", file,
                  name, core::shell_quoted(plan), core::shell_quoted(file)));
}

std::string text_of(const judge::GateResult& result) {
  std::string text;
  for (const report::FindingGroup& group : report::grouped(result.findings)) {
    const judge::Finding& finding = *group.first;
    if (finding.verdict == judge::Verdict::pass) continue;
    const std::string subject = group.subject();
    text += fmt::format("{:<12} {}{}{}: {}\n", judge::name_of(finding.verdict),
                        core::printable(finding.test), subject.empty() ? "" : " ",
                        core::printable(subject), core::printable(finding.message));
  }
  std::map<judge::Verdict, int> counts;
  for (const judge::Finding& finding : result.findings) ++counts[finding.verdict];
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{} {}  ", count, judge::name_of(verdict));
  }
  return text + fmt::format("\n{}\n", result.headline());
}

std::vector<record::Run> latest_runs(const record::Store& store) {
  std::map<std::string, record::Run> by_plan;
  for (record::Run& run : store.runs()) by_plan.insert_or_assign(run.plan, std::move(run));
  std::vector<record::Run> runs;
  for (auto& [plan, run] : by_plan) runs.push_back(std::move(run));
  return runs;
}

judge::GateResult judge_named(const record::Store& store, const std::string& run,
                              const std::string& baselines, const judge::GateRequest& request) {
  return core::naming(fmt::format("{}: run {}", store.file().string(), run), [&] {
    return judge::judge_run(store, run, judge::Baselines(baselines, request.plan), request);
  });
}

std::string page_of(const record::Store& store, Truths& truths, const std::string& baselines) {
  report::PageRequest request{
      .plans = {}, .truth = [&](const record::Record& record) { return truths.of(record); }};
  for (const record::Run& run : latest_runs(store)) {
    request.plans.push_back(
        {.run = run,
         .verdict = judge_named(store, run.id, baselines, request_of(truths, run.plan))});
  }
  return core::naming(store.file().string(), [&] { return report::page(store, request); });
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
