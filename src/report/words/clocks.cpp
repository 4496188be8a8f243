#include "report/words/clocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace triptych::report::words {
namespace {

// Returns "the device clock", or "the device clock (19 configurations) and the wall clock (1)".
std::string clock_names(const record::ClockCounts& clocks) {
  if (clocks.size() == 1) return fmt::format("the {} clock", clocks.begin()->first);
  std::string text;
  for (const auto& [clock, configurations] : clocks) {
    text += text.empty() ? fmt::format("the {} clock ({} configurations)", clock, configurations)
                         : fmt::format(" and the {} clock ({})", clock, configurations);
  }
  return text;
}

}  // namespace

std::string trust_of(const std::vector<record::ClockTrust>& clocks) {
  if (std::ranges::none_of(clocks, &record::ClockTrust::offered)) return "none";
  if (std::ranges::all_of(clocks, &record::ClockTrust::trusted)) return "trusted";
  std::string trusted;
  for (const record::ClockTrust& clock : clocks) {
    if (clock.trusted) trusted += (trusted.empty() ? "" : ", ") + clock.work;
  }
  return trusted.empty() ? "not trusted" : fmt::format("trusted for {} only", trusted);
}

std::string clocks_of(std::string_view device, const record::ClockCounts& now,
                      const record::ClockCounts& before) {
  std::string text = fmt::format("{}: times use {}", device, clock_names(now));
  if (now.size() > 1) text += ", so compare only times of the same clock";
  const bool changed = !before.empty() &&
                       !std::ranges::equal(now, before, {}, &record::ClockCounts::value_type::first,
                                           &record::ClockCounts::value_type::first);
  if (changed) text += fmt::format("; in the previous run, they used {}", clock_names(before));
  return text;
}

}  // namespace triptych::report::words
