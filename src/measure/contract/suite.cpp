#include "measure/contract/suite.hpp"

#include "record/factor_list.hpp"

namespace triptych::measure {

std::string scene_key(const Suite& suite, const Configuration& configuration) {
  Configuration scene_factors;
  for (const Factor& factor : suite.factors()) {
    const auto found = configuration.find(factor.name);
    if (!factor.determines_image || found == configuration.end()) continue;
    if (factor.silent_default && found->second == factor.default_value) continue;
    scene_factors.insert(*found);
  }
  return record::factor_list(scene_factors);
}

}  // namespace triptych::measure
