#pragma once
// The devices that a machine lacks on purpose, from baselines/absent.json, which is reviewed like
// waivers.

#include <filesystem>
#include <string>
#include <vector>

namespace triptych::judge {

struct Absent {
  std::string device = {};  // glob over device ids
  std::string host = "*";   // glob over names of machines
  std::string reason = {};
  std::string expiry = {};  // ISO date from which on the entry is ignored; empty: never
};

// Reads [{device, reason}, …]; an entry may also have a `host` and an `expiry`. Without such a file
// there are none. Throws InputError with file and line for other keys, a blank reason, or an entry
// that excuses every device on every machine.
[[nodiscard]] std::vector<Absent> read_absent(const std::filesystem::path& file);

}  // namespace triptych::judge
