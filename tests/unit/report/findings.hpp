#pragma once
// Helpers that create findings for tests of messages and reports.

#include <fmt/format.h>

#include <string>
#include <utility>

#include "judge/gate/gate.hpp"

namespace triptych::report {

[[nodiscard]] inline judge::Finding finding_of(judge::Check check, judge::Verdict verdict,
                                               const std::string& device,
                                               const std::string& configuration,
                                               judge::Observation what = {}) {
  judge::Finding finding;
  static_cast<judge::Observation&>(finding) = std::move(what);
  finding.check = check;
  finding.verdict = verdict;
  finding.test = fmt::format("volume.quick.{}.{}", judge::name_of(check), device);
  finding.device = device;
  finding.configuration = configuration;
  return finding;
}

// Returns the observation that `pixels` of 36,864 pixels exceed their error bound.
[[nodiscard]] inline judge::Observation over_bound(double pixels) {
  return {.cause = judge::Cause::pixels_over_bound,
          .against = judge::Against::reference,
          .numbers = {{"pixels_over", pixels},
                      {"pixels", 36864},
                      {"max_error", 0.25},
                      {"max_error_bound", 0.125},
                      {"max_error_x", 3},
                      {"max_error_y", 4},
                      {"rmse", 0.0625},
                      {"x", 7},
                      {"y", 9},
                      {"error", 0.01},
                      {"bound", 0.001}}};
}

[[nodiscard]] inline judge::Observation within_bound(double ratio = 0.5) {
  return {.cause = judge::Cause::within_bound,
          .against = judge::Against::reference,
          .numbers = {{"ratio", ratio}}};
}

[[nodiscard]] inline judge::Observation ended(record::Outcome outcome, record::Reason reason) {
  return {.cause = judge::Cause::ended, .outcome = outcome, .reason = std::move(reason)};
}

[[nodiscard]] inline judge::Observation crashed(int signal) {
  return ended(record::Outcome::crashed, {.cause = record::Cause::signal,
                                          .numbers = {{"signal", static_cast<double>(signal)}}});
}

[[nodiscard]] inline judge::Observation changed(const std::string& name) {
  return {.cause = judge::Cause::values_changed,
          .against = judge::Against::baseline,
          .changes = {{.name = name, .before = 3, .now = 4}}};
}

// Like finding_of(), with the arguments that differ between tests of groups and commands first.
[[nodiscard]] inline judge::Finding finding(judge::Verdict verdict, const std::string& device,
                                            const std::string& configuration,
                                            judge::Observation what = over_bound(3),
                                            judge::Check check = judge::Check::image) {
  return finding_of(check, verdict, device, configuration, std::move(what));
}

inline const judge::Observation costlier = changed("device_code");
inline const judge::Observation off_the_line{.cause = judge::Cause::residual_moved};

// Returns an observation whose message quotes `text`.
[[nodiscard]] inline judge::Observation quoting(const std::string& text) {
  return {.cause = judge::Cause::no_reference, .detail = text};
}

}  // namespace triptych::report
