#include "judge/baselines/absent.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/json_file.hpp"
#include "judge/baselines/waiver_values.hpp"

namespace triptych::judge {
namespace {

AbsentDevice read_absent_device(const core::JsonNode& entry) {
  refuse_unknown_keys(entry, {"device", "host", "reason", "expiry"});
  AbsentDevice absent{.device = entry.at("device").text(), .reason = reason_of(entry)};
  if (entry.has("host")) absent.host = entry.at("host").text();
  if (entry.has("expiry")) absent.expiry = expiry_of(entry);
  if (matches_every_device(absent.device) && matches_every_host(absent.host)) {
    entry.at("device").fail(
        "this entry excuses every device on every machine; name a device or a host");
  }
  return absent;
}

}  // namespace

std::vector<AbsentDevice> read_absent_devices(const std::filesystem::path& file) {
  std::vector<AbsentDevice> result;
  const auto json = core::JsonFile::read(file);
  if (!json) return result;
  for (const core::JsonNode& entry : json->root().elements()) {
    result.push_back(read_absent_device(entry));
  }
  return result;
}

}  // namespace triptych::judge
