#include "record/check.hpp"

#include <fmt/format.h>

#include "record/names.hpp"

namespace triptych::record {
namespace {

// Returns the name of a check, or an empty string if there is no such check. This is a switch
// rather than a table, so that the compiler warns about a check without a name.
constexpr std::string_view checked_name(Check check) {
  switch (check) {
    case Check::image:
      return "image";
    case Check::counters:
      return "counters";
    case Check::statistics:
      return "statistics";
    case Check::cost:
      return "cost";
    case Check::code:
      return "code";
    case Check::memory:
      return "memory";
    case Check::timing:
      return "timing";
    case Check::correlation:
      return "correlation";
    case Check::accuracy:
      return "accuracy";
    case Check::stress:
      return "stress";
  }
  return {};
}

constexpr std::size_t check_count = [] {
  std::size_t count = 0;
  while (!checked_name(static_cast<Check>(count)).empty()) ++count;
  return count;
}();

constexpr Names<Check, check_count> check_names = [] {
  Names<Check, check_count> names{};
  for (std::size_t i = 0; i < check_count; ++i) {
    names[i] = {static_cast<Check>(i), checked_name(static_cast<Check>(i))};
  }
  return names;
}();

}  // namespace

std::string_view name_of(Check check) {
  return name_in(check_names, check);
}

Check check(std::string_view name) {
  return value_named(check_names, "check", name);
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
