#include "judge/baselines/waiver_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "core/glob.hpp"

namespace triptych::judge {
namespace {

// Whether the day exists.
bool is_iso_date(std::string_view text) {
  constexpr std::string_view shape = "dddd-dd-dd";
  const bool written_so = std::ranges::equal(
      text, shape, [](char c, char s) { return s == 'd' ? c >= '0' && c <= '9' : c == s; });
  if (!written_so) return false;
  const auto number = [&](std::size_t begin, std::size_t length) {
    return std::stoi(std::string(text.substr(begin, length)));
  };
  const std::chrono::year_month_day date{std::chrono::year(number(0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(8, 2)))};
  return date.ok();
}

}  // namespace

void refuse_other_keys(const core::JsonNode& entry, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : entry.members()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    value.fail(fmt::format("no such key; there are: {}", fmt::join(known, ", ")));
  }
}

std::string reason_of(const core::JsonNode& entry) {
  std::string reason = entry.at("reason").text();
  if (reason.find_first_not_of(" \t") == std::string::npos) {
    entry.at("reason").fail("expected a reason");
  }
  return reason;
}

std::string expiry_of(const core::JsonNode& entry) {
  std::string expiry = entry.at("expiry").text();
  if (!is_iso_date(expiry)) {
    entry.at("expiry").fail("expected a day of the calendar as YYYY-MM-DD");
  }
  return expiry;
}

bool matches_everything(std::string_view glob) {
  // Texts in the form of ids of devices, tests and configurations.
  constexpr std::array<std::string_view, 4> samples{"a:b#12", "zz9:q", "v.w.xyz.a:b#12",
                                                    "k=5,z=q_7"};
  return std::ranges::all_of(
      samples, [&](std::string_view sample) { return core::glob_matches(glob, sample); });
}

}  // namespace triptych::judge
