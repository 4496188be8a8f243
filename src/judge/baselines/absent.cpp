#include "judge/baselines/absent.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/json_file.hpp"
#include "judge/baselines/waiver_values.hpp"

namespace triptych::judge {
namespace {

Absent read_absent(const core::JsonNode& entry) {
  refuse_other_keys(entry, {"device", "host", "reason", "expiry"});
  Absent absent{.device = entry.at("device").text(), .reason = reason_of(entry)};
  if (entry.has("host")) absent.host = entry.at("host").text();
  if (entry.has("expiry")) absent.expiry = expiry_of(entry);
  if (matches_every_device(absent.device) && matches_every_host(absent.host)) {
    entry.at("device").fail(
        "this entry excuses every device on every machine; name a device or a host");
  }
  return absent;
}

}  // namespace

std::vector<Absent> read_absent(const std::filesystem::path& file) {
  std::vector<Absent> result;
  const auto json = core::JsonFile::read(file);
  if (!json) return result;
  for (const core::JsonNode& entry : json->root().elements()) result.push_back(read_absent(entry));
  return result;
}

}  // namespace triptych::judge
