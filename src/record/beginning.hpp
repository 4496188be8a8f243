#pragma once
// The planned devices and configurations of a run. They are stored before the first configuration
// is measured, so that a reader of the store can distinguish a complete run from one that was cut
// short or lost rows.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/reason.hpp"

namespace triptych::record {

// A loader, platform, driver or device that was found to be unusable while devices were listed.
struct Unusable {
  // The failing part, such as "OpenCL platform Clover". If the process that listed devices ended,
  // this is its API, such as "vulkan", with the part of the API in parentheses if there are
  // several: "gl (EGL)".
  std::string what;
  std::string reason = {};  // the message of the loader or driver
  // The way in which the process that listed devices ended: it crashed, hung or returned garbage.
  // The devices that it would have listed are not known.
  std::optional<Reason> ended = {};
  bool operator==(const Unusable&) const = default;

  // The API whose listing process ended.
  [[nodiscard]] std::string api() const { return what.substr(0, what.find(' ')); }
};

// The part of a run that one command contributed: the requested devices and the devices that were
// found. A run that was resumed or merged has several parts.
struct Beginning {
  std::string host = {};
  std::string program = {};               // the version of Triptych that measured; may be unknown
  std::vector<std::string> asked = {};    // globs over device ids; all devices if empty
  std::vector<std::string> found = {};    // ids of all devices that were listed
  std::vector<std::string> devices = {};  // ids of the devices to be measured
  std::vector<Unusable> unusable = {};
  bool operator==(const Beginning&) const = default;

  // Whether the command would have measured a device with this id, and whether it would have
  // measured any device of this API.
  [[nodiscard]] bool asks_for(std::string_view device) const;
  [[nodiscard]] bool asks_for_api(std::string_view api) const;
};

void to_json(nlohmann::json& json, const Unusable& unusable);
void from_json(const nlohmann::json& json, Unusable& unusable);
void to_json(nlohmann::json& json, const Beginning& beginning);
void from_json(const nlohmann::json& json, Beginning& beginning);

// Removes duplicates and sorts the parts in an order that does not depend on the order of the
// argument.
[[nodiscard]] std::vector<Beginning> joined(std::vector<Beginning> parts);

// devices_of: the ids of the devices that any of the parts planned to measure. found_in: the ids of
// the devices that any of the parts found.
[[nodiscard]] std::vector<std::string> devices_of(const std::vector<Beginning>& parts);
[[nodiscard]] std::vector<std::string> found_in(const std::vector<Beginning>& parts);

}  // namespace triptych::record
