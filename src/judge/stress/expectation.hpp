#pragma once
// Checks whether a record of a stress case (a scene on which renderers often fail) meets its
// expectations: conditions such as equality with the image of another case.

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

  // Returns the record of the same device that has the levels in `changed`, and otherwise the same
  // levels as `record`. Returns nullptr if the run has no such record.
  [[nodiscard]] const record::Record* other_record(const record::Record& record,
                                                   const record::Changed& changed) const;
  // Returns the image of a record, or nullptr if the record has no image or the image cannot be
  // read from the store.
  [[nodiscard]] const core::Image* image(const record::Record& record);

 private:
  using Factors = std::map<std::string, std::string>;

  const record::Store& store_;
  // The records by device and factor levels.
  std::map<std::pair<std::string, Factors>, const record::Record*> index_;
  std::map<std::string, core::Image> images_;  // by the hash of the image
};

// Returns whether the run contains the second record with which the expectation compares `record`.
// Returns true for an expectation that needs no second record.
[[nodiscard]] bool has_other_record(const record::Expectation& expectation,
                                    const record::Record& record, const StressRun& run);

// Returns nullopt if the record meets the expectation, otherwise an observation that states why the
// expectation is not met. The record must have an image. The expectation MayBeRefused is always
// met.
[[nodiscard]] std::optional<Observation> violation_of(const record::Expectation& expectation,
                                                      const record::Record& record, StressRun& run,
                                                      const FindTruth& truth);

}  // namespace triptych::judge
