#include "judge/baselines/waiver_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "core/glob.hpp"

namespace triptych::judge {
namespace {

// Converts `text`, which must have the form YYYY-MM-DD.
std::chrono::year_month_day date_of(std::string_view text) {
  const auto number = [&](std::size_t begin, std::size_t length) {
    return std::stoi(std::string(text.substr(begin, length)));
  };
  return {std::chrono::year(number(0, 4)), std::chrono::month(static_cast<unsigned>(number(5, 2))),
          std::chrono::day(static_cast<unsigned>(number(8, 2)))};
}

// Returns whether `text` has the form YYYY-MM-DD and is a valid calendar date.
bool is_iso_date(std::string_view text) {
  constexpr std::string_view date_shape = "dddd-dd-dd";
  const bool has_date_shape = std::ranges::equal(
      text, date_shape, [](char c, char s) { return s == 'd' ? c >= '0' && c <= '9' : c == s; });
  return has_date_shape && date_of(text).ok();
}

// Returns whether the glob matches all samples. The samples are names of the same kind (such as
// device ids) that have nothing in common except the form of these names. A glob that matches all
// of them therefore matches every name of this kind.
template <std::size_t N>
bool matches_all(std::string_view glob, const std::array<const char*, N>& samples) {
  return std::ranges::all_of(
      samples, [&](std::string_view sample) { return core::glob_matches(glob, sample); });
}

}  // namespace

void refuse_unknown_keys(const core::JsonNode& entry,
                         std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : entry.members()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    value.fail(fmt::format("unknown key; expected one of: {}", fmt::join(known, ", ")));
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
    entry.at("expiry").fail("expected a calendar date, YYYY-MM-DD");
  }
  return expiry;
}

std::optional<int> days_between(std::string_view from, std::string_view to) {
  if (!is_iso_date(from) || !is_iso_date(to)) return std::nullopt;
  return static_cast<int>(
      (std::chrono::sys_days(date_of(to)) - std::chrono::sys_days(date_of(from))).count());
}

void refuse_distant_expiry(const core::JsonNode& expiry, const std::string& today) {
  constexpr int most_days = 366;
  const auto days = days_between(today, expiry.text());
  if (!days || *days <= most_days) return;  // expiry_of() reports a value that is not a date
  expiry.fail(
      fmt::format("is more than {} days after {}; choose an earlier date by which somebody "
                  "will review whether the entry is still needed",
                  most_days, today));
}

bool matches_every_device(std::string_view glob) {
  return matches_all(glob, std::array{"a:b#12", "zz9:q"});
}

bool matches_every_host(std::string_view glob) {
  return matches_all(glob, std::array{"a", "zz-9.q"});
}

bool matches_every_test(std::string_view glob) {
  return matches_all(glob, std::array{"a.b.cdef.g:h#12", "zz9.quick.xyz.v:w"});
}

bool matches_every_configuration(std::string_view glob) {
  return matches_all(glob, std::array{"a=5,z=q_7", "k=c:d"});
}

}  // namespace triptych::judge
