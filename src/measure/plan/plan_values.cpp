#include "measure/plan/plan_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/json_text.hpp"
#include "core/nearest_name.hpp"
#include "core/text.hpp"

namespace triptych::measure {
namespace {

// Parses a finite number. Returns nullopt for any other text. The canonical spelling of a number is
// the shortest text that is read back as the same double. Therefore 0.5, .5 and 5e-1 are spellings
// of the same value.
std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_complete = error == std::errc() && end == text.data() + text.size();
  if (!is_complete || !std::isfinite(number)) return std::nullopt;
  return number == 0 ? 0 : number;  // −0 becomes 0
}

std::string canonical_number(const Factor& factor, const PlacedText& value) {
  if (std::ranges::find(factor.levels, value.text) != factor.levels.end()) return value.text;
  const std::optional<double> number = parse_number(value.text);
  if (!number) {
    throw core::InputError(
        value.place, fmt::format("'{}': expected a number, found '{}'", factor.name, value.text));
  }
  if (*number < factor.minimum || *number > factor.maximum) {
    throw core::InputError(value.place,
                           fmt::format("'{}': {} is out of range; expected {} to {}", factor.name,
                                       *number, factor.minimum, factor.maximum));
  }
  return fmt::format("{}", *number);
}

std::string canonical_choice(const Factor& factor, const PlacedText& value) {
  if (std::ranges::find(factor.levels, value.text) != factor.levels.end()) return value.text;
  throw core::InputError(value.place,
                         fmt::format("'{}' has no level '{}'{}", factor.name, value.text,
                                     suggestion(value.text, factor.levels)));
}

// Rejects control characters and line ends, because a configuration must fit on one line of a list,
// a table or a baseline, and must be usable in JSON and XML.
std::string canonical_text(const Factor& factor, const PlacedText& value) {
  if (value.text.empty() || !core::is_line(value.text)) {
    throw core::InputError(value.place,
                           fmt::format("'{}': a value must not be empty, and must be UTF-8 "
                                       "without line breaks or control characters; found {}",
                                       factor.name, core::json_text(value.text)));
  }
  return value.text;
}

std::string canonical(const Suite& suite, const Factor& factor, const PlacedText& value) {
  // A plan may write the default of a factor even if it is "auto", which is not one of the factor's
  // levels.
  if (value.text == factor.default_value) return default_of(factor);
  std::string text;
  switch (factor.kind) {
    case FactorKind::number:
      text = canonical_number(factor, value);
      break;
    case FactorKind::choice:
      text = canonical_choice(factor, value);
      break;
    case FactorKind::text:
      text = canonical_text(factor, value);
      break;
  }
  try {
    suite.check(factor, text);
  } catch (const core::InputError& error) {
    throw core::InputError(value.place, fmt::format("'{}': {}", factor.name, error.what()));
  }
  return text;
}

bool stands_for_several(const Factor& factor, const PlacedText& value) {
  return value.text == "auto" && !factor.automatic.empty();
}

// Replaces a value such as "orbit_y:*/8" in a text factor by "orbit_y:0/8" to "orbit_y:7/8", and
// "auto" by the factor's automatic levels. Each new value gets the place (line and column) of the
// text that it replaces.
std::vector<PlacedText> with_expanded_ranges(const Factor& factor,
                                             const std::vector<PlacedText>& values) {
  constexpr std::string_view all = ":*/";
  constexpr int most = 10'000;
  std::vector<PlacedText> result;
  for (const PlacedText& value : values) {
    if (stands_for_several(factor, value)) {
      for (const std::string& level : factor.automatic) result.push_back({level, value.place});
      continue;
    }
    const std::size_t at = value.text.find(all);
    if (factor.kind != FactorKind::text || at == std::string::npos) {
      result.push_back(value);
      continue;
    }
    const std::string count = value.text.substr(at + all.size());
    const std::optional<double> n = parse_number(count);
    if (!n || *n != std::floor(*n) || *n < 1 || *n > most) {
      throw core::InputError(
          value.place, fmt::format("'{}': '{}': expected a whole number from 1 to {} after '*/'",
                                   factor.name, value.text, most));
    }
    for (int i = 0; i < static_cast<int>(*n); ++i) {
      result.push_back({fmt::format("{}:{}/{}", value.text.substr(0, at), i, *n), value.place});
    }
  }
  return result;
}

}  // namespace

std::string suggestion(std::string_view wrong, const std::vector<std::string>& known) {
  if (const auto nearest = core::nearest_name(wrong, known)) {
    return fmt::format("; did you mean '{}'?", *nearest);
  }
  return fmt::format("; expected one of: {}", fmt::join(known, ", "));
}

std::string default_of(const Factor& factor) {
  if (factor.kind == FactorKind::number) {
    if (const auto number = parse_number(factor.default_value)) return fmt::format("{}", *number);
  }
  return factor.default_value;
}

bool is_automatic(const Factor& factor, const std::vector<PlacedText>& given) {
  return std::ranges::any_of(
      given, [&](const PlacedText& value) { return stands_for_several(factor, value); });
}

std::vector<std::string> canonical_values(const Suite& suite, const Factor& factor,
                                          const std::vector<PlacedText>& given) {
  const std::vector<PlacedText> values = with_expanded_ranges(factor, given);
  std::vector<std::string> result;
  for (const PlacedText& value : values) {
    std::string text = canonical(suite, factor, value);
    const auto duplicate = std::ranges::find(result, text);
    if (duplicate != result.end()) {
      const PlacedText& first = values[static_cast<std::size_t>(duplicate - result.begin())];
      throw core::InputError(
          value.place, fmt::format("'{}': {} appears twice{}", factor.name, value.text,
                                   first.text == value.text ? "" : ", first as " + first.text));
    }
    result.push_back(std::move(text));
  }
  return result;
}

}  // namespace triptych::measure
