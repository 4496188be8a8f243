// Run time against error: the diagrams, the orders, what an accuracy costs, what an error is made
// of.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "report/accuracy_chart.hpp"
#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using judge::AccuracyScene;
using judge::Order;

std::string error_text(double error) {
  return fmt::format("{:.2e}", error);
}

std::string order_text(const std::optional<Order>& order) {
  if (!order) return "";
  return fmt::format("{:.2f} ± {:.2f} ({} steps)", order->order, order->half_width, order->points);
}

const judge::AccuracyFamily& family_of(const AccuracyScene& scene, std::size_t index) {
  return *std::ranges::find_if(scene.families, [index](const judge::AccuracyFamily& family) {
    return std::ranges::find(family.members, index) != family.members.end();
  });
}

std::string summary_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"data", "device", "order in the step", "least error", "time to 1/255",
             "time to 1/1024", "time to 1e-4", "on the front", "dominated"}};
  for (const AccuracyScene& scene : scenes) {
    const std::size_t best = judge::most_accurate(scene.cases);
    std::vector<std::string> row{escape(scene.data), escape(scene.device),
                                 order_text(family_of(scene, best).order),
                                 error_text(scene.cases[best].rmse)};
    for (const double goal : judge::accuracy_goals) {
      const auto time = judge::time_to_error(scene.cases, scene.families, goal);
      row.push_back(time ? duration(*time) : "not reached");
    }
    row.push_back(fmt::format("{}", scene.front.size()));
    row.push_back(fmt::format("{} of {}", scene.dominated.size(), scene.cases.size()));
    rows.push_back(std::move(row));
  }
  return table(rows);
}

std::string order_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"data", "device", "family", "order ± 95 %", "coarsest", "finest"}};
  for (const AccuracyScene& scene : scenes) {
    for (const judge::AccuracyFamily& family : scene.families) {
      rows.push_back({escape(scene.data), escape(scene.device), escape(family.name),
                      order_text(family.order),
                      error_text(scene.cases[family.members.front()].rmse),
                      error_text(scene.cases[family.members.back()].rmse)});
    }
  }
  return table(rows);
}

std::string parts_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"data", "device", "what is changed", "RMSE", "largest", "time"}};
  for (const AccuracyScene& scene : scenes) {
    const std::size_t best = judge::most_accurate(scene.cases);
    const judge::AccuracyCase& least = scene.cases[best];
    const auto row = [&](std::string what, double error, std::string largest, std::string time) {
      rows.push_back({escape(scene.data), escape(scene.device), std::move(what), error_text(error),
                      std::move(largest), std::move(time)});
    };
    row("nothing: the most accurate, " + escape(least.configuration), least.rmse,
        error_text(least.largest), duration(least.time_ns));
    if (least.factors.contains("step")) row("its step alone", least.lattice, "", "");
    row("its rounding, storage and early termination", least.arithmetic, "", "");
    for (const judge::Switched& each : judge::switched_alone(scene.cases, best)) {
      const judge::AccuracyCase& other = scene.cases[each.index];
      row(escape(fmt::format("{} {} → {}", each.factor, each.from, each.to)), other.rmse,
          error_text(other.largest), duration(other.time_ns));
    }
    row("output with 8 bits a channel", scene.eight_bits, "", "");
    if (scene.representation) row("voxel size and table", *scene.representation, "", "");
    row("the limit’s own uncertainty, at most", scene.uncertainty, "", "");
  }
  return table(rows);
}

std::string dominated_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"device", "configuration", "RMSE", "time", "beaten by", "RMSE", "time"}};
  for (const AccuracyScene& scene : scenes) {
    for (const judge::Dominated& each : scene.dominated) {
      const judge::AccuracyCase& worse = scene.cases[each.index];
      const judge::AccuracyCase& better = scene.cases[each.by];
      rows.push_back({escape(scene.device), escape(worse.configuration), error_text(worse.rmse),
                      duration(worse.time_ns), escape(better.configuration),
                      error_text(better.rmse), duration(better.time_ns)});
    }
  }
  return table(rows);
}

std::string folded(std::string_view summary, const std::string& body) {
  return fmt::format("<details><summary>{}</summary>{}</details>\n", summary, body);
}

}  // namespace

std::string accuracy_section(const PlanData& plan) {
  const std::vector<AccuracyScene>& scenes = plan.verdict->accuracies;
  if (scenes.empty()) return {};
  const bool counted = std::ranges::any_of(scenes, [](const AccuracyScene& scene) {
    return std::ranges::any_of(scene.cases,
                               [](const auto& each) { return each.samples.has_value(); });
  });
  std::string text =
      "<h3>Run time against error</h3><p>The error is the root mean square over all channels, in "
      "linear float, against the picture that the scene tends to as its sampling is refined. A "
      "line "
      "joins configurations that differ by their step alone; black: the front, which nothing "
      "beats on both axes; dashed: 1/255, 1/1024 and 1e-4. A time to an error is read off between "
      "two neighbours of a line.</p>" +
      summary_table(scenes) +
      chart(plan.anchor + "-accuracy-time", accuracy_chart(scenes, Cost::time));
  if (counted) {
    text += "<p>The same against the samples taken, which no clock disturbs.</p>" +
            chart(plan.anchor + "-accuracy-samples", accuracy_chart(scenes, Cost::samples));
  }
  return text + folded("Orders of all families", order_table(scenes)) +
         folded("What an error is made of: each factor switched alone", parts_table(scenes)) +
         folded("Dominated configurations", dominated_table(scenes));
}

}  // namespace triptych::report
