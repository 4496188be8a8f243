#pragma once
// Reference images for the window. They are rendered on a thread with low priority.

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
  std::string error;  // why `pair` is empty; empty if there is a pair
};

class References {
 public:
  // Starts the thread. Only this thread uses `suite`. It calls `changed` whenever an image is
  // ready.
  References(std::unique_ptr<measure::SuiteWithTruth> suite, std::function<void()> changed);
  // Does not wait for an image that is being rendered, because rendering cannot be cancelled. The
  // process must therefore end with std::_Exit.
  ~References();
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  // Requests the reference images of the records that are visible now. Missing images are rendered
  // one after the other. Drops pending requests for records that are no longer visible.
  void show(const std::vector<const record::Record*>& records);
  // Returns nullptr if the image has not been rendered yet.
  [[nodiscard]] std::shared_ptr<const Reference> find(const record::Record& record) const;

 private:
  struct Shared;
  static void serve(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
};

}  // namespace triptych::view
