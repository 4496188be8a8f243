#include "report/page/page_panel.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>
#include <variant>

#include "accuracy/image_metrics.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "report/figures/share_of_bound.hpp"
#include "report/html.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

using core::Image;

std::vector<std::string> techniques_of(const IdenticalImages& group) {
  std::vector<std::string> names;
  for (const record::Record* record : group) {
    if (names.empty() || names.back() != record->technique) names.push_back(record->technique);
  }
  return names;
}

// Describes how an image was drawn. Lists only factors that have fewer levels in the group than in
// the scene, because the other factors do not distinguish the image from other images of the scene.
// The technique is left out, because panel_html() states it.
std::vector<std::string> distinguishing_factors(const IdenticalImages& group,
                                                const PanelScene& scene) {
  std::map<std::string, std::set<std::string>> in_scene;
  std::map<std::string, std::set<std::string>> in_group;
  for (const record::Record* record : scene.records) {
    for (const auto& [factor, level] : record->factors) in_scene[factor].insert(level);
  }
  for (const record::Record* record : group) {
    for (const auto& [factor, level] : record->factors) in_group[factor].insert(level);
  }
  std::vector<std::string> differences;
  for (const auto& [factor, levels] : in_group) {
    if (factor == "technique" || levels.size() == in_scene[factor].size()) continue;
    differences.push_back(fmt::format("{}: {}", factor, fmt::join(levels, ", ")));
  }
  return differences;
}

// Returns a name that distinguishes the image from the other images of the scene.
std::string name_of(const PanelScene& scene, const IdenticalImages& group) {
  std::string name =
      fmt::format("{}, {}", group.front()->device, fmt::join(techniques_of(group), ", "));
  for (const std::string& difference : distinguishing_factors(group, scene))
    name += ", " + difference;
  return name;
}

// Returns the reference image, or the reason why there is none. For example, the data file may be
// missing and the store may not contain the reference image.
std::variant<judge::TruthPair, std::string> truth_or_reason(const PanelSources& sources,
                                                            const record::Record& record) {
  try {
    return sources.truth(record);
  } catch (const core::Error& error) {
    return fmt::format("no reference image: {}", error.what());
  }
}

