// The panels: per scene the truth, then every device's picture with its distance from the truth
// below.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <variant>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "judge/images/image_metrics.hpp"
#include "report/html.hpp"
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
      return group.front()->device == record->device && group.front()->image == record->image;
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

std::string truth_panel(const TruthOf& truth, const record::Record& record) {
  const auto found = truth_or_reason(truth, record);
  if (const auto* reason = std::get_if<std::string>(&found)) {
    return fmt::format("<figure><figcaption>{}</figcaption></figure>", escape(*reason));
  }
  return fmt::format("<figure>{}<figcaption>the truth<br>double precision</figcaption></figure>",
                     picture(std::get<judge::TruthPair>(found).truth, "the truth"));
}

std::string device_panel(const record::Store& store, const SameBits& group,
                         const std::vector<const record::Record*>& of_scene, const TruthOf& truth) {
  const record::Record& record = *group.front();
  const Image image = core::decode_exr(store.image(record.image));
  const std::string title = fmt::format("{}<br>{}{}", escape(record.device),
                                        escape(technique_names(group)), made_by(group, of_scene));
  const auto found = truth_or_reason(truth, record);
  if (const auto* reason = std::get_if<std::string>(&found)) {
    return fmt::format("<figure>{}<figcaption>{}<br>{}</figcaption></figure>",
                       picture(image, record.device), title, escape(*reason));
  }
  const auto& pair = std::get<judge::TruthPair>(found);
  const judge::ImageComparison result = judge::compare(image, pair.truth, pair.bound);
  if (result.size_mismatch) {
    return fmt::format("<figure>{}<figcaption>{}<br>wrong size</figcaption></figure>",
                       picture(image, record.device), title);
  }
  return fmt::format(
      "<figure>{}{}<figcaption>{}<br>largest error {:.2e} (bound there {:.2e})<br>RMSE {:.2e}"
      "<br><b class=\"{}\">{}</b></figcaption></figure>",
      picture(image, record.device),
      picture(share_of_bound(image, pair.truth, pair.bound), "error as a share of the bound"),
      title, result.largest.error, result.largest.bound, result.rmse,
      result.within_bound() ? "pass" : "regression",
      result.within_bound()
          ? fmt::format("within the bound, {:.0f} % of it used", 100 * result.worst.ratio)
          : fmt::format("{} pixels over the bound, {} of another particle or at another depth",
                        result.over_bound + result.non_finite,
                        result.wrong_ids + result.wrong_depths));
}

}  // namespace

std::string scenes_section(const record::Store& store, const PlanData& plan, const TruthOf& truth) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const record::Record*>> scenes;
  for (const record::Record& record : plan.records) {
    if (record.image.empty()) continue;
    auto& records = scenes[record.scene];
    if (records.empty()) order.push_back(record.scene);
    records.push_back(&record);
  }
  if (order.empty()) return {};
  std::string text =
      "<h3>Scenes</h3><p>The truth first; below each device's picture, its error as a share of the "
      "bound derived for that pixel: black 0, white the bound itself, magenta beyond it.</p>";
  for (const std::string& scene : order) {
    auto records = scenes[scene];
    std::ranges::stable_sort(records, {}, [](const record::Record* r) { return r->technique; });
    text += fmt::format("<h4>{}</h4><div class=\"panels\">{}",
                        escape(picture_title(plan, *records.front())),
                        truth_panel(truth, *records.front()));
    for (const SameBits& group : grouped_by_bits(records)) {
      text += device_panel(store, group, records, truth);
    }
    text += "</div>\n";
  }
  return text;
}

}  // namespace triptych::report
