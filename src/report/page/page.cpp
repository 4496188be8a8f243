#include "report/page/page.hpp"

#include <fmt/format.h>

#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

Html system_line(const record::Run& run) {
  std::string text = "measured " + run.started_at;
  for (const auto& [name, value] : run.system) {
    text += fmt::format(" · {}: {}", name, value);
  }
  return markup("<p class=\"system\">{}</p>\n", text);
}

Html common_line(const PlanData& plan) {
  const std::string common = common_factors(plan);
  return common.empty() ? Html() : markup("<p>Common to all scenes: {}.</p>\n", common);
}

std::string devices_of(const PlanData& plan) {
  std::string text;
  for (const auto& [device, clocks] : plan.devices) {
    text += (text.empty() ? "" : " ") + device.id;
  }
  return text;
}

// Collects the data about one plan that the sections of the page need. Leaves out devices that were
// not judged.
PlanData data_of(const record::Store& store, const PlanReport& report, std::size_t number) {
  PlanData plan{.prefix = fmt::format("plan{}", number),
                .name = report.verdict.plan,
                .devices = store.devices(report.run.id),
                .records = store.records(report.run.id),
                .verdict = &report.verdict,
                .run = &report.run};
  const auto& judged = report.verdict.environments;
  if (judged.empty()) return plan;
  std::erase_if(plan.devices, [&](const auto& each) { return !judged.contains(each.device.id); });
  std::erase_if(plan.records, [&](const auto& each) { return !judged.contains(each.device); });
  return plan;
}

Html plan_section(const record::Store& store, const PlanReport& report, const PlanData& plan) {
  return markup(
             "<section id=\"{}\" data-kind=\"plan\" data-suite=\"{}\" data-device=\"{}\"><h2>{}"
             "</h2><p>{}</p>",
             plan.prefix, suite_of(plan), devices_of(plan), plan.name,
             words::headline(report.verdict)) +
         system_line(report.run) + common_line(plan) + code_section(store, plan) +
         changes_section(plan) + accuracy_section(plan) + correlation_section(plan) +
         devices_section(plan) + times_section(plan) + speed_of_light_section(plan) +
         needed_section(plan) + counts_section(plan) + markup("</section>\n");
}

// Shows the findings and the images: next to each other if an image is wrong, otherwise one below
// the other.
Html findings_and_images(const Overview& all, const PanelSources& sources,
                         std::span<const PlanData> plans) {
  const ImagesSection images = images_section(sources, plans);
  const bool side_by_side = !all.open.empty() && images.wrong;
  return markup("<div class=\"{}\"><div>{}</div><div>{}</div></div>\n",
                side_by_side ? "columns" : "", findings_section(all, plans), images.html);
}

}  // namespace

std::string page(const record::Store& store, const PageRequest& request) {
  std::vector<PlanData> plans;
  std::vector<const judge::GateResult*> results;
  for (const PlanReport& report : request.plans) {
    plans.push_back(data_of(store, report, plans.size()));
    results.push_back(&report.verdict);
  }
  const Overview all = overview(std::span<const judge::GateResult* const>(results));
  const JudgedImages judged = judged_images(all, plans);
  Html text = page_begin("Triptych report") + verdict_card(all, plans) + filters(plans) +
              markup("<main>") + findings_and_images(all, {store, request.truth, judged}, plans);
  for (std::size_t i = 0; i < plans.size(); ++i)
    text += plan_section(store, request.plans[i], plans[i]);
  text += terms_section(all);
  const Html whole =
      without_repeated_images(text) + markup("</main>") + comparison_dialog() + page_end();
  return whole.text();
}

}  // namespace triptych::report
