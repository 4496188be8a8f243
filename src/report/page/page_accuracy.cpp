// Shows run time against error: figures, orders of convergence, the cost of reaching a given error,
// and the contributions to an error.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "report/figures/accuracy_chart.hpp"
#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

using accuracy::AccuracyScene;
using accuracy::Order;

std::string error_text(double error) {
  return fmt::format("{:.2e}", error);
}

std::string order_text(const std::optional<Order>& order) {
  if (!order) return "";
  return fmt::format("{:.2f} ± {:.2f} ({} step sizes)", order->order, order->half_width,
                     order->points);
}

std::string time_text(const accuracy::AccuracyCase& each) {
  return each.time_ns ? duration(*each.time_ns) : "";
}

const accuracy::AccuracyFamily& family_of(const AccuracyScene& scene, std::size_t index) {
  return *std::ranges::find_if(scene.families, [index](const accuracy::AccuracyFamily& family) {
    return std::ranges::find(family.members, index) != family.members.end();
  });
}

// Returns the largest area (hypervolume) of a Pareto front on any device. Considers only scenes
// with the same limit image (with exact ray integrals) as `scene`.
const accuracy::FrontArea& largest_area(const std::vector<AccuracyScene>& scenes,
                                        const AccuracyScene& scene) {
  const accuracy::FrontArea* best = &*scene.area;
  for (const AccuracyScene& other : scenes) {
    const bool comparable = other.limit == scene.limit && other.area.has_value();
    if (comparable && other.area->area > best->area) best = &*other.area;
  }
  return *best;
}

void append_area(TableRow& row, const std::vector<AccuracyScene>& scenes,
                 const AccuracyScene& scene) {
  if (scene.area) {
    row.push_back(fmt::format("{:.1f}", scene.area->area));
    row.push_back(
        fmt::format("{:.2f}", accuracy::equal_slowdown(largest_area(scenes, scene), *scene.area)));
  } else {
    row.insert(row.end(), 2, "");
  }
}

std::optional<double> instructions_of(const accuracy::AccuracyCase& each) {
  return each.instructions;
}

// Returns the cost of reaching the error `goal`: the time if times were measured, otherwise the
// number of instructions.
std::string cost_to_reach(const AccuracyScene& scene, double goal) {
  if (!scene.front.empty()) {
    const auto time = accuracy::time_to_error(scene.cases, scene.families, goal);
    return time ? duration(*time) : "not reached";
  }
  if (std::ranges::none_of(scene.cases,
                           [](const auto& each) { return each.instructions.has_value(); }))
    return "";
  const auto cost = accuracy::cost_to_error(scene.cases, scene.families, instructions_of, goal);
  return cost ? fmt::format("{:.1f} M instructions", *cost / 1e6) : "not reached";
}

// Appends the number of configurations on the Pareto front and the number of dominated
// configurations. The cost is the time or, if no time was measured, the number of instructions. The
// cells are empty if neither was measured.
void append_front_counts(TableRow& row, const AccuracyScene& scene) {
  const auto add = [&](std::size_t front, std::size_t dominated) {
    row.push_back(fmt::to_string(front));
    row.push_back(fmt::format("{} of {}", dominated, scene.cases.size()));
  };
  if (!scene.front.empty()) return add(scene.front.size(), scene.dominated.size());
  const auto front = accuracy::pareto_front(scene.cases, instructions_of);
  if (!front.empty()) {
    return add(front.size(), accuracy::dominated(scene.cases, front, instructions_of).size());
  }
  row.insert(row.end(), 2, "");
}

Html summary_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"scene", "device", "order of convergence", "smallest error",
             "cost to reach RMSE 1/255", "cost to reach RMSE 1/1024", "cost to reach RMSE 1e-4",
             "hypervolume", "slowdown relative to the best device", "configurations on the front",
             "dominated"}};
  for (const AccuracyScene& scene : scenes) {
    const std::size_t best = accuracy::most_accurate(scene.cases);
    TableRow row{accuracy_title(scenes, scene), scene.device,
                 order_text(family_of(scene, best).order), error_text(scene.cases[best].rmse)};
    for (const double goal : accuracy::accuracy_goals) {
      row.push_back(cost_to_reach(scene, goal));
    }
    append_area(row, scenes, scene);
    append_front_counts(row, scene);
    rows.push_back(std::move(row));
  }
  return table(rows);
}

Html order_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"scene", "device", "family", "order of convergence (95 % confidence interval)",
             "RMSE at the coarsest step", "RMSE at the finest step"}};
  for (const AccuracyScene& scene : scenes) {
    for (const accuracy::AccuracyFamily& family : scene.families) {
      rows.push_back({accuracy_title(scenes, scene), scene.device, family.name,
                      order_text(family.order),
                      error_text(scene.cases[family.members.front()].rmse),
                      error_text(scene.cases[family.members.back()].rmse)});
    }
  }
  return table(rows);
}

std::string level(const accuracy::AccuracyCase& each, const std::string& factor) {
  return each.factors.at(factor);
}

// Writes the rows about the contributions to the error, for one scene on one device.
class ErrorContributions {
 public:
  ErrorContributions(const std::vector<AccuracyScene>& scenes, const AccuracyScene& scene,
                     Rows& rows)
      : scenes_(scenes), scene_(scene), title_(accuracy_title(scenes, scene)), rows_(rows) {}

