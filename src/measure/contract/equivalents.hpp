#pragma once
// Finds configurations that do exactly the same work in a scene. Only one of them is measured, and
// its results are copied to all others.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

// A measured configuration that does exactly the same work as another configuration.
struct Equivalent {
  std::string key;
  std::string reason;  // for display, such as "skip: no brick of this scene is empty"
};

// The configurations that one device has measured. Suites know most equivalences in advance
// (Suite::plain()). This class finds one more kind of equivalence, which depends on an image: two
// configurations that differ only in the threshold for early ray termination are equivalent if no
// ray's transmittance falls below either threshold. The image of one of the configurations shows
// whether this is the case.
class Equivalents {
 public:
  [[nodiscard]] std::optional<Equivalent> find(const PlainWork& plain) const;

  // Adds the configuration `key`, together with its image.
  void add(const PlainWork& plain, const std::string& key, const Work& work,
           const core::Image& image);

 private:
  struct Known {
    std::string key;
    PlainWork plain;
    double least_transmittance;
  };
  std::map<Configuration, std::vector<Known>> known_;  // by PlainWork::levels
};

// Returns the smallest transmittance among the rays of all pixels. It is computed from the alpha
// channel of a premultiplied image and from the work's background. Returns 0 if the background is
// opaque or the scene is not a volume.
[[nodiscard]] double least_transmittance(const Work& work, const core::Image& image);

}  // namespace triptych::measure
