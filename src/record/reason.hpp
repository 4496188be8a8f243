#pragma once
// The reason why a record was not measured, as data. report/words/ turns it into sentences.
// `detail` and `last_words` quote drivers and libraries, so no code compares them.

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
  skipped,  // the device or technique does not support this
  failed,   // an error of Triptych or of the API
  crashed,  // the worker died
  hung,     // the worker was stopped at its time limit
  lost      // the device was lost
};
[[nodiscard]] std::string_view name_of(Outcome outcome);
[[nodiscard]] Outcome outcome(std::string_view name);  // throws InputError

enum class Cause : std::uint8_t {
  none,              // it was measured
  same_frames,       // same frames as another configuration, from which they were copied
  not_supported,     // the device, driver or technique lacks the feature in `detail`
  bad_input,         // a broken file, or factor levels that contradict each other
  no_emulator,       // instructions cannot be counted on this machine
  not_on_processor,  // instructions can be counted only on a processor
  api_error,         // `subject` is the call, `code` the code that it returned
  device_lost,       // `subject` and `code` as for api_error
  not_drawn,         // the driver reported success, but drew nothing
  out_of_memory,     // host memory, for the data `subject`; "limit_bytes" if there is a limit
  error,             // any other exception
  signal,            // the worker was killed by the signal "signal"
  exit_code,         // the worker exited early with the code "exit_code"
  unknown_end,       // the worker could not be killed
  timeout,           // no answer within "limit_s"
  bad_answer,        // the worker's answer makes no sense
  no_greeting,       // the worker did not send its greeting
  cannot_start,      // the worker's program cannot be started
  under_way          // "times" abnormal exits happened while it was measured
};
[[nodiscard]] std::string_view name_of(Cause cause);
[[nodiscard]] Cause cause(std::string_view name);  // throws InputError

// The activity of the worker when it failed.
enum class Stage : std::uint8_t {
  working,   // on the configuration itself
  opening,   // opening the device
  counting,  // counting the configuration's instructions under an emulator
};
[[nodiscard]] std::string_view name_of(Stage stage);
[[nodiscard]] Stage stage(std::string_view name);  // throws InputError

struct Reason {
  Cause cause = Cause::none;
  Stage stage = Stage::working;
  std::map<std::string, double> numbers = {};  // each name contains the unit
  std::string subject = {};                    // an identifier: a call, a device, a data set
  std::string code = {};                       // the error code of an API call
  // The configuration was not attempted, because configurations with the same `shared_levels` ended
  // in this way. Without levels, all configurations did.
  bool not_tried = false;
  std::string shared_levels = {};  // "factor=value,…"
  std::string detail = {};         // the message of a driver, a library or an exception
  std::string last_words = {};     // the worker's last output
  bool operator==(const Reason&) const = default;

  [[nodiscard]] std::optional<double> number(const std::string& name) const;
  // The time limit that a timeout exceeded.
  [[nodiscard]] std::optional<std::chrono::seconds> limit() const;
};

// Whether two reasons are of the same kind, regardless of their texts and time limits.
[[nodiscard]] bool is_same_kind(const Reason& a, const Reason& b);
// A text that is equal for two reasons if and only if they are of the same kind.
[[nodiscard]] std::string kind_of(const Reason& reason);

// Thrown when a configuration or a device was not measured and the command therefore ends.
class NotMeasured : public core::Error {
 public:
  NotMeasured(Outcome outcome, Reason reason);
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] const Reason& reason() const noexcept { return reason_; }
  // cannot_judge if the device does not support the request (outcome skipped), otherwise usage.
  [[nodiscard]] core::ExitCode exit_code() const noexcept;

 private:
  Outcome outcome_;
  Reason reason_;
};

// The time that a configuration may take if the option --limit does not set another.
inline constexpr std::chrono::seconds standard_limit{60};

void to_json(nlohmann::json& json, const Reason& reason);
void from_json(const nlohmann::json& json, Reason& reason);

}  // namespace triptych::record
