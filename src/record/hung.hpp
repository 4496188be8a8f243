#pragma once
// A configuration that gave no answer in time says so in its reason, with the time that it had.

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace triptych::record {

// What a configuration has unless somebody says otherwise.
inline constexpr std::chrono::seconds standard_limit{60};

inline constexpr std::string_view no_answer = "no answer within ";

[[nodiscard]] inline std::string no_answer_within(std::chrono::milliseconds limit) {
  return fmt::format("{}{:g} s", no_answer, std::chrono::duration<double>(limit).count());
}

// Of a reason, or of a message that quotes one; nothing where it tells of no such end.
[[nodiscard]] inline std::optional<std::chrono::seconds> limit_in(std::string_view text) {
  const std::size_t begin = text.find(no_answer);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view number = text.substr(begin + no_answer.size());
  double seconds = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), seconds);
  if (error != std::errc() || !(seconds > 0 && seconds < 1e6)) return std::nullopt;
  return std::chrono::seconds(std::lround(std::ceil(seconds)));
}

}  // namespace triptych::record
