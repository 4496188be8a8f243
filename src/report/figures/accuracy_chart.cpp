#include "report/figures/accuracy_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "report/figures/figure.hpp"

namespace triptych::report {
namespace {

struct CostAxis {
  std::string title;
  std::string unit;  // the unit, written after each value
};
CostAxis axis_of(Cost cost) {
  switch (cost) {
    case Cost::time:
      return {"frame time, ms", "ms"};
    case Cost::samples:
      return {"samples taken", "samples"};
    case Cost::instructions:
      return {"instructions, millions", "million"};
    case Cost::fetched:
      return {"cache misses, MiB", "MiB"};
    case Cost::memory:
      return {"device memory, MiB", "MiB"};
    case Cost::energy:
      return {"energy per frame, J", "J"};
  }
  return {};
}

std::optional<double> cost_of(const accuracy::AccuracyCase& each, Cost cost) {
  const auto in = [](const auto& value, double unit) {
    return value ? std::optional(static_cast<double>(*value) / unit) : std::nullopt;
  };
  switch (cost) {
    case Cost::time:
      return in(each.time_ns, 1e6);
    case Cost::samples:
      return in(each.samples, 1);
    case Cost::instructions:
      return in(each.instructions, 1e6);
    case Cost::fetched:
      return in(each.fetched, 1 << 20);
    case Cost::memory:
      return in(each.memory, 1 << 20);
    case Cost::energy:
      return in(each.joules, 1);
  }
  return std::nullopt;
}

// Returns the name that determines the colour of a case: the name of its family (the configurations
// that differ only in the step size). For a family with only one member, returns the technique
// instead, because otherwise there could be as many colours as points.
std::string colour_name(const accuracy::AccuracyFamily& family,
                        const accuracy::AccuracyCase& each) {
  const auto technique = each.factors.find("technique");
  const bool alone = family.members.size() == 1 && technique != each.factors.end();
  return alone ? technique->second : family.name;
}

// Returns nullopt for a case whose error or cost is 0 or unknown, because logarithmic axes cannot
// show it.
std::optional<Figure::Place> place_of(const accuracy::AccuracyCase& each, Cost cost) {
  const auto value = cost_of(each, cost);
  if (!value || !(*value > 0) || !(each.rmse > 0)) return std::nullopt;
  return Figure::Place{each.rmse, *value};
}

// Formats a goal (an error for which the report states the cost) as "1/255", or as "0.0001" if the
// denominator would have many digits.
std::string goal_name(double goal) {
  constexpr double max_denominator = 9999;
  const double denominator = std::round(1 / goal);
  return denominator <= max_denominator ? fmt::format("1/{:.0f}", denominator) : short_number(goal);
}

std::vector<std::string> factors_of(const accuracy::AccuracyScene& scene) {
  std::vector<std::string> factors;
  std::istringstream text(scene.scene);
  for (std::string factor; std::getline(text, factor, ',');) factors.push_back(factor);
  return factors;
}

struct FigureSize {
  double width;
  double height;
};

// Returns the size of all diagrams. The legend is above the diagram and may have a line for each
// family, so diagrams with many families are enlarged: otherwise, the legend would be larger than
// the diagram.
FigureSize size_for(std::span<const accuracy::AccuracyScene> scenes) {
  constexpr std::size_t few_families = 4;
  const bool few = std::ranges::all_of(scenes, [](const accuracy::AccuracyScene& scene) {
    return scene.families.size() <= few_families;
  });
  return few ? FigureSize{230, 150} : FigureSize{400, 260};
}

// The figure of one scene on one device: a line for each family, the Pareto front in the colour of
// the text, and the goals as dashed lines.
class SceneFigure {
 public:
  // `all` contains the points of all diagrams that have the same axes as this one.
  SceneFigure(const accuracy::AccuracyScene& scene, const std::string& title, Cost cost,
              std::span<const Figure::Place> all, FigureSize size)
      : scene_(scene),
        cost_(cost),
        figure_(title + " on " + scene.device,
                {.title = "RMSE against the limit image",
                 .logarithmic = true,
                 .contains = coordinates(all, &Figure::Place::x)},
                {.title = axis_of(cost).title,
                 .logarithmic = true,
                 .contains = coordinates(all, &Figure::Place::y)},
                size.width, size.height) {}

  [[nodiscard]] Html svg() {
    find_front();
    collect_front_names();
    for (const accuracy::AccuracyFamily& family : scene_.families) add_family(family);
    if (figure_.empty()) return {};
    add_front();
    add_goals();
    return figure_.svg();
  }

