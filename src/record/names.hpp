#pragma once
// Converts between enumerators and their names. One table serves both directions.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace triptych::record {

template <typename Enum, std::size_t N>
using Names = std::array<std::pair<Enum, std::string_view>, N>;

template <typename Enum, std::size_t N>
[[nodiscard]] constexpr std::string_view name_in(const Names<Enum, N>& names, Enum value) {
  for (const auto& [each, name] : names) {
    if (each == value) return name;
  }
  return "unknown";
}

// Returns the enumerator with this name. If there is none, throws an InputError that lists the
// valid names. In the message, `what` describes the enumeration, such as "outcome".
template <typename Enum, std::size_t N>
[[nodiscard]] Enum value_named(const Names<Enum, N>& names, std::string_view what,
                               std::string_view name) {
  std::string known;
  for (const auto& [each, text] : names) {
    if (text == name) return each;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", text);
  }
  throw core::InputError(fmt::format("unknown {} '{}'; expected one of {}", what, name, known));
}

}  // namespace triptych::record
