#include "record/beginning.hpp"

#include <algorithm>
#include <set>

#include "core/glob.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"

namespace triptych::record {

using core::Json;

namespace {

std::vector<std::string> all_in(const std::vector<Beginning>& parts,
                                std::vector<std::string> Beginning::*ids) {
  std::set<std::string> all;
  for (const Beginning& each : parts) all.insert((each.*ids).begin(), (each.*ids).end());
  return {all.begin(), all.end()};
}

// Replaces invalid UTF-8, as the store does. Otherwise a seal (a hash of stored data) that is
// computed before storing would differ from the seal of the data that are read back.
std::vector<std::string> mended(std::vector<std::string> texts) {
  for (std::string& each : texts) each = core::mended_utf8(each);
  return texts;
}

}  // namespace

bool Beginning::asks_for(std::string_view device) const {
  return asked.empty() || core::any_glob_matches(asked, std::string(device));
}

bool Beginning::asks_for_api(std::string_view api) const {
  return asked.empty() || std::ranges::any_of(asked, [&](const std::string& glob) {
           return core::glob_matches(glob.substr(0, glob.find(':')), api);
         });
}

void to_json(Json& json, const Unusable& unusable) {
  json = {{"what", core::mended_utf8(unusable.what)},
          {"reason", core::mended_utf8(unusable.reason)}};
  if (unusable.ended) json["ended"] = *unusable.ended;
}

void from_json(const Json& json, Unusable& unusable) {
  unusable = {json.at("what"), json.at("reason"), {}};
  if (json.contains("ended")) unusable.ended = json.at("ended").get<Reason>();
}

void to_json(Json& json, const Beginning& beginning) {
  json = {{"host", core::mended_utf8(beginning.host)},
          {"asked", mended(beginning.asked)},
          {"found", mended(beginning.found)},
          {"devices", mended(beginning.devices)},
          {"unusable", beginning.unusable}};
  if (!beginning.program.empty()) json["program"] = core::mended_utf8(beginning.program);
}

void from_json(const Json& json, Beginning& beginning) {
  beginning = {.host = json.at("host"),
               .program = json.value("program", ""),
               .asked = json.at("asked"),
               .found = json.at("found"),
               .devices = json.at("devices"),
               .unusable = json.at("unusable")};
}

std::vector<Beginning> joined(std::vector<Beginning> parts) {
  std::ranges::sort(parts, {}, [](const Beginning& each) { return core::json_text(Json(each)); });
  const auto repeated = std::ranges::unique(parts);
  parts.erase(repeated.begin(), repeated.end());
  return parts;
}

std::vector<std::string> devices_of(const std::vector<Beginning>& parts) {
  return all_in(parts, &Beginning::devices);
}

std::vector<std::string> found_in(const std::vector<Beginning>& parts) {
  return all_in(parts, &Beginning::found);
}

}  // namespace triptych::record
