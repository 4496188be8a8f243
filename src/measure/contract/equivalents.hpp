#pragma once
// Configurations whose frames a scene cannot tell apart: one of them is measured, the others take
// over what it told.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

// A configuration measured before whose frames were the very work that another would do.
struct Equivalent {
  std::string key;
  std::string reason;  // for people: "skip: no brick of this scene is empty"
};

// What one device has measured. A ray that never gets darker than some transmittance ends nowhere
// early below it: of configurations that differ by that threshold alone, one frame's picture tells
// for all. Everything else a suite has to know beforehand (Suite::plain).
class Equivalents {
 public:
  [[nodiscard]] std::optional<Equivalent> find(const PlainWork& plain) const;

  // `picture` as drawn by the configuration `key`.
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

// Of all pixels' rays, from the alpha of a premultiplied picture over the work's background; 0
// where the background hides it, and for what is no volume.
[[nodiscard]] double least_transmittance(const Work& work, const core::Image& picture);

}  // namespace triptych::measure
