#pragma once
// How a stress case went on a device: one point for a picture at all, one for the right one, one
// for the one that other devices show.

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
  FindExpectations expectations;  // nothing: there are none
  // Of a part of a plan: what is expected beside a picture that has no record is not asked.
  bool part = false;
};

struct StressScore {
  bool drawn = false;   // a finite picture, without a crash, a hang or an error
  bool right = false;   // within its bound of the truth, and all that is expected of it holds
  bool agreed = false;  // no device that is nearer to the truth shows another picture
  std::vector<Observation> lost = {};  // why, of every point that is missing

  [[nodiscard]] int points() const {
    return static_cast<int>(drawn) + static_cast<int>(right) + static_cast<int>(agreed);
  }
};
inline constexpr int best_stress_score = 3;

struct StressScored {
  const record::Record* record;  // into the records given
  StressScore score;
};

// `records`: all of one run, for a device is held against the others and a picture against others
// of its device; those skipped for what their device lacks are left out. A case that may be refused
// has all points where it is. Where no other device drew a configuration, none contradicts.
[[nodiscard]] std::vector<StressScored> score_stress(const record::Store& store,
                                                     const std::vector<record::Record>& records,
                                                     const StressTruths& truths);

}  // namespace triptych::judge