  void append() {
    const accuracy::AccuracyCase& least = scene_.cases[accuracy::most_accurate(scene_.cases)];
    add("most accurate configuration: " + least.configuration, "", least.rmse,
        error_text(least.largest), time_text(least));
    if (least.factors.contains("step")) add("error due to the step size", "", least.lattice);
    add("error due to rounding, storage and early ray termination", "", least.arithmetic);
    for (const accuracy::FactorSwitch& each : accuracy::single_factor_switches(scene_.cases)) {
      add(each, scene_.cases[each.to], "");
    }
    for (const AccuracyScene& other : scenes_) {
      if (other.device != scene_.device || other.limit == scene_.limit) continue;
      const auto each = accuracy::factor_switch_between(scene_.cases, other.cases, "viewport");
      if (each) add(*each, other.cases[each->to], " (a different image)");
    }
    add("error due to 8-bit output", "", scene_.eight_bit_error);
    if (scene_.representation)
      add("error due to the voxel size and the transfer-function table", "",
          *scene_.representation);
    add("upper bound on the uncertainty of the limit image", "", scene_.uncertainty);
  }

 private:
  void add(const std::string& what, std::string before, double error, std::string largest = {},
           std::string time = {}) {
    rows_.push_back({title_, scene_.device, what, std::move(before), error_text(error),
                     std::move(largest), std::move(time)});
  }
  void add(const accuracy::FactorSwitch& each, const accuracy::AccuracyCase& to,
           const char* remark) {
    const accuracy::AccuracyCase& from = scene_.cases[each.from];
    add(fmt::format("{} {} → {}{}", each.factor, level(from, each.factor), level(to, each.factor),
                    remark),
        error_text(from.rmse), to.rmse, error_text(to.largest), time_text(to));
  }

  const std::vector<AccuracyScene>& scenes_;
  const AccuracyScene& scene_;
  std::string title_;
  Rows& rows_;
};

Html contributions_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"scene", "device", "change", "RMSE before", "RMSE", "largest error", "time"}};
  for (const AccuracyScene& scene : scenes) ErrorContributions(scenes, scene, rows).append();
  return table(rows);
}

Html dominated_table(const std::vector<AccuracyScene>& scenes) {
  Rows rows{{"device", "configuration", "RMSE", "time", "dominated by", "RMSE", "time"}};
  for (const AccuracyScene& scene : scenes) {
    for (const accuracy::Dominated& each : scene.dominated) {
      const accuracy::AccuracyCase& worse = scene.cases[each.index];
      const accuracy::AccuracyCase& better = scene.cases[each.by];
      rows.push_back({scene.device, worse.configuration, error_text(worse.rmse), time_text(worse),
                      better.configuration, error_text(better.rmse), time_text(better)});
    }
  }
  return table(rows);
}

// A kind of cost other than time. It is plotted if it was measured. If there is a title, the plot
// is folded under this title.
struct CostChart {
  Cost cost;
  std::string_view title;
  std::string_view text;
};
constexpr CostChart cost_charts[]{
    {Cost::samples, "", "Error against the number of samples, which is the same in every run."},
    {Cost::instructions, "",
     "Error against the number of instructions per frame, in device code and in the driver."},
    {Cost::fetched, "Bytes fetched against error",
     "Image error plotted against the bytes that the device code fetches on misses in a simulated "
     "cache of 32 KiB."},
    {Cost::memory, "Memory against error",
     "Image error plotted against the bytes that a configuration allocates on the device: data, "
     "tables, bricks "
     "and images. Packed cells need four or eight times as much memory as the voxels."},
    {Cost::energy, "Energy against error",
     "Image error plotted against the energy per frame according to the machine’s meters, which "
     "also measure "
     "idle power and other programs."}};

Html other_cost_charts(const std::vector<AccuracyScene>& scenes) {
  Html text;
  for (const auto& [cost, title, sentence] : cost_charts) {
    const Html chart = accuracy_chart(scenes, cost);
    if (chart.empty()) continue;
    const Html body = markup("<p>{}</p>{}", sentence, chart);
    text += title.empty() ? body : folded(title, body);
  }
  return text;
}

}  // namespace

Html accuracy_section(const PlanData& plan) {
  const std::vector<AccuracyScene>& scenes = plan.verdict->accuracies;
  if (scenes.empty()) return {};
  Html text =
      markup(
          "<h3>Run time against error</h3><p>The error is the root mean square difference from the "
          "limit image over all channels, in linear floats. Images converge to the limit image as "
          "the step size approaches 0. A line joins the configurations of a family, which differ "
          "only in their step size. The thick line is the front: the configurations that no other "
          "configuration beats in both error and time. The dashed lines mark the errors 1/255, "
          "1/1024 and 1e-4; the cost of reaching such an error is interpolated between two "
          "neighbours on a line. The hypervolume is the area, in natural logarithms, between the "
          "front and the point with a time of one second and the error of an empty image. The "
          "slowdown is the factor by which every time of the device with the largest hypervolume "
          "would have to grow until this hypervolume is only as large as that of the device in the "
          "row. The slowdown is based on the times of one run and "
          "does not affect the verdict.</p>") +
      summary_table(scenes);
  text += accuracy_chart(scenes, Cost::time) + other_cost_charts(scenes);
  text += folded("Orders of convergence of all families", order_table(scenes)) +
          folded("Contributions to the error: one factor is changed at a time",
                 contributions_table(scenes));
  const bool timed =
      std::ranges::any_of(scenes, [](const AccuracyScene& scene) { return !scene.front.empty(); });
  if (timed) text += folded("Dominated configurations", dominated_table(scenes));
  return text;
}

}  // namespace triptych::report
