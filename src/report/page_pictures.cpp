// The truth, a device's picture and their difference beside each other: what is wrong first.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <variant>

#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "report/html.hpp"
#include "report/page_frame.hpp"
#include "report/page_sections.hpp"

namespace triptych::report {
namespace {

using core::Image;

// Error as a share of the bound: black 0, through blue and yellow to white at the bound itself;
// over it, where a value is not finite and where another particle is shown than must be, NaN, which
// PNGs show as magenta.
Image share_of_bound(const Image& image, const Image& truth, const Image& bound) {
  Image shares(image.width, image.height);
  for (std::size_t i = 0; i < shares.rgba.size(); i += 4) {
    double share = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = std::abs(static_cast<double>(image.rgba[i + c]) - truth.rgba[i + c]);
      share = error == 0 ? share : std::max(share, error / static_cast<double>(bound.rgba[i + c]));
      if (!std::isfinite(error)) share = std::numeric_limits<double>::infinity();
    }
    const bool certain = !truth.ids.empty() && bound.ids[i / 4] == 0;
    if (certain && image.ids[i / 4] != truth.ids[i / 4]) {
      share = std::numeric_limits<double>::infinity();
    }
    const auto ramp = [&](double from, double to) {
      return static_cast<float>(std::clamp((share - from) / (to - from), 0.0, 1.0));
    };
    shares.rgba[i] = share > 1 ? std::numeric_limits<float>::quiet_NaN() : ramp(0.2, 0.7);
    shares.rgba[i + 1] = ramp(0.3, 1.0);
    shares.rgba[i + 2] = std::max(0.4F * ramp(0.0, 0.2), ramp(0.8, 1.0));
    shares.rgba[i + 3] = 1;
  }
  return shares;
}

std::string picture(const Image& image, std::string_view alt) {
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                     data_uri(core::encode_png(image)), image.width, image.height, escape(alt));
}

// The records of one device whose pictures are the same bits.
using SameBits = std::vector<const record::Record*>;

std::vector<SameBits> grouped_by_bits(const std::vector<const record::Record*>& records) {
  std::vector<SameBits> groups;
  for (const record::Record* record : records) {
    const auto same = std::ranges::find_if(groups, [&](const SameBits& group) {
      return group.front()->device == record->device && group.front()->image == record->image &&
             group.front()->reason == record->reason;
    });
    if (same != groups.end()) {
      same->push_back(record);
    } else {
      groups.push_back({record});
    }
  }
  std::ranges::stable_sort(groups, {}, [](const SameBits& group) { return group.front()->device; });
  return groups;
}

std::string technique_names(const SameBits& group) {
  std::vector<std::string> names;
  for (const record::Record* record : group) {
    if (names.empty() || names.back() != record->technique) names.push_back(record->technique);
  }
  return fmt::format("{}{}", fmt::join(names, ", "), names.size() > 1 ? ": the same bits" : "");
}

// In what a picture was made differently from others of its scene: each factor of which the group
// does not hold every level seen there. The technique has a line of its own.
std::string made_by(const SameBits& group, const std::vector<const record::Record*>& of_scene) {
  std::map<std::string, std::set<std::string>> seen;
  std::map<std::string, std::set<std::string>> here;
  for (const record::Record* record : of_scene) {
    for (const auto& [factor, level] : record->factors) seen[factor].insert(level);
  }
  for (const record::Record* record : group) {
    for (const auto& [factor, level] : record->factors) here[factor].insert(level);
  }
  std::string text;
  for (const auto& [factor, levels] : here) {
    if (factor == "technique" || levels.size() == seen[factor].size()) continue;
    text += fmt::format("<br>{}: {}", escape(factor),
                        escape(fmt::format("{}", fmt::join(levels, ", "))));
  }
  return text;
}

using TruthOf = std::function<judge::TruthPair(const record::Record&)>;

// Or why there is none: the data's file is not here, say, and the store has not kept it.
std::variant<judge::TruthPair, std::string> truth_or_reason(const TruthOf& truth,
                                                            const record::Record& record) {
  try {
    return truth(record);
  } catch (const core::Error& error) {
    return fmt::format("no truth: {}", error.what());
  }
}

// A device's picture beside the truth, or what there is instead.
struct Panel {
  std::string html;
  bool wrong = false;
  double ratio = 0;  // of the worst pixel to its bound
};

std::string figure(const std::string& content, std::string_view caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>", content, caption);
}

std::string titled(const PlanData& plan, const SameBits& group,
                   const std::vector<const record::Record*>& of_scene, const std::string& figures,
                   const std::string& below) {
  std::string ids;
  for (const record::Record* record : group) {
    ids += fmt::format("<span id=\"{}\"></span>",
                       picture_id(plan, record->device, record->configuration));
  }
  return fmt::format(
      "<section>{}<h4>{}</h4><div class=\"triple\">{}</div><p class=\"system\">{}{}<br>{}</p>"
      "</section>\n",
      ids, breakable(group.front()->device), figures, escape(technique_names(group)),
      made_by(group, of_scene), below);
}

std::string verdict_text(const accuracy::ImageComparison& result) {
  const bool right = result.within_bound();
  std::string text = fmt::format("within the bound, {:.0f} % of it used", 100 * result.worst.ratio);
  if (!right)
    text = fmt::format("{} pixels beyond the bound", result.over_bound + result.non_finite);
  if (const std::size_t other = result.wrong_ids + result.wrong_depths; other > 0) {
    text += fmt::format(", {} of another particle or at another depth", other);
  }
  return fmt::format("<b class=\"{}\">{}</b><br>largest error {:.2e}, RMSE {:.2e}",
                     right ? "pass" : "regression", text, result.largest.error, result.rmse);
}

