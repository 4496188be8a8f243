#include "technique/sources.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "triptych_technique_embedded.hpp"

namespace triptych::technique {

std::string_view source(std::string_view name) {
  const std::string_view text = embedded(name);
  if (text.empty()) throw std::out_of_range("no shared device source " + std::string(name));
  return text;
}

std::string whole_source(std::string_view name) {
  constexpr std::string_view directive = "#include \"";
  std::string whole;
  std::string_view rest = source(name);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest.remove_prefix(line.size());
    if (line.starts_with(directive)) {
      const std::string_view path = line.substr(directive.size());
      whole += whole_source(path.substr(0, path.find('"')));
    } else {
      whole += line;
    }
  }
  return whole;
}

}  // namespace triptych::technique
