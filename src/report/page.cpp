#include "report/page.hpp"

#include <fmt/format.h>

#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

std::string system_line(const record::Run& run) {
  std::string text = "measured " + escape(run.started_at);
  for (const auto& [name, value] : run.system) {
    text += fmt::format(" · {}: {}", escape(name), escape(value));
  }
  return "<p class=\"system\">" + text + "</p>\n";
}

std::string common_line(const PlanData& plan) {
  const std::string common = common_factors(plan);
  return common.empty() ? common : "<p>All scenes: " + escape(common) + ".</p>\n";
}

std::string plan_part(const PlanReport& report, const PlanData& plan) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2><p>{}</p>", plan.anchor, escape(plan.name),
                     escape(report.verdict.headline())) +
         system_line(report.run) + common_line(plan) + accuracy_section(plan) +
         correlation_section(plan) + devices_section(plan) + times_section(plan) +
         speed_of_light_section(plan) + counts_section(plan) + "</section>\n";
}

}  // namespace

std::string page(const record::Store& store, const PageRequest& request) {
  std::vector<PlanData> plans;
  for (const PlanReport& report : request.plans) {
    plans.push_back({.anchor = fmt::format("plan{}", plans.size()),
                     .name = report.run.plan,
                     .devices = store.devices(report.run.id),
                     .records = store.records(report.run.id),
                     .verdict = &report.verdict});
  }
  std::string text = page_begin("Triptych report") + verdict_section(plans) +
                     pictures_section(store, plans, request.truth);
  for (std::size_t i = 0; i < plans.size(); ++i) text += plan_part(request.plans[i], plans[i]);
  return text + page_end();
}

}  // namespace triptych::report
