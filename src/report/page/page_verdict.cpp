// The verdict, the findings, and the definitions of terms.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <ranges>
#include <set>

#include "core/hash.hpp"
#include "core/quoting.hpp"
#include "report/finding_command.hpp"
#include "report/html.hpp"
#include "report/overview.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"
#include "report/words/cause.hpp"
#include "report/words/command_note.hpp"

namespace triptych::report {
namespace {

using judge::Finding;

constexpr std::size_t max_unfolded_causes = 20;

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

Html circumstances_of(const Overview& all) {
  Html text;
  for (const std::string& each : all.circumstances) {
    text += markup("<p class=\"cannot_judge\">{}</p>", each);
  }
  return text;
}

// Returns whether the only problem is that there are no baselines.
bool has_no_baselines(const Overview& all) {
  return !all.open.empty() && std::ranges::all_of(all.open, [](const Cause& cause) {
    return cause.group.first->cause == judge::Cause::no_baselines;
  });
}

std::string heading(const Overview& all) {
  if (has_no_baselines(all)) return "Results without baselines";
  return std::string(words::verdict_word(all.code));
}

std::string lead(const Overview& all) {
  if (has_no_baselines(all)) {
    return "Everything that needs no stored values was checked. There are no stored values with "
           "which the rest could be compared:";
  }
  if (all.open.size() == 1) return "One cause:";
  if (!all.open.empty()) return fmt::format("{} causes, the worst first:", all.open.size());
  if (all.code != core::ExitCode::pass) return "No check reached a verdict.";
  std::string text = words::pass_text(all) + ".";
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string cause_id(std::size_t number) {
  return fmt::format("cause{}", number);
}

// Returns a link to each visible cause, and a link to the folded causes.
Html contents(const Overview& all) {
  if (all.open.empty()) return {};
  Html text = markup("<ol class=\"causes\">");
  const std::size_t shown = std::min(max_unfolded_causes, all.open.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Cause& cause = all.open[i];
    text += markup("<li><a href=\"#{}\">{}: {}</a></li>", cause_id(i),
                   judge::topic_of(*cause.group.first), breakable(words::location(cause)));
  }
  if (shown < all.open.size()) {
    text +=
        markup("<li><a href=\"#{}\">{} more</a></li>", cause_id(shown), all.open.size() - shown);
  }
  return text + markup("</ol>");
}

// Formats a command so that lines preferably break before an option.
Html command_block(std::string_view command) {
  if (command.empty()) return {};
  Html text = markup("<pre><span>");
  std::size_t from = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\'') quoted = !quoted;
    if (quoted || !command.substr(i).starts_with(" --")) continue;
    text += markup("{}</span> <span>", command.substr(from, i - from));
    from = i + 1;
  }
  return text + markup("{}</span></pre>", command.substr(from));
}

std::string system_fact(const PlanData& plan, const std::string& name) {
  const auto found = plan.run->system.find(name);
  return found == plan.run->system.end() ? std::string() : found->second;
}

// Returns a command that measures and judges the same plans and devices again.
std::string gate_command(std::span<const PlanData> plans) {
  std::vector<std::string> words{"triptych", "gate"};
  std::set<std::string> devices;
  for (const PlanData& plan : plans) {
    const std::string& typed = plan.verdict->argument;
    words.push_back(typed.empty() ? record::plan_argument(plan.name) : typed);
    for (const record::RunStart& begun : plan.run->begun) {
      devices.insert(begun.requested.begin(), begun.requested.end());
    }
  }
  for (const std::string& device : devices) words.insert(words.end(), {"--device", device});
  words.emplace_back("--measure");
  return core::shell_command(words);
}

// Returns a section about the program, the machine and the drivers that were tested.
Html tested_section(std::span<const PlanData> plans) {
  std::map<std::string, std::set<std::string>> facts;
  for (const PlanData& plan : plans) {
    if (plan.run == nullptr) continue;
    facts["measured"].insert(plan.run->started_at);
    for (const auto& [name, label] :
         {std::pair("triptych", "Triptych"), {"processor", "machine"}, {"os", "system"}}) {
      if (const std::string text = system_fact(plan, name); !text.empty())
        facts[label].insert(text);
    }
    for (const auto& [device, clocks] : plan.devices) {
      facts["drivers"].insert(
          fmt::format("{}: {} {}", device.id, device.driver, device.driver_version));
    }
  }
  if (facts.empty()) return {};
  Html rows;
  for (const char* name : {"Triptych", "measured", "machine", "system", "drivers"}) {
    const auto found = facts.find(name);
    if (found == facts.end()) continue;
    std::set<std::string> texts = found->second;
    if (std::string_view(name) == "measured" && texts.size() > 1) {
      texts = {*texts.begin() + " to " + *texts.rbegin()};
    }
    rows += markup("<dt>{}</dt><dd>", name);
    for (const std::string& text : texts) rows += markup("<div>{}</div>", text);
    rows += markup("</dd>");
  }
  return folded("What was tested",
                markup("<dl>{}</dl>", rows) + command_block(gate_command(plans)));
}

Html card(const Overview& all, std::span<const PlanData> plans) {
  Html names;
  for (const PlanData& plan : plans) {
    names += markup(" · <a href=\"#{}\">{}</a>", plan.prefix, plan.name);
  }
  return markup(
      "<header id=\"verdict\" class=\"{}\"><h1>{} ({})</h1><p class=\"lead\">{}</p>{}"
      "{}<p>Triptych · {} {}{}{}</p>{}</header>\n",
      css_class(all.code), heading(all), static_cast<int>(all.code), lead(all), contents(all),
      circumstances_of(all), all.devices, all.devices == 1 ? "device" : "devices",
      all.part ? " · only part of the plans was judged" : "", names, tested_section(plans));
}

// Returns the verdict of a row, with a link to its first cause.
Html verdict_link(const CheckRow& row, const Overview& all) {
  const bool work = row.topic == judge::name_of(judge::Check::counters) ||
                    row.topic == judge::name_of(judge::Check::statistics);
  const auto first = std::ranges::find_if(all.open, [&](const Cause& cause) {
    const bool reported_with_image = work && cause.group.changed_counters > 0;
    return judge::topic_of(*cause.group.first) == row.topic || reported_with_image;
  });
  const bool open =
      row.worst == judge::Verdict::regression || row.worst == judge::Verdict::cannot_judge;
  if (!open || first == all.open.end()) return markup("{}", row.verdict);
  const auto number = static_cast<std::size_t>(first - all.open.begin());
  return markup("<a href=\"#{}\">{}</a>", cause_id(number), row.verdict);
}

Html check_table(const Overview& all) {
  Html text = markup("<table class=\"kinds\">\n");
  for (const CheckRow& row : all.rows) {
    text +=
        markup("<tr><th scope=\"row\">{}</th><td class=\"verdict {}\">{}</td><td>{}</td></tr>\n",
               row.label, judge::name_of(row.worst), verdict_link(row, all), row.sentence);
  }
  return text + markup("</table>\n");
}

Html bounds_table(const Overview& all) {
  if (all.bounds.empty()) return {};
  Rows rows{{"plan", "device", "images", "largest error / bound", "configuration"}};
  for (const NearestBound& bound : all.bounds) {
    rows.push_back({bound.plan, bound.device, fmt::to_string(bound.images),
                    fmt::format("{:.3g}", bound.share), breakable(bound.configuration)});
  }
  return folded("How close images come to their bounds", table(rows));
}

const PlanData& plan_of(const Cause& cause, std::span<const PlanData> plans) {
  return *std::ranges::find(plans, cause.result, &PlanData::verdict);
}

Html image_link(const PlanData& plan, const Finding& finding) {
  const auto drawn = [&](const record::Record& record) {
    return record.device == finding.device && record.configuration == finding.configuration &&
           has_panel(record);
  };
  if (!std::ranges::any_of(plan.records, drawn)) return {};
  return markup(" <a href=\"#{}\">image</a>",
                image_id(plan, finding.device, finding.configuration));
}

Html links(const Cause& cause, const PlanData& plan) {
  const Finding& first = *cause.group.first;
  if (!is_open(first)) return {};
  return image_link(plan, first) + markup(" <a href=\"#verdict\">verdict</a>");
}

// Returns the checks for which the filters show the cause. If counters or statistics changed
// together with wrong images, the cause of the wrong images is also shown for these checks.
std::string checks_of(const Cause& cause) {
  std::set<std::string_view> checks{judge::topic_of(*cause.group.first)};
  if (cause.group.changed_counters > 0) {
    std::set<std::pair<std::string_view, std::string_view>> places;
    for (const Finding* each : cause.group.members) {
      places.emplace(each->device, each->configuration);
    }
    for (const Finding& each : cause.result->findings) {
      const bool work =
          each.check == judge::Check::counters || each.check == judge::Check::statistics;
      if (work && is_open(each) && places.contains({each.device, each.configuration})) {
        checks.insert(judge::topic_of(each));
      }
    }
  }
  return fmt::format("{}", fmt::join(checks, " "));
}

Html note_block(const std::string& note) {
  return note.empty() ? Html() : markup("<p class=\"system\">{}</p>", note);
}

Html article(const Cause& cause, const PlanData& plan, const Html& id) {
  const Finding& first = *cause.group.first;
  const std::string command = command_of(first, *cause.result);
  const bool several = cause.group.configurations > 1;
  return markup(
      "<article class=\"{0}\"{1} data-kind=\"{2}\" data-device=\"{3}\" data-suite=\"{4}\" "
      "data-check=\"{11}\"><h3><span class=\"verdict {0}\">{5}</span> {6}</h3><p>{7}{8}</p>{9}{10}"
      "</article>\n",
      judge::name_of(first.verdict), id, is_open(first) ? "finding" : "remark",
      fmt::format("{}", fmt::join(cause.group.devices, " ")), suite_of(plan),
      judge::topic_of(first), breakable(words::location(cause)), words::text_of(cause),
      links(cause, plan),
      first.configuration.empty()
          ? Html()
          : markup("<p class=\"system\">{}{}</p>", several ? "the smallest configuration: " : "",
                   breakable(first.configuration)),
      command_block(command) + note_block(words::command_note(first, *cause.result)),
      checks_of(cause));
}

// Returns the causes. If `first_number` is set, they get element ids that contain their numbers.
Html articles(std::span<const Cause> causes, std::span<const PlanData> plans,
              std::optional<std::size_t> first_number) {
  Html text;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const Html id = first_number ? markup(" id=\"{}\"", cause_id(*first_number + i)) : Html();
    text += article(causes[i], plan_of(causes[i], plans), id);
  }
  return text;
}

