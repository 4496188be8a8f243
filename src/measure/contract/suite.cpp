#include "measure/contract/suite.hpp"

#include "record/factor_list.hpp"

namespace triptych::measure {

std::string scene_key(const Suite& suite, const Configuration& configuration) {
  Configuration of_scene;
  for (const Factor& factor : suite.factors()) {
    const auto found = configuration.find(factor.name);
    if (!factor.of_scene || found == configuration.end()) continue;
    if (factor.silent_default && found->second == factor.standard) continue;
    of_scene.insert(*found);
  }
  return record::factor_list(of_scene);
}

}  // namespace triptych::measure
