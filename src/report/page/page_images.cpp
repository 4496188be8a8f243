// Shows the reference image, a device's image and their difference next to each other. Wrong images
// come first.

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "report/html.hpp"
#include "report/page/page_frame.hpp"
#include "report/page/page_panel.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

std::vector<IdenticalImages> grouped_by_image(const std::vector<const record::Record*>& records) {
  std::vector<IdenticalImages> groups;
  for (const record::Record* record : records) {
    const auto same = std::ranges::find_if(groups, [&](const IdenticalImages& group) {
      return group.front()->device == record->device && group.front()->image == record->image &&
             group.front()->outcome == record->outcome &&
             record::is_same_kind(group.front()->reason, record->reason);
    });
    if (same != groups.end()) {
      same->push_back(record);
    } else {
      groups.push_back({record});
    }
  }
  std::ranges::stable_sort(groups, {},
                           [](const IdenticalImages& group) { return group.front()->device; });
  return groups;
}

struct Scene {
  std::string title;
  std::vector<Panel> panels;  // sorted by the error relative to the bound, the largest first
  [[nodiscard]] bool wrong() const { return panels.front().wrong; }
  // Returns the sort key. Scenes with wrong images come first, the largest error relative to the
  // bound first, and then scenes in which no image was drawn.
  [[nodiscard]] std::tuple<bool, bool, double> rank() const {
    return {wrong(), panels.front().drawn, wrong() ? panels.front().ratio : 0};
  }
};

void append_scenes(std::vector<Scene>& scenes, const PanelSources& sources, const PlanData& plan,
                   bool name_plan) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const record::Record*>> by_scene;
  for (const record::Record& record : plan.records) {
    if (!has_panel(record)) continue;
    auto& records = by_scene[record.scene];
    if (records.empty()) order.push_back(record.scene);
    records.push_back(&record);
  }
  for (const std::string& key : order) {
    auto records = by_scene[key];
    std::ranges::stable_sort(records, {}, [](const record::Record* r) { return r->technique; });
    Scene scene{(name_plan ? plan.name + ": " : "") + image_title(plan, *records.front()), {}};
    const PanelScene of{sources, plan, records, scene.title, scenes.size()};
    for (const IdenticalImages& group : grouped_by_image(records)) {
      scene.panels.push_back(panel_of(of, group));
    }
    std::ranges::stable_sort(scene.panels, std::greater{}, [](const Panel& panel) {
      return std::tuple(panel.wrong, panel.drawn, panel.ratio);
    });
    scenes.push_back(std::move(scene));
  }
}

Html panels_html(const Scene& scene, std::size_t from, std::size_t to) {
  Html text;
  for (std::size_t i = from; i < to; ++i) text += scene.panels[i].html;
  return text;
}

constexpr std::size_t max_visible_scenes = 6;
// The maximum number of panels that are not folded in a scene with a wrong image.
constexpr std::size_t max_visible_panels = 4;

Html scene_part(const Scene& scene, std::size_t from, std::size_t to) {
  if (from >= to) return {};
  return markup("<div class=\"scene\"><h3>{}</h3><div class=\"panels{}\">{}</div></div>\n",
                breakable(scene.title), scene.panels[from].wrong ? " wrong" : "",
                panels_html(scene, from, to));
}

// Shows, for each scene, the image whose error comes closest to its bound. Used if no image is
// wrong.
Html one_image_per_scene(std::span<const Scene> scenes) {
  Html text = markup("<div class=\"panels\">");
  for (const Scene& scene : scenes) {
    text += markup("<div class=\"scene\"><h3>{}</h3>{}</div>", breakable(scene.title),
                   panels_html(scene, 0, 1));
  }
  return text + markup("</div>\n");
}

}  // namespace

bool has_panel(const record::Record& record) {
  return !record.image.empty() || (record.outcome != record::Outcome::measured &&
                                   record.outcome != record::Outcome::skipped);
}

ImagesSection images_section(const PanelSources& sources, std::span<const PlanData> plans) {
  std::vector<Scene> scenes;
  for (const PlanData& plan : plans) append_scenes(scenes, sources, plan, plans.size() > 1);
  if (scenes.empty()) return {};
  std::ranges::stable_sort(scenes, std::greater{}, &Scene::rank);
  Html text = markup(
      "<h2 id=\"images\">Images</h2><p class=\"system\">The reference image is rendered in "
      "double "
      "precision with the same sample positions. The difference image shows the error of each "
      "pixel "
      "as a share of the pixel’s bound: 0 <span class=\"ramp\"></span> the bound. If the error "
      "exceeds "
      "the bound: slightly <span class=\"beyond\"></span> by the largest factor in the image, on a "
      "logarithmic scale. Rings mark the worst pixels beyond the bound.</p>");
  const std::size_t shown = std::min(max_visible_scenes, scenes.size());
  const bool any_wrong = scenes.front().wrong();
  Html rest;
  std::size_t left = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    std::size_t open = i < shown && !any_wrong ? 1 : 0;
    if (i < shown && scene.wrong()) {
      open = static_cast<std::size_t>(std::ranges::count(scene.panels, true, &Panel::wrong));
      open = std::min(open, max_visible_panels);
      text += scene_part(scene, 0, open);
    }
    rest += scene_part(scene, open, scene.panels.size());
    left += scene.panels.size() - open;
  }
  if (!any_wrong) text += one_image_per_scene(std::span(scenes).first(shown));
  return {text + folded(fmt::format("{} more images", left), rest), any_wrong};
}

}  // namespace triptych::report
