#include "record/run_start.hpp"

#include <algorithm>
#include <set>

#include "core/glob.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::record {

using core::Json;

namespace {

std::vector<std::string> all_in(const std::vector<RunStart>& parts,
                                std::vector<std::string> RunStart::*ids) {
  std::set<std::string> all;
  for (const RunStart& each : parts) all.insert((each.*ids).begin(), (each.*ids).end());
  return {all.begin(), all.end()};
}

// Replaces invalid UTF-8, as the store does. Otherwise a seal (a hash of stored data) that is
// computed before storing would differ from the seal of the data that are read back.
std::vector<std::string> repaired(std::vector<std::string> texts) {
  for (std::string& each : texts) each = core::repaired_utf8(each);
  return texts;
}

}  // namespace

bool RunStart::requests_device(std::string_view device) const {
  return requested.empty() || core::any_glob_matches(requested, std::string(device));
}

bool RunStart::requests_api(std::string_view api) const {
  return requested.empty() || std::ranges::any_of(requested, [&](const std::string& glob) {
           return core::glob_matches(glob.substr(0, glob.find(':')), api);
         });
}

void to_json(Json& json, const Unusable& unusable) {
  json = {{"what", core::repaired_utf8(unusable.what)},
          {"reason", core::repaired_utf8(unusable.reason)}};
  if (unusable.ended) json["ended"] = *unusable.ended;
}

void from_json(const Json& json, Unusable& unusable) {
  unusable = {json.at("what"), json.at("reason"), {}};
  if (json.contains("ended")) unusable.ended = json.at("ended").get<Reason>();
}

void to_json(Json& json, const RunStart& start) {
  json = {{"host", core::repaired_utf8(start.host)},
          {"asked", repaired(start.requested)},
          {"found", repaired(start.found)},
          {"devices", repaired(start.devices)},
          {"unusable", start.unusable}};
  if (!start.program.empty()) json["program"] = core::repaired_utf8(start.program);
  if (start.requested_error.empty()) return;
  json["error"] = core::repaired_utf8(start.requested_error);
  json["fixed"] = repaired(start.fixed);
}

void from_json(const Json& json, RunStart& start) {
  start = {.host = json.at("host"),
           .program = json.value("program", ""),
           .requested = json.at("asked"),
           .found = json.at("found"),
           .devices = json.at("devices"),
           .unusable = json.at("unusable"),
           .requested_error = json.value("error", ""),
           .fixed = json.value("fixed", std::vector<std::string>())};
}

std::vector<RunStart> joined(std::vector<RunStart> parts) {
  std::ranges::sort(parts, {}, [](const RunStart& each) { return core::json_text(Json(each)); });
  const auto repeated = std::ranges::unique(parts);
  parts.erase(repeated.begin(), repeated.end());
  return parts;
}

std::vector<std::string> devices_of(const std::vector<RunStart>& parts) {
  return all_in(parts, &RunStart::devices);
}

std::vector<std::string> found_in(const std::vector<RunStart>& parts) {
  return all_in(parts, &RunStart::found);
}

}  // namespace triptych::record
