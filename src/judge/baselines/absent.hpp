#pragma once
// Which devices a machine is meant to lack, as baselines/absent.json says: reviewed, as waivers are.

#include <filesystem>
#include <string>
#include <vector>

namespace triptych::judge {

struct Absent {
  std::string device = {};  // glob over device ids
  std::string host = "*";  // glob over machines' names
  std::string reason = {};
  std::string expiry = {};  // ISO date; from that day on it excuses nothing. Empty: never
};

// [{device, reason}, …], each with a `host` and an `expiry` where it has one; none where there is
// no such file. Throws InputError with file and line for other keys, a blank reason, or an entry
// that excuses every device on every machine.
[[nodiscard]] std::vector<Absent> read_absent(const std::filesystem::path& file);

}  // namespace triptych::judge
