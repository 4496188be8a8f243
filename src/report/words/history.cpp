#include "report/words/history.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/words/causes.hpp"

namespace triptych::report::words {

std::string text_of(const std::optional<comparison::TimeChange>& change) {
  if (!change) return {};
  const double centre = std::log(change->ratio);
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]{}", change->ratio,
                     std::exp(centre - change->half_width), std::exp(centre + change->half_width),
                     change->is_noise() ? " (noise)" : "");
}

std::string changed_clocks(const comparison::HistoryPoint& point) {
  std::string text;
  for (const auto& [clocks, configurations] : point.changed_clocks) {
    text += fmt::format(
        "{}{} clock instead of {} clock in {}", text.empty() ? "" : ", ", clocks.second,
        clocks.first,
        counted(static_cast<double>(configurations), "configuration", "configurations"));
  }
  if (text.empty()) return {};
  return "this run used the " + text +
         "; the times above are wall-clock times of both runs, so they are comparable";
}

std::string_view noise_note() {
  return "The brackets contain the 95 % interval of the change since the previous store. \"noise\" "
         "means that the interval contains 1. The interval cannot contain load that lasted for a "
         "whole run: on a shared machine, two runs of the same program may differ by a factor of "
         "two. To compare two builds, drivers or devices, use `triptych compare`, which measures "
         "them alternately.";
}

}  // namespace triptych::report::words
