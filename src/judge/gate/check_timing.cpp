#include "judge/gate/run_view.hpp"

namespace triptych::judge {

std::vector<Finding> check_timings(const RunView& /*view*/, const WrongImages& /*wrong*/) {
  return {};
}

}  // namespace triptych::judge
