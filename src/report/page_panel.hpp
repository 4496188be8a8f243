#pragma once
// A device's picture of a scene beside the truth, or what there is instead.

#include <cstddef>
#include <string>
#include <vector>

#include "report/page_sections.hpp"

namespace triptych::report {

// The records of one device whose pictures are the same bits.
using SameBits = std::vector<const record::Record*>;

// What the panels of one scene have in common. It points into what it was made of.
struct PictureScene {
  const PictureSources& sources;
  const PlanData& plan;
  const std::vector<const record::Record*>& records;
  std::string title;
  std::size_t number;  // among those of the page
};

struct Panel {
  Html html;
  bool wrong = false;
  bool drawn = true;
  double ratio = 0;  // of the worst pixel to its bound
};

[[nodiscard]] Panel panel_of(const PictureScene& scene, const SameBits& group);

}  // namespace triptych::report
