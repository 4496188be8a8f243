#pragma once
// Reads baselines/absent.json, the list of devices that are absent from certain machines on
// purpose. Changes to this file are reviewed like changes to waivers.json, the list of known
// failures.

#include <filesystem>
#include <string>
#include <vector>

namespace triptych::judge {

struct AbsentDevice {
  std::string device = {};  // glob for device ids
  std::string host = "*";   // glob for host names
  std::string reason = {};
  std::string expiry = {};  // ISO date from which the entry is ignored; empty: it never expires
};

// Reads [{device, reason}, …]; an entry may also have a `host` and an `expiry`. Returns an empty
// list if the file does not exist. Throws InputError with file and line for an unknown key, a blank
// reason, or an entry that excuses every device on every machine.
[[nodiscard]] std::vector<AbsentDevice> read_absent_devices(const std::filesystem::path& file);

}  // namespace triptych::judge