Html findings(const Overview& all, std::span<const PlanData> plans) {
  const std::span<const Cause> open(all.open);
  const std::size_t shown = std::min(max_unfolded_causes, open.size());
  Html text;
  if (shown > 0) {
    text += markup("<h2 id=\"findings\">Findings</h2>\n") + articles(open.first(shown), plans, 0);
  }
  text += folded(fmt::format("{} more causes", open.size() - shown),
                 articles(open.subspan(shown), plans, shown));
  return text +
         folded(
             fmt::format(
                 "{} findings that do not affect the verdict: advisories, skips, known deviations",
                 all.remarks.size()),
             articles(all.remarks, plans, std::nullopt));
}

}  // namespace

Html verdict_card(const Overview& all, std::span<const PlanData> plans) {
  return card(all, plans);
}

Html findings_section(const Overview& all, std::span<const PlanData> plans) {
  return check_table(all) + bounds_table(all) + findings(all, plans);
}

Html terms_section(const Overview& all) {
  struct Term {
    std::string_view word;
    std::string_view meaning;
    std::string_view page;
  };
  constexpr std::array terms{
      Term{"reference image",
           "the image that the double-precision renderer computes with the same sample positions "
           "as the device",
           "docs/accuracy.md"},
      Term{"bound", "the largest error that a correct device can have in a pixel",
           "docs/accuracy.md"},
      Term{"limit", "the image to which images converge as the step size approaches 0",
           "docs/accuracy.md"},
      Term{"front", "the configurations that no other configuration beats in both error and time",
           "docs/accuracy.md"},
      Term{"stored", "accepted with `triptych accept`", "docs/baselines.md"},
      Term{"device key",
           "identifies all properties of the device that affect timings or exact pixel values",
           "docs/glossary.md"},
  };
  Rows rows{{"term", "meaning", "documentation"}};
  for (const auto& [word, meaning, page] : terms) rows.push_back({word, meaning, page});
  for (const CheckRow& row : all.rows) {
    const auto is = [&](judge::Check check) { return row.topic == judge::name_of(check); };
    const std::string_view page = is(judge::Check::cost)          ? "docs/cost.md"
                                  : is(judge::Check::code)        ? "docs/code.md"
                                  : is(judge::Check::correlation) ? "docs/correlation.md"
                                  : is(judge::Check::accuracy)    ? "docs/accuracy.md"
                                  : is(judge::Check::stress)      ? "docs/validate.md"
                                                                  : "docs/gate.md";
    rows.push_back({fmt::format("check {}", row.topic),
                    fmt::format("the check whose result is in the row “{}” above", row.label),
                    page});
  }
  return folded("Meaning of the terms", table(rows));
}

JudgedImages judged_images(const Overview& all, std::span<const PlanData> plans) {
  std::map<const Finding*, std::size_t> causes;
  for (std::size_t i = 0; i < all.open.size(); ++i) {
    for (const Finding* member : all.open[i].group.members) causes.emplace(member, i);
  }
  JudgedImages judged;
  for (const PlanData& plan : plans) {
    for (const Finding& finding : plan.verdict->findings) {
      if (finding.configuration.empty()) continue;
      JudgedImage& of = judged[image_id(plan, finding.device, finding.configuration)];
      of.checks.insert(judge::topic_of(finding));
      const auto cause = causes.find(&finding);
      if (cause != causes.end() && of.cause.empty()) of.cause = cause_id(cause->second);
    }
  }
  return judged;
}

std::string suite_of(const PlanData& plan) {
  return plan.records.empty() ? "" : plan.records.front().suite;
}

std::string image_id(const PlanData& plan, const std::string& device,
                     const std::string& configuration) {
  return fmt::format("{}-{}", plan.prefix, core::content_hash(device + '\n' + configuration));
}

}  // namespace triptych::report