Panel panel_of(const record::Store& store, const PlanData& plan, const SameBits& group,
               const std::vector<const record::Record*>& of_scene, const TruthOf& truth) {
  const record::Record& record = *group.front();
  const auto whole = [&](const std::string& figures, const std::string& below) {
    return titled(plan, group, of_scene, figures, below);
  };
  const auto found = truth_or_reason(truth, record);
  const auto* pair = std::get_if<judge::TruthPair>(&found);
  const std::string reference = pair ? figure(picture(pair->truth, "the truth"), "the truth") : "";
  if (record.image.empty()) {
    const std::string_view what = record::name_of(record.outcome);
    return {whole(reference + figure(fmt::format("<div class=\"tile\">{}</div>", what), what),
                  "<b class=\"regression\">" + escape(record.reason) + "</b>"),
            true, std::numeric_limits<double>::infinity()};
  }
  const Image image = store.picture(record.image);
  const std::string drawn = figure(picture(image, record.device), escape(record.device));
  if (pair == nullptr) return {whole(drawn, escape(std::get<std::string>(found)))};
  const accuracy::ImageComparison result = accuracy::compare(image, pair->truth, pair->bound);
  if (result.size_mismatch) {
    return {whole(reference + drawn, "<b class=\"regression\">wrong size</b>"), true, 1};
  }
  const std::string difference = figure(
      picture(share_of_bound(image, pair->truth, pair->bound), "the difference"), "the difference");
  return {whole(reference + drawn + difference, verdict_text(result)), !result.within_bound(),
          result.worst.ratio};
}

struct Scene {
  std::string title;
  std::vector<Panel> panels;  // what is farthest from right first
  [[nodiscard]] bool wrong() const { return panels.front().wrong; }
};

bool has_tile(const record::Record& record) {
  return !record.image.empty() || (record.outcome != record::Outcome::measured &&
                                   record.outcome != record::Outcome::skipped);
}

void append_scenes(std::vector<Scene>& scenes, const record::Store& store, const PlanData& plan,
                   bool name_plan, const TruthOf& truth) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const record::Record*>> by_scene;
  for (const record::Record& record : plan.records) {
    if (!has_tile(record)) continue;
    auto& records = by_scene[record.scene];
    if (records.empty()) order.push_back(record.scene);
    records.push_back(&record);
  }
  for (const std::string& key : order) {
    auto records = by_scene[key];
    std::ranges::stable_sort(records, {}, [](const record::Record* r) { return r->technique; });
    Scene scene{(name_plan ? plan.name + ": " : "") + picture_title(plan, *records.front()), {}};
    for (const SameBits& group : grouped_by_bits(records)) {
      scene.panels.push_back(panel_of(store, plan, group, records, truth));
    }
    std::ranges::stable_sort(scene.panels, std::greater{}, [](const Panel& panel) {
      return std::pair(panel.wrong, std::isfinite(panel.ratio) ? panel.ratio : 0.0);
    });
    scenes.push_back(std::move(scene));
  }
}

std::string part(const Scene& scene, std::size_t from, std::size_t to) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) text += scene.panels[i].html;
  return text;
}

constexpr std::size_t open_scenes = 6;
constexpr std::size_t open_panels = 4;  // of a scene in which something is wrong

std::string scene_part(const Scene& scene, std::size_t from, std::size_t to) {
  if (from >= to) return {};
  return fmt::format("<h3>{}</h3><div class=\"panels{}\">{}</div>\n", breakable(scene.title),
                     scene.panels[from].wrong ? " wrong" : "", part(scene, from, to));
}

// Where nothing is wrong, one of each scene beside the others: the one nearest to its bound.
std::string one_of_each(std::span<const Scene> scenes) {
  std::string text = "<div class=\"panels\">";
  for (const Scene& scene : scenes) {
    text += "<section><h4>" + breakable(scene.title) + "</h4>" + part(scene, 0, 1) + "</section>";
  }
  return text + "</div>\n";
}

}  // namespace

std::string pictures_section(const record::Store& store, std::span<const PlanData> plans,
                             const TruthOf& truth) {
  std::vector<Scene> scenes;
  for (const PlanData& plan : plans) append_scenes(scenes, store, plan, plans.size() > 1, truth);
  if (scenes.empty()) return {};
  std::ranges::stable_sort(scenes, std::greater{}, &Scene::wrong);
  std::string text =
      "<h2 id=\"pictures\">Pictures</h2><p class=\"system\">The difference is the error as a share "
      "of the bound derived for that pixel: 0 <span class=\"ramp\"></span> the bound itself, <span "
      "class=\"beyond\"></span> beyond it.</p>";
  const std::size_t shown = std::min(open_scenes, scenes.size());
  const bool any_wrong = scenes.front().wrong();
  std::string rest;
  std::size_t left = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    std::size_t open = i < shown && !any_wrong ? 1 : 0;
    if (i < shown && scene.wrong()) {
      open = static_cast<std::size_t>(std::ranges::count(scene.panels, true, &Panel::wrong));
      open = std::min(open, open_panels);
      text += scene_part(scene, 0, open);
    }
    rest += scene_part(scene, open, scene.panels.size());
    left += scene.panels.size() - open;
  }
  if (!any_wrong) text += one_of_each(std::span(scenes).first(shown));
  return text + folded(fmt::format("{} more pictures", left), rest);
}

}  // namespace triptych::report
