#include "technique/sources.hpp"

#include <stdexcept>
#include <string>

#include "triptych_technique_embedded.hpp"

namespace triptych::technique {

std::string_view source(std::string_view name) {
  const std::string_view text = embedded(name);
  if (text.empty()) throw std::out_of_range("no shared device source " + std::string(name));
  return text;
}

}  // namespace triptych::technique
