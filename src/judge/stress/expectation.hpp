#pragma once
// Whether what a stress case expects of its record holds.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "judge/stress/stress.hpp"

namespace triptych::judge {

// The records of one run with their pictures, each read once. The records must outlive it.
class StressRun {
 public:
  StressRun(const record::Store& store, const std::vector<record::Record>& records);

  // nullptr where the run has none.
  [[nodiscard]] const record::Record* other(const record::Record& record,
                                            const record::Changed& changed) const;
  // nullptr where the record has none, or the store's cannot be read.
  [[nodiscard]] const core::Image* picture(const record::Record& record);

 private:
  using Factors = std::map<std::string, std::string>;

  const record::Store& store_;
  std::map<std::pair<std::string, Factors>, const record::Record*> index_;  // by device and key
  std::map<std::string, core::Image> pictures_;                             // by hash
};

// Whether the run has the other record that an expectation is about; true where it is about none.
[[nodiscard]] bool has_other(const record::Expectation& expectation, const record::Record& record,
                             const StressRun& run);

// Nothing where it holds, else what does not. The record has an image; MayBeRefused always holds.
[[nodiscard]] std::optional<Observation> unmet(const record::Expectation& expectation,
                                               const record::Record& record, StressRun& run,
                                               const FindTruth& truth);

}  // namespace triptych::judge
