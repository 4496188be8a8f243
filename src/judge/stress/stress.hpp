#pragma once
// Scores a stress case (a scene on which renderers often fail) on a device: one point for drawing
// an image, one point if the image is correct, and one point if it agrees with the images of other
// devices.

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
  FindExpectations expectations;  // if this function is empty, there are no expectations
  // Whether the records are incomplete, because they belong to only a part of the plan or because
  // the run is unfinished. In this case, an expectation that needs another record is not checked if
  // that record is missing.
  bool part = false;
};

struct StressScore {
  bool drawn = false;    // a finite image was drawn without a crash, a hang or an error
  bool correct = false;  // the image is within its bound, and all expectations of the case hold
  bool agreed = false;   // every differing image of another device is farther from the reference
  std::vector<Observation> lost_points = {};  // the reasons for the missing points

  [[nodiscard]] int points() const {
    return static_cast<int>(drawn) + static_cast<int>(correct) + static_cast<int>(agreed);
  }
};
inline constexpr int best_stress_score = 3;

struct ScoredRecord {
  const record::Record* record;  // points into the given records
  StressScore score;
};

// Scores all records. `records` must contain all records of one run, because devices are compared
// with each other, and images with other images of the same device. A skipped record gets no score,
// unless the case has the expectation MayBeRefused; in this case it gets all points. A
// configuration that no other device drew gets the point for agreement.
[[nodiscard]] std::vector<ScoredRecord> score_stress(const record::Store& store,
                                                     const std::vector<record::Record>& records,
                                                     const StressTruths& truths);

}  // namespace triptych::judge
