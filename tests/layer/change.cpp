#include "tests/layer/change.hpp"

#include <algorithm>
#include <cstdlib>

namespace triptych::layer {
namespace {

Change read(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return {std::string(text)};
  return {std::string(text.substr(0, equals)),
          std::strtod(std::string(text.substr(equals + 1)).c_str(), nullptr)};
}

std::vector<Change> read_all(std::string_view text) {
  std::vector<Change> all;
  for (;;) {
    const std::size_t end = text.find(';');
    all.push_back(read(text.substr(0, end)));
    if (end == std::string_view::npos) return all;
    text.remove_prefix(end + 1);
  }
}

const Change* find(std::string_view name) {
  const auto found = std::ranges::find(changes(), name, &Change::name);
  return found == changes().end() ? nullptr : &*found;
}

}  // namespace

const std::string& requested() {
  static const std::string text = [] {
    const char* value = std::getenv("TRIPTYCH_LAYER");
    return std::string(value == nullptr ? "" : value);
  }();
  return text;
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all = read_all(requested());
  return all;
}

bool is_requested(std::string_view name) {
  return find(name) != nullptr;
}

double requested_value(std::string_view name) {
  const Change* const change = find(name);
  return change == nullptr ? 0 : change->value;
}

std::uint32_t requested_number(std::string_view name) {
  return static_cast<std::uint32_t>(requested_value(name));
}

}  // namespace triptych::layer
