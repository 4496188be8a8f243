#include "measure/suite.hpp"

namespace triptych::measure {

std::string scene_key(const Suite& suite, const Configuration& configuration) {
  std::string key;
  for (const auto& [name, value] : configuration) {
    for (const Factor& factor : suite.factors()) {
      if (factor.name == name && factor.of_scene) {
        if (!key.empty()) key += ',';
        key += name;
        key += '=';
        key += value;
      }
    }
  }
  return key;
}

}  // namespace triptych::measure
