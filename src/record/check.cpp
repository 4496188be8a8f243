#include "record/check.hpp"

#include <fmt/format.h>

#include "record/names.hpp"

namespace triptych::record {
namespace {

constexpr Names<Check, 10> check_names{{
    {Check::image, "image"},
    {Check::counters, "counters"},
    {Check::statistics, "statistics"},
    {Check::cost, "cost"},
    {Check::code, "code"},
    {Check::memory, "memory"},
    {Check::timing, "timing"},
    {Check::correlation, "correlation"},
    {Check::accuracy, "accuracy"},
    {Check::stress, "stress"},
}};

}  // namespace

std::string_view name_of(Check check) {
  return name_in(check_names, check);
}

Check check(std::string_view name) {
  return named_in(check_names, "check", name);
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
