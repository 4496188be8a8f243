#include "report/page/history_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/json.hpp"
#include "report/figures/figure.hpp"
#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/words/history.hpp"

namespace triptych::report {
namespace {

using core::Json;

std::string name_of_store(const Json& point) {
  return point.at("name").get<std::string>();
}

// Returns the driver version, followed by the injected faults, which the driver did not cause.
std::string driver_of(const Json& point) {
  std::string text = point.at("driver_version").get<std::string>();
  if (const auto found = point.find("injected"); found != point.end()) {
    text += fmt::format(" [injected: {}]", fmt::join(found->get<std::vector<std::string>>(), ", "));
  }
  return text;
}

// The axis covers at least this relative change in both directions, so that tiny changes do not
// look like a trend.
constexpr double min_axis_change = 0.01;

// Returns an axis that covers the values of all devices, and at least `min_axis_change` in both
// directions.
Axis axis_of(const Json& history) {
  Axis axis{.title = "relative to the first store"};
  std::vector<double> values;
  for (const Json& device : history) {
    for (const Json& point : device.at("points")) {
      for (const char* key : {"cost", "time"}) {
        if (point.contains(key)) values.push_back(point.at(key).get<double>());
      }
    }
  }
  if (values.empty()) return axis;
  const auto [low, high] = std::ranges::minmax(values);
  const double middle = (low + high) / 2;
  axis.contains = {low, high};
  if (high - low >= 2 * min_axis_change * middle) return axis;
  axis.low = (1 - min_axis_change) * middle;
  axis.high = (1 + min_axis_change) * middle;
  return axis;
}

std::string number_text(const Json& point, const char* key) {
  return point.contains(key) ? fmt::format("{:.4f}", point.at(key).get<double>()) : "–";
}

// Returns the change of the times since the previous store, and whether the clocks differ.
std::string change_of(const Json& point) {
  std::string text =
      point.contains("time_change") ? point.at("time_change").at("text").get<std::string>() : "–";
  if (point.contains("changed_clocks")) {
    text += "; " + point.at("changed_clocks").get<std::string>();
  }
  return text;
}

// Creates a figure with one category per store. A store without a value has no point.
Html figure_of(const Json& device, const Axis& up) {
  const Json& points = device.at("points");
  std::vector<std::string> names;
  for (const Json& point : points) names.push_back(name_of_store(point));
  Figure figure("Cost and time of each store relative to the first store",
                {.title = "store", .names = std::move(names)}, up, 320, 180);
  struct Series {
    const char* key;
    Style style;
  };
  for (const Series& series :
       {Series{"cost", {.colour = "c0"}},
        Series{"time", {.colour = "c1", .mark = Mark::triangle, .dashed = true}}}) {
    std::vector<Figure::Place> places;
    figure.series(series.key);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].contains(series.key)) continue;
      places.push_back({static_cast<double>(i), points[i].at(series.key).get<double>()});
      figure.point(places.back(), series.style, number_text(points[i], series.key));
    }
    if (places.empty()) continue;
    figure.line(places, series.style);
    figure.legend(series.key, series.style, true);
  }
  return figure.empty() ? markup("<p>Neither cost nor time was measured.</p>\n") : figure.svg();
}

Html table_of(const Json& device) {
  Rows rows{
      {"store", "started", "driver", "cost", "time", "time / time in previous store", "changes"}};
  for (const Json& point : device.at("points")) {
    const std::string changes = point.at("changes").get<std::string>();
    const Html summary = point.at("worse").get<bool>() ? markup("<b class=\"regression\">worse</b>")
                                                       : markup("changed");
    rows.push_back({name_of_store(point), point.at("started_at").get<std::string>(),
                    driver_of(point), number_text(point, "cost"), number_text(point, "time"),
                    change_of(point),
                    changes.empty() ? Html() : folded(summary, markup("<pre>{}</pre>", changes))});
  }
  return table(rows);
}

}  // namespace

std::string history_page(const Json& history) {
  Html page = page_begin("History");
  page += markup(
      "<main><h1>History</h1>\n<p>Cost is the number of instructions per frame, in generated code "
      "and in the driver. Cost and time are geometric means over the configurations that "
      "consecutive stores have in common. Times are wall-clock times. They are shown, but they "
      "do not affect any verdict. {}</p>\n",
      words::noise_note());
  const Axis up = axis_of(history);
  for (const Json& device : history) {
    page += markup("<h2>{}</h2>\n", device.at("device").get<std::string>());
    if (device.contains("first_worse")) {
      page += markup("<p><b class=\"regression\">First store that is worse</b>: {}</p>\n",
                     device.at("first_worse").get<std::string>());
    }
    page += figure_of(device, up) + table_of(device);
  }
  return (page + markup("</main>") + page_end()).text();
}

}  // namespace triptych::report
