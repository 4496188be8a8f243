#include "judge/gate/open_counts.hpp"

#include "core/error.hpp"
#include "judge/gate/open_fragments.hpp"

namespace triptych::judge {

double OpenCounts::of(const std::string& counter) {
  const double fragments = open_fragments(counter, record_);
  if (!find_) return fragments;
  if (!known_) {
    try {
      known_ = find_(record_);
    } catch (const core::Error&) {
      known_.emplace();  // the check `image` reports why the scene is not available
    }
  }
  const auto found = known_->find(counter);
  return found == known_->end() ? fragments : fragments + found->second;
}

}  // namespace triptych::judge
