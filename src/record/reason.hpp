#pragma once
// The reason why a configuration was not measured, as data. report/words/ converts it to sentences.
// `detail` and `last_output` contain messages from drivers and libraries, so code must not compare
// them.

#include <chrono>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace triptych::record {

enum class Outcome : std::uint8_t {
  measured,
  skipped,  // the device or technique does not support the configuration
  failed,   // Triptych or the API reported an error
  crashed,  // the worker process crashed or exited early
  hung,     // the worker was killed because it exceeded its time limit
  lost      // the device was lost
};
[[nodiscard]] std::string_view name_of(Outcome outcome);
[[nodiscard]] Outcome outcome(std::string_view name);  // throws InputError

// In the comments on the enumerators, words in quotes are keys of Reason::numbers, and words in
// backticks are other members of Reason.
enum class Cause : std::uint8_t {
  none,              // the configuration was measured
  same_frames,       // the frames were copied from a configuration that does the same work
  not_supported,     // the device, driver or technique lacks the feature in `detail`
  bad_input,         // a broken file, or factor levels that contradict each other
  no_emulator,       // instructions cannot be counted on this machine
  not_on_processor,  // instructions can be counted only on a CPU device
  api_error,         // `subject` is the call, `code` the code that it returned
  device_lost,       // `subject` and `code` have the same meaning as for api_error
  not_drawn,         // the driver reported success, but drew nothing
  out_of_memory,     // not enough host memory for the data set `subject`; the memory limit, if
                     // there is one, is "limit_bytes"
  error,             // any other exception
  signal,            // the worker was killed by the signal "signal"
  exit_code,         // the worker exited early with the code "exit_code"
  unknown_end,       // the worker did not exit even after it was killed
  timeout,           // the worker did not answer within "limit_s"
  bad_answer,        // the worker's answer was invalid
  no_greeting,       // the worker's first message was not its greeting
  cannot_start,      // the worker's program cannot be started
  under_way          // "times" earlier attempts to measure this configuration never finished
};
[[nodiscard]] std::string_view name_of(Cause cause);
[[nodiscard]] Cause cause(std::string_view name);  // throws InputError

// The worker's activity when it failed.
enum class Stage : std::uint8_t {
  working,   // working on the configuration itself
  opening,   // opening the device
  counting,  // counting the configuration's instructions in an emulator
};
[[nodiscard]] std::string_view name_of(Stage stage);
[[nodiscard]] Stage stage(std::string_view name);  // throws InputError

struct Reason {
  Cause cause = Cause::none;
  Stage stage = Stage::working;
  std::map<std::string, double> numbers = {};  // by the names that the comments on Cause state
  std::string subject = {};                    // the name of an API call, a device, a data set, …
  std::string code = {};                       // the error code of an API call
  // Whether the configuration was not attempted, because other configurations with the levels
  // `shared_levels` failed for this reason. If `shared_levels` is empty, the failure did not depend
  // on any factor of the plan.
  bool not_tried = false;
  std::string shared_levels = {};  // "factor=value,…"
  std::string detail = {};         // the message of a driver, a library or an exception
  std::string last_output = {};    // the worker's last output
  bool operator==(const Reason&) const = default;

  [[nodiscard]] std::optional<double> number(const std::string& name) const;
  // Returns the time limit that was exceeded, or nullopt if the cause is not a timeout.
  [[nodiscard]] std::optional<std::chrono::seconds> limit() const;
};

// Returns whether a configuration was skipped because its data file, `reason.subject`, is missing
// on this machine.
[[nodiscard]] bool lacks_data(Outcome outcome, const Reason& reason);

// Returns whether two reasons are of the same kind, regardless of their messages and time limits.
[[nodiscard]] bool is_same_kind(const Reason& a, const Reason& b);
// Returns a string that is equal for two reasons if and only if they are of the same kind.
[[nodiscard]] std::string kind_of(const Reason& reason);

// Thrown if a configuration or a device was not measured and the command cannot continue.
class NotMeasured : public core::Error {
 public:
  NotMeasured(Outcome outcome, Reason reason);
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] const Reason& reason() const noexcept { return reason_; }
  // Returns ExitCode::usage if the input is broken or an error occurred. Returns
  // ExitCode::cannot_judge if the configuration was skipped for any other reason, such as a missing
  // feature or data file.
  [[nodiscard]] core::ExitCode exit_code() const noexcept;

 private:
  Outcome outcome_;
  Reason reason_;
};

// The time limit for a configuration, unless the option --limit sets another limit.
inline constexpr std::chrono::seconds default_limit{60};

void to_json(nlohmann::json& json, const Reason& reason);
void from_json(const nlohmann::json& json, Reason& reason);

}  // namespace triptych::record
