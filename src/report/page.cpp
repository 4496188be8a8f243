#include "report/page.hpp"

#include <fmt/format.h>

#include <span>

#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

std::string_view css_class(core::ExitCode code) {
  switch (code) {
    case core::ExitCode::pass:
      return "pass";
    case core::ExitCode::regression:
      return "regression";
    default:
      return "cannot_judge";
  }
}

std::string anchor_of(std::size_t index) {
  return fmt::format("plan{}", index);
}

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

// What the page says first, each line leading to its plan.
std::string summary(std::span<const PlanReport> plans) {
  if (plans.size() < 2) return {};
  std::string text = "<ul class=\"summary\">\n";
  for (std::size_t i = 0; i < plans.size(); ++i) {
    text +=
        fmt::format("<li><a href=\"#{}\">{}</a> <span class=\"verdict {}\">{}</span></li>\n",
                    anchor_of(i), escape(plans[i].run.plan),
                    css_class(plans[i].verdict.exit_code()), escape(plans[i].verdict.headline()));
  }
  return text + "</ul>\n";
}

std::string plan_part(const record::Store& store, const PlanReport& report,
                      const PageRequest& request, std::size_t index) {
  const PlanData plan{.anchor = anchor_of(index),
                      .devices = store.devices(report.run.id),
                      .records = store.records(report.run.id),
                      .verdict = &report.verdict};
  return fmt::format("<section id=\"{}\"><h2>{}</h2><p class=\"banner {}\">{}</p>", plan.anchor,
                     escape(report.run.plan), css_class(report.verdict.exit_code()),
                     escape(report.verdict.headline())) +
         system_line(report.run) + common_line(plan) + verdict_section(plan) +
         devices_section(plan) + scenes_section(store, plan, request.truth) + times_section(plan) +
         speed_of_light_section(plan) + accuracy_section(plan) + counts_section(plan) +
         "</section>\n";
}

}  // namespace

std::string page(const record::Store& store, const PageRequest& request) {
  std::string text =
      page_begin("Triptych report", "Triptych",
                 "The same scenes through OpenCL, Vulkan and OpenGL, compared with the truth and "
                 "with what was stored before.") +
      summary(request.plans);
  for (std::size_t i = 0; i < request.plans.size(); ++i) {
    text += plan_part(store, request.plans[i], request, i);
  }
  return text + page_end();
}

}  // namespace triptych::report
