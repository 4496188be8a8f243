#pragma once
// A device's image of a scene next to the reference image, or a text if there is no image.

#include <cstddef>
#include <string>
#include <vector>

#include "report/page/page_sections.hpp"

namespace triptych::report {

// The records of one device whose images have the same bits.
using SameBits = std::vector<const record::Record*>;

// The common data of the panels of one scene. Contains pointers into the data from which it was
// made.
struct PictureScene {
  const PictureSources& sources;
  const PlanData& plan;
  const std::vector<const record::Record*>& records;
  std::string title;
  std::size_t number;  // number of the panel on the page
};

struct Panel {
  Html html;
  bool wrong = false;
  bool drawn = true;
  double ratio = 0;  // the error of the worst pixel divided by its bound
};

[[nodiscard]] Panel panel_of(const PictureScene& scene, const SameBits& group);

}  // namespace triptych::report
