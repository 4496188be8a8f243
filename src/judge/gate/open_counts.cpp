#include "judge/gate/open_counts.hpp"

#include "judge/gate/open_fragments.hpp"

namespace triptych::judge {

double OpenCounts::of(const std::string& counter) {
  const double fragments = open_fragments(counter, record_);
  if (fragments > 0 || !find_) return fragments;
  if (!known_) known_ = find_(record_);
  const auto found = known_->find(counter);
  return found == known_->end() ? 0 : found->second;
}

}  // namespace triptych::judge
