#pragma once
// A panel with a device's image of a scene next to the reference image. If there is no image, the
// panel states the reason, for example a crash.

#include <cstddef>
#include <string>
#include <vector>

#include "report/page/page_sections.hpp"

namespace triptych::report {

// The records of one device whose images are bit-identical.
using IdenticalImages = std::vector<const record::Record*>;

// The data that all panels of a scene have in common. Refers to data that the caller owns.
struct PanelScene {
  const PanelSources& sources;
  const PlanData& plan;
  const std::vector<const record::Record*>& records;
  std::string title;
  std::size_t number;  // number of the scene on the page
};

struct Panel {
  Html html;
  bool wrong = false;
  bool drawn = true;
  double ratio = 0;  // the error of the worst pixel divided by its bound
};

[[nodiscard]] Panel panel_of(const PanelScene& scene, const IdenticalImages& group);

}  // namespace triptych::report
