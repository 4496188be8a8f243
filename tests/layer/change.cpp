#include "tests/layer/change.hpp"

#include <cstdlib>

namespace triptych::layer {
namespace {

Change read() {
  const char* text = std::getenv("TRIPTYCH_LAYER");
  if (text == nullptr) return {};
  const std::string_view all = text;
  const std::size_t equals = all.find('=');
  if (equals == std::string_view::npos) return {std::string(all)};
  return {std::string(all.substr(0, equals)),
          std::strtod(std::string(all.substr(equals + 1)).c_str(), nullptr)};
}

}  // namespace

const Change& change() {
  static const Change asked_for = read();
  return asked_for;
}

bool asked(std::string_view name) {
  return change().name == name;
}

std::uint32_t asked_number() {
  return static_cast<std::uint32_t>(change().value);
}

}  // namespace triptych::layer