 private:
  static std::vector<double> coordinates(std::span<const Figure::Place> places,
                                         double Figure::Place::*coordinate) {
    std::vector<double> values;
    for (const Figure::Place& place : places) values.push_back(place.*coordinate);
    return values;
  }
  // Finds the Pareto front for the displayed kind of cost, because the fastest configuration need
  // not be the one that needs the least memory.
  void find_front() {
    front_ = accuracy::pareto_front(scene_.cases, [this](const accuracy::AccuracyCase& each) {
      const auto place = place_of(each, cost_);
      return place ? std::optional(place->y) : std::nullopt;
    });
  }
  void collect_front_names() {
    for (const accuracy::AccuracyFamily& family : scene_.families) {
      const bool on_front = std::ranges::any_of(family.members, [&](std::size_t i) {
        return std::ranges::find(front_, i) != front_.end();
      });
      if (!on_front || front_names_.size() == colour_count) continue;
      front_names_.insert(colour_name(family, scene_.cases[family.members.front()]));
    }
  }
  // If there are more families than colours, only families on the Pareto front get a colour.
  std::string_view colour(const std::string& name) {
    const bool has_colour = front_names_.contains(name) || colours_.contains(name);
    if (!has_colour && (scene_.families.size() > colour_count || name.empty())) return "soft";
    const auto [found, added] = colours_.try_emplace(name, colour_of(colours_.size()));
    if (added && !name.empty()) figure_.legend(name, {.colour = found->second});
    return found->second;
  }
  void add_family(const accuracy::AccuracyFamily& family) {
    std::vector<Figure::Place> places;
    for (const std::size_t i : family.members) {
      const accuracy::AccuracyCase& each = scene_.cases[i];
      const auto place = place_of(each, cost_);
      if (!place) continue;
      places.push_back(*place);
      figure_.series(family.name.empty() ? "configurations" : family.name);
      figure_.point(*place, {.colour = colour(colour_name(family, each)), .opacity = 0.8},
                    fmt::format("{}: RMSE {:.3g}, {:.3g} {}", each.configuration, place->x,
                                place->y, axis_of(cost_).unit));
    }
    if (places.size() > 1) {
      const std::string name = colour_name(family, scene_.cases[family.members.front()]);
      figure_.line(places, {.colour = colour(name)}, family.name);
    }
  }
  void add_front() {
    std::vector<Figure::Place> places;
    for (const std::size_t i : front_) places.push_back(*place_of(scene_.cases[i], cost_));
    std::ranges::reverse(places);
    figure_.line(places, {.colour = "ink", .width = 1.6}, "the front");
    figure_.series({});
    for (const auto& place : places) figure_.point(place, {.colour = "ink", .hollow = true});
    figure_.legend("the front", {.colour = "ink"}, true);
  }
  void add_goals() {
    for (const double goal : accuracy::accuracy_goals) figure_.vertical_line(goal, goal_name(goal));
  }

  const accuracy::AccuracyScene& scene_;
  Cost cost_;
  Figure figure_;
  std::vector<std::size_t> front_;  // sorted by cost
  std::set<std::string> front_names_;
  std::map<std::string, std::string_view> colours_;
};

}  // namespace

std::string accuracy_title(std::span<const accuracy::AccuracyScene> scenes,
                           const accuracy::AccuracyScene& scene) {
  std::string title = scene.data;
  for (const std::string& factor : factors_of(scene)) {
    const auto lacks = [&](const accuracy::AccuracyScene& other) {
      const std::vector<std::string> other_factors = factors_of(other);
      return other.data == scene.data &&
             std::ranges::find(other_factors, factor) == other_factors.end();
    };
    if (std::ranges::any_of(scenes, lacks)) title += ", " + factor;
  }
  return title;
}

Html accuracy_chart(std::span<const accuracy::AccuracyScene> scenes, Cost cost) {
  std::vector<std::string> titles;
  std::map<std::string, std::vector<Figure::Place>> places;  // points on all devices, by title
  for (const accuracy::AccuracyScene& scene : scenes) {
    titles.push_back(accuracy_title(scenes, scene));
    for (const accuracy::AccuracyCase& each : scene.cases) {
      if (const auto place = place_of(each, cost)) places[titles.back()].push_back(*place);
    }
  }
  const FigureSize size = size_for(scenes);
  std::vector<TitledFigure> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Html svg = SceneFigure(scenes[i], titles[i], cost, places[titles[i]], size).svg();
    if (!svg.empty()) all.push_back({titles[i] + " on " + scenes[i].device, std::move(svg)});
  }
  return all.empty() ? Html() : figures(all);
}

}  // namespace triptych::report
