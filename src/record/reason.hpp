#pragma once
// The reason why a record was not measured, as data; report/words/ turns it into sentences. Nothing
// compares `detail` or `last_words`, which quote drivers and libraries.

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
  none,           // it was measured
  same_frames,    // measured as another configuration, whose frames would be the same
  not_supported,  // the device, driver or technique does not support this; `detail` has the missing
                  // feature
  bad_input,      // a broken file, or factor levels that contradict each other
  no_emulator,    // instructions cannot be counted on this machine
  not_on_processor,  // instructions can be counted only on a processor
  api_error,         // `subject` is the call, `code` the code that it returned
  device_lost,       // `subject` and `code` as for api_error
  not_drawn,         // the driver reported success, but drew nothing
  out_of_memory,     // host memory, with the data `subject`; "limit_bytes" where there is a limit
  error,             // any other exception
  signal,            // the worker was killed: "signal"
  exit_code,         // the worker left early: "exit_code"
  unknown_end,       // the worker could not be killed
  timeout,           // no answer within "limit_s"
  bad_answer,        // the worker's answer makes no sense
  no_greeting,       // the worker did not greet
  cannot_start,      // the worker's program cannot be started
  under_way          // "times" abnormal exits, of Triptych or the machine, while it was measured
};
[[nodiscard]] std::string_view name_of(Cause cause);
[[nodiscard]] Cause cause(std::string_view name);  // throws InputError

// The activity of the worker at that moment.
enum class Stage : std::uint8_t {
  working,   // on the configuration
  opening,   // the device
  counting,  // the configuration's instructions, under an emulator
};
[[nodiscard]] std::string_view name_of(Stage stage);
[[nodiscard]] Stage stage(std::string_view name);  // throws InputError

struct Reason {
  Cause cause = Cause::none;
  Stage stage = Stage::working;
  std::map<std::string, double> numbers = {};  // the unit is part of the name
  std::string subject = {};                    // an identifier: a call, a device, a data set
  std::string code = {};                       // the error code of an API call
  // Not attempted, because configurations that share these levels ended in this way. If there are
  // no levels, all configurations did.
  bool not_tried = false;
  std::string shared_levels = {};  // "factor=value,…"
  std::string detail = {};         // the message of a driver, a library or an exception
  std::string last_words = {};     // the worker's last output
  bool operator==(const Reason&) const = default;

  [[nodiscard]] std::optional<double> number(const std::string& name) const;
  // The time limit that a timeout exceeded.
  [[nodiscard]] std::optional<std::chrono::seconds> limit() const;
};

// Whether two reasons are of the same kind, whatever their texts and time limits are.
[[nodiscard]] bool is_same_kind(const Reason& a, const Reason& b);
// This text is equal for two reasons if and only if they are of the same kind.
[[nodiscard]] std::string kind_of(const Reason& reason);

// Thrown if a configuration or a device that was not measured ends a command.
class NotMeasured : public core::Error {
 public:
  NotMeasured(Outcome outcome, Reason reason);
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] const Reason& reason() const noexcept { return reason_; }
  // If the device does not support the request (skipped), the command ends with cannot_judge,
  // otherwise with usage.
  [[nodiscard]] core::ExitCode exit_code() const noexcept;

 private:
  Outcome outcome_;
  Reason reason_;
};

// The time that a configuration may take, unless the option --limit says otherwise.
inline constexpr std::chrono::seconds standard_limit{60};

void to_json(nlohmann::json& json, const Reason& reason);
void from_json(const nlohmann::json& json, Reason& reason);

}  // namespace triptych::record
