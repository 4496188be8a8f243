#pragma once
// Reference images for the window, rendered on a thread of low priority.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/truth_pair.hpp"
#include "measure/contract/suite.hpp"
#include "record/record.hpp"

namespace triptych::view {

struct Reference {
  accuracy::TruthPair pair;
  std::string error;  // why there is no pair; usually empty
};

class References {
 public:
  // `suite` is used on the other thread only. `changed` is called there when an image is ready.
  References(std::unique_ptr<measure::SuiteWithTruth> suite, std::function<void()> changed);
  // Does not wait for an image that is being rendered, which cannot be cancelled. So the process
  // must then end by std::_Exit.
  ~References();
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  // The reference image of the records that are shown now. Images that are missing are rendered one
  // after the other; those for records that are no longer shown are not.
  void show(const std::vector<const record::Record*>& records);
  // nullptr until it is rendered.
  [[nodiscard]] std::shared_ptr<const Reference> find(const record::Record& record) const;

 private:
  struct Shared;
  static void serve(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
};

}  // namespace triptych::view
