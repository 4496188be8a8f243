#pragma once
// Configurations that do exactly the same work in a scene. One of them is measured, and the others
// copy its results.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

// A configuration that was measured before and does exactly the work of another one.
struct Equivalent {
  std::string key;
  std::string reason;  // for display: "skip: no brick of this scene is empty"
};

// The configurations that one device has measured. If the transmittance of a ray never falls below
// some value, an early termination below it changes nothing. For configurations that differ only in
// that threshold, the image of one frame therefore shows whether they are equivalent. A suite knows
// all other equivalences in advance (Suite::plain).
class Equivalents {
 public:
  [[nodiscard]] std::optional<Equivalent> find(const PlainWork& plain) const;

  // Adds the configuration `key`, together with its image.
  void add(const PlainWork& plain, const std::string& key, const Work& work,
           const core::Image& picture);

 private:
  struct Known {
    std::string key;
    PlainWork plain;
    double least_transmittance;
  };
  std::map<Configuration, std::vector<Known>> known_;  // by PlainWork::levels
};

// The smallest transmittance of all pixels' rays, from the alpha of a premultiplied image over the
// work's background; 0 if the background is opaque, and for anything other than a volume.
[[nodiscard]] double least_transmittance(const Work& work, const core::Image& picture);

}  // namespace triptych::measure
