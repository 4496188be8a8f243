#include "record/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"

namespace triptych::record {
namespace {

constexpr std::array<std::pair<Check, std::string_view>, 9> check_names{{
    {Check::image, "image"},
    {Check::counters, "counters"},
    {Check::statistics, "statistics"},
    {Check::cost, "cost"},
    {Check::memory, "memory"},
    {Check::timing, "timing"},
    {Check::correlation, "correlation"},
    {Check::accuracy, "accuracy"},
    {Check::stress, "stress"},
}};

}  // namespace

std::string_view name_of(Check check) {
  return std::ranges::find(check_names, check, &std::pair<Check, std::string_view>::first)->second;
}

Check check(std::string_view name) {
  const auto* const found =
      std::ranges::find(check_names, name, &std::pair<Check, std::string_view>::second);
  if (found != check_names.end()) return found->first;
  std::string known;
  for (const auto& [each, text] : check_names) known += fmt::format("{} ", text);
  throw core::InputError(fmt::format("unknown check '{}'; there are: {}", name, known));
}

Checks every_check() {
  Checks checks;
  for (const auto& [each, name] : check_names) checks.insert(each);
  return checks;
}

std::string text_of(const Checks& checks) {
  std::string text;
  for (const Check each : checks)
    text += fmt::format("{}{}", text.empty() ? "" : ",", name_of(each));
  return text;
}

Checks checks_of(std::string_view text) {
  Checks checks;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    checks.insert(check(text.substr(0, comma)));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return checks;
}

}  // namespace triptych::record