Html image_tag(const Image& image, std::string_view alt) {
  return markup("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                data_uri(core::encode_png(image)), image.width, image.height, alt);
}

// Returns the image with rings around the marked pixels, whose errors exceed their bounds.
Html ringed(const Html& image, const ShareOfBound& shares) {
  if (shares.marks.empty()) return image;
  Html rings;
  for (const ShareOfBound::Mark& mark : shares.marks) {
    for (const char* layer : {"under", "over"}) {
      rings += markup("<circle class=\"{}\" cx=\"{}.5\" cy=\"{}.5\" r=\"{}\"/>", layer, mark.x,
                      mark.y, shares.ring_radius);
    }
  }
  return markup(
      "<div class=\"ringed\">{}<svg viewBox=\"0 0 {} {}\" aria-hidden=\"true\">{}</svg></div>",
      image, shares.image.width, shares.image.height, rings);
}

Html figure(const Html& content, std::string_view caption) {
  return markup("<figure>{}<figcaption>{}</figcaption></figure>", content, caption);
}

// Returns the beginning of a panel, with the attributes used by the filters and by the comparison
// of images, and with the anchors for links.
Html panel_start(const PanelScene& scene, const IdenticalImages& group,
                 const ShareOfBound* shares) {
  Html ids;
  std::set<std::string_view> checks;
  for (const record::Record* record : group) {
    const std::string id = image_id(scene.plan, record->device, record->configuration);
    ids += markup("<span id=\"{}\"></span>", id);
    if (const auto found = scene.sources.judged.find(id); found != scene.sources.judged.end()) {
      checks.insert(found->second.checks.begin(), found->second.checks.end());
    }
  }
  Html text = markup(
      "<section data-kind=\"image\" data-device=\"{}\" data-suite=\"{}\" data-check=\"{}\" "
      "data-scene=\"{}\" data-title=\"{}\"",
      group.front()->device, group.front()->suite, fmt::format("{}", fmt::join(checks, " ")),
      scene.number, scene.title + ": " + name_of(scene, group));
  if (shares != nullptr && shares->x >= 0) {
    text += markup(" data-x=\"{}\" data-y=\"{}\"", shares->x, shares->y);
  }
  return text + markup(">") + ids;
}

Html finding_link(const PanelScene& scene, const IdenticalImages& group) {
  for (const record::Record* record : group) {
    const auto found =
        scene.sources.judged.find(image_id(scene.plan, record->device, record->configuration));
    if (found == scene.sources.judged.end() || found->second.cause.empty()) continue;
    return markup(" <a href=\"#{}\">finding</a>", found->second.cause);
  }
  return {};
}

// Returns a whole panel. `about` contains the verdict on the image; a description of how the image
// was drawn follows it.
Html panel_html(const PanelScene& scene, const IdenticalImages& group, const Html& figures,
                const Html& about, const ShareOfBound* shares = nullptr) {
  const std::vector<std::string> techniques = techniques_of(group);
  std::string description = fmt::format("technique: {}", fmt::join(techniques, ", "));
  if (techniques.size() > 1) description += ": bit-identical images";
  for (const std::string& difference : distinguishing_factors(group, scene))
    description += "; " + difference;
  return panel_start(scene, group, shares) +
         markup(
             "<h4>{}</h4><div class=\"triple\">{}</div><p class=\"system\">{}{}<br>{}</p>"
             "</section>\n",
             breakable(group.front()->device), figures, about, finding_link(scene, group),
             description);
}

Html verdict_text(const accuracy::ImageComparison& result, const ShareOfBound& shares) {
  const bool right = result.within_bound();
  std::string text = fmt::format("within the bound; the largest error is {:.0f} % of the bound",
                                 100 * result.worst.ratio);
  if (!right)
    text = fmt::format("{} pixels beyond the bound", result.over_bound + result.non_finite);
  if (const std::size_t other = result.wrong_ids + result.wrong_depths; other > 0) {
    text += fmt::format(", {} with a different particle or depth", other);
  }
  const std::string worst = right ? "" : fmt::format(", worst pixel ({}, {})", shares.x, shares.y);
  return markup("<b class=\"{}\">{}</b>{}<br>largest error {:.2e}, RMSE {:.2e}",
                right ? "pass" : "regression", text, worst, result.largest.error, result.rmse);
}

// Returns a tile that is shown instead of an image. It states the outcome, such as "crashed".
Html tile(const record::Record& record) {
  const std::string_view what = record::name_of(record.outcome);
  return figure(markup("<div class=\"tile\" role=\"img\" aria-label=\"{}: {}, no image\">{}</div>",
                       record.device, what, what),
                record.device);
}

}  // namespace

Panel panel_of(const PanelScene& scene, const IdenticalImages& group) {
  const record::Record& record = *group.front();
  const auto found = truth_or_reason(scene.sources, record);
  const auto* pair = std::get_if<judge::TruthPair>(&found);
  const Html reference =
      pair ? figure(image_tag(pair->truth, "the reference image"), "the reference image") : Html();
  if (record.image.empty()) {
    return {
        .html = panel_html(scene, group, reference + tile(record),
                           markup("<b class=\"regression\">{}</b>", words::text_of(record.reason))),
        .wrong = true,
        .drawn = false};
  }
  const std::string name = name_of(scene, group);
  const Image image = scene.sources.store.decoded_image(record.image);
  const Html drawn = figure(image_tag(image, name), record.device);
  if (pair == nullptr) {
    return {.html = panel_html(scene, group, drawn, markup("{}", std::get<std::string>(found)))};
  }
  const accuracy::ImageComparison result = accuracy::compare(image, pair->truth, pair->bound);
  if (result.size_mismatch) {
    return {.html = panel_html(scene, group, reference + drawn,
                               markup("<b class=\"regression\">wrong size</b>")),
            .wrong = true};
  }
  ShareOfBound shares = share_of_bound(image, pair->truth, pair->bound);
  if (result.over_bound > 0) {  // mark the pixel that the finding names
    shares.x = result.worst.x;
    shares.y = result.worst.y;
  }
  const Html difference = figure(
      ringed(image_tag(shares.image, "the difference image of " + name), shares), "the difference");
  return {.html = panel_html(scene, group, reference + drawn + difference,
                             verdict_text(result, shares), &shares),
          .wrong = !result.within_bound(),
          .ratio = result.worst.ratio};
}

}  // namespace triptych::report
