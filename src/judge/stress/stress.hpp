#pragma once
// Scores a stress case on a device: one point for drawing an image at all, one for the right image,
// and one for the image that other devices draw.

#include <functional>
#include <string>
#include <vector>

#include "accuracy/truth_pair.hpp"
#include "judge/finding.hpp"
#include "record/expectation.hpp"
#include "record/store.hpp"

namespace triptych::judge {

using accuracy::TruthPair;
using FindTruth = std::function<TruthPair(const record::Record&)>;
using FindExpectations = std::function<std::vector<record::Expectation>(const record::Record&)>;

struct StressTruths {
  FindTruth truth;
  FindExpectations expectations;  // empty: there are no expectations
  // Whether the records are only a part of a plan. In that case, an expectation is not checked if
  // the other image that it needs is not among them.
  bool part = false;
};

struct StressScore {
  bool drawn = false;   // a finite image was drawn without a crash, a hang or an error
  bool right = false;   // the image is within its bound, and all expectations of the case hold
  bool agreed = false;  // no image that is nearer to the reference image differs from this one
  std::vector<Observation> lost = {};  // the reason for every point that is missing

  [[nodiscard]] int points() const {
    return static_cast<int>(drawn) + static_cast<int>(right) + static_cast<int>(agreed);
  }
};
inline constexpr int best_stress_score = 3;

struct StressScored {
  const record::Record* record;  // points into the given records
  StressScore score;
};

// `records` must be all records of one run, because devices are compared with each other and images
// with other images of the same device. Records that were skipped because the device lacks
// something get no score. A case that may be refused has all points if it is refused. If no other
// device drew a configuration, none contradicts it.
[[nodiscard]] std::vector<StressScored> score_stress(const record::Store& store,
                                                     const std::vector<record::Record>& records,
                                                     const StressTruths& truths);

}  // namespace triptych::judge
