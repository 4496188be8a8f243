#pragma once
// Decides whether the expectations of a stress case hold for its record.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "judge/stress/stress.hpp"

namespace triptych::judge {

// The records of one run and their images. Each image is read once. The records must outlive this
// object.
class StressRun {
 public:
  StressRun(const record::Store& store, const std::vector<record::Record>& records);

  // nullptr if the run has no such record.
  [[nodiscard]] const record::Record* other(const record::Record& record,
                                            const record::Changed& changed) const;
  // nullptr if the record has no image, or if the image in the store cannot be read.
  [[nodiscard]] const core::Image* picture(const record::Record& record);

 private:
  using Factors = std::map<std::string, std::string>;

  const record::Store& store_;
  std::map<std::pair<std::string, Factors>, const record::Record*> index_;  // by device and key
  std::map<std::string, core::Image> pictures_;                             // by hash
};

// Whether the run has the other record that an expectation needs; true for an expectation that
// needs none.
[[nodiscard]] bool has_other(const record::Expectation& expectation, const record::Record& record,
                             const StressRun& run);

// nullopt if the expectation holds, otherwise what does not hold. The record must have an image.
// MayBeRefused always holds.
[[nodiscard]] std::optional<Observation> unmet(const record::Expectation& expectation,
                                               const record::Record& record, StressRun& run,
                                               const FindTruth& truth);

}  // namespace triptych::judge
