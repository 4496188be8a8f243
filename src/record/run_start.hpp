#pragma once
// The planned devices and configurations of a run. They are stored before the first configuration
// is measured, so that a reader of the store can detect that a run was interrupted or that rows are
// missing.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/reason.hpp"

namespace triptych::record {

// A loader, platform, driver or device that turned out to be unusable during device enumeration.
struct Unusable {
  // The unusable part, such as "OpenCL platform Clover". If the process that enumerated the devices
  // of an API failed, this is the API, such as "vulkan". If that process enumerated only a part of
  // the API, the part follows in parentheses, as in "gl (EGL)".
  std::string what;
  std::string reason = {};  // the message of the loader or driver
  // How the process that enumerated the devices failed: it crashed, hung or returned invalid data.
  // The devices that it would have found are unknown. Empty if the process did not fail.
  std::optional<Reason> ended = {};
  bool operator==(const Unusable&) const = default;

  // If `ended` is set, returns the API whose devices could not be enumerated.
  [[nodiscard]] std::string api() const { return what.substr(0, what.find(' ')); }
};

// The part of a run that one command contributed: the devices that the user requested, and the
// devices that were found. A run that was resumed or merged has several parts.
struct RunStart {
  std::string host = {};
  std::string program = {};                 // version of Triptych; empty if unknown
  std::vector<std::string> requested = {};  // requested device ids, as globs; empty: all devices
  std::vector<std::string> found = {};      // ids of all devices that were found
  std::vector<std::string> devices = {};    // ids of the devices to be measured
  std::vector<Unusable> unusable = {};
  // For `run --error`: the requested error as typed by the user (empty otherwise), and the factors
  // whose levels the user fixed although --error would have chosen them.
  std::string requested_error = {};
  std::vector<std::string> fixed = {};
  bool operator==(const RunStart&) const = default;

  // requests_device() returns whether the command requested the device with this id. requests_api()
  // returns whether it requested any device of this API.
  [[nodiscard]] bool requests_device(std::string_view device) const;
  [[nodiscard]] bool requests_api(std::string_view api) const;
};

void to_json(nlohmann::json& json, const Unusable& unusable);
void from_json(const nlohmann::json& json, Unusable& unusable);
void to_json(nlohmann::json& json, const RunStart& start);
void from_json(const nlohmann::json& json, RunStart& start);

// Sorts the parts and removes duplicates. The result does not depend on the order of `parts`.
[[nodiscard]] std::vector<RunStart> joined(std::vector<RunStart> parts);

// devices_of() returns the ids of all devices that any part planned to measure. found_in() returns
// the ids of all devices that any part found.
[[nodiscard]] std::vector<std::string> devices_of(const std::vector<RunStart>& parts);
[[nodiscard]] std::vector<std::string> found_in(const std::vector<RunStart>& parts);

}  // namespace triptych::record
