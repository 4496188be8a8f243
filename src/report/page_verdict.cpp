// What the page says first.

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "core/hash.hpp"
#include "report/html.hpp"
#include "report/overview.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

using judge::Finding;

constexpr std::size_t openly_listed = 20;

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

std::string lead(const Overview& all) {
  if (all.open.empty()) {
    return all.code == core::ExitCode::pass ? "All that was asked for is right."
                                            : "Nothing was decided.";
  }
  return fmt::format("{}, first of all {}: {}",
                     all.open.size() == 1 ? "One cause" : fmt::format("{} causes", all.open.size()),
                     judge::name_of(all.open.front().group.first->check),
                     place_of(all.open.front()));
}

std::string card(const Overview& all, std::span<const PlanData> plans) {
  std::string names;
  for (const PlanData& plan : plans) {
    names += fmt::format(" · <a href=\"#{}\">{}</a>", plan.anchor, escape(plan.name));
  }
  return fmt::format(
      "<header class=\"{}\"><h1>{} ({})</h1><p class=\"lead\">{}</p><p>Triptych · {} {}{}</p>"
      "</header>\n",
      css_class(all.code), word_of(all.code), static_cast<int>(all.code), escape(lead(all)),
      all.devices, all.devices == 1 ? "device" : "devices", names);
}

std::string kinds(const Overview& all) {
  std::string text = "<table class=\"kinds\">\n";
  for (const KindRow& row : all.rows) {
    text += fmt::format("<tr><td>{}</td><td class=\"verdict {}\">{}</td><td>{}</td></tr>\n",
                        row.kind, judge::name_of(row.worst), row.verdict, escape(row.sentence));
  }
  return text + "</table>\n";
}

std::string bounds(const Overview& all) {
  if (all.bounds.empty()) return {};
  std::vector<std::vector<std::string>> rows{
      {"plan", "device", "pictures", "largest error over bound", "where"}};
  for (const NearestBound& bound : all.bounds) {
    rows.push_back({escape(bound.plan), escape(bound.device), fmt::to_string(bound.pictures),
                    fmt::format("{:.3g}", bound.share), breakable(bound.configuration)});
  }
  return folded("How near pictures come to their bounds", table(rows));
}

const PlanData& plan_of(const Cause& cause, std::span<const PlanData> plans) {
  return *std::ranges::find(plans, cause.result, &PlanData::verdict);
}

// Of what drew a picture, or ended instead of drawing one.
std::string picture_link(const PlanData& plan, const Finding& finding) {
  const auto drawn = [&](const record::Record& record) {
    return record.device == finding.device && record.configuration == finding.configuration &&
           record.outcome != record::Outcome::skipped;
  };
  if (!std::ranges::any_of(plan.records, drawn)) return {};
  return fmt::format(" <a href=\"#{}\">picture</a>",
                     picture_id(plan, finding.device, finding.configuration));
}

std::string article(const Cause& cause, const PlanData& plan) {
  const Finding& first = *cause.group.first;
  const std::string command = command_of(first, *cause.result);
  const bool several = cause.group.configurations > 1;
  return fmt::format(
      "<article class=\"{0}\"><h3><span class=\"verdict {0}\">{1}</span> {2}</h3><p>{3}{4}</p>"
      "{5}{6}</article>\n",
      judge::name_of(first.verdict), judge::name_of(first.check), breakable(place_of(cause)),
      escape(message_of(cause)), is_open(first) ? picture_link(plan, first) : "",
      first.configuration.empty()
          ? ""
          : fmt::format("<p class=\"system\">{}{}</p>", several ? "the smallest: " : "",
                        breakable(first.configuration)),
      command.empty() ? "" : "<pre>" + escape(command) + "</pre>");
}

std::string listed(std::span<const Cause> causes, std::span<const PlanData> plans) {
  std::string text;
  for (const Cause& cause : causes) text += article(cause, plan_of(cause, plans));
  return text;
}

std::string findings(const Overview& all, std::span<const PlanData> plans) {
  const std::span<const Cause> open(all.open);
  const std::size_t shown = std::min(openly_listed, open.size());
  std::string text;
  if (shown > 0) text += "<h2 id=\"findings\">Findings</h2>\n" + listed(open.first(shown), plans);
  text += folded(fmt::format("{} more causes", open.size() - shown),
                 listed(open.subspan(shown), plans));
  return text + folded(fmt::format("{} remarks that decide nothing: advice, what devices cannot "
                                   "do, known deviations",
                                   all.aside.size()),
                       listed(all.aside, plans));
}

}  // namespace

std::string verdict_section(std::span<const PlanData> plans) {
  std::vector<const judge::GateResult*> results;
  for (const PlanData& plan : plans) results.push_back(plan.verdict);
  const Overview all = overview(std::span<const judge::GateResult* const>(results));
  return card(all, plans) + kinds(all) + bounds(all) + findings(all, plans);
}

std::string picture_id(const PlanData& plan, const std::string& device,
                       const std::string& configuration) {
  return fmt::format("{}-{}", plan.anchor, core::content_hash(device + '\n' + configuration));
}

}  // namespace triptych::report
