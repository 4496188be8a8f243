#pragma once
// Lists of known failures. baselines/waivers.json is written by hand and has expiry dates. A
// validation writes a file of its own, with one entry for each configuration.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// The expected result. A waiver without it excuses failures and flakes.
enum class Known : std::uint8_t {
  fail,   // a regression
  flake,  // a regression in some runs and a pass in others
  skip    // the device cannot draw the configuration
};
[[nodiscard]] std::string_view name_of(Known known);

// The texts are globs: over ids of devices, ids of tests, and keys of configurations.
struct Waiver {
  std::string device;
  std::string test;
  std::string reason;
  std::string expiry;  // ISO date from which on the entry is ignored; empty: never
  std::string configuration = "*";
  Known known = Known::fail;
};

// Reads [{device, test, reason, expiry}, …]; an entry may also have a `configuration`. Without such
// a file there are no waivers. Throws InputError with file and line, also for an entry that excuses
// everything, and for one that ends later than a year after `today` (an ISO date).
[[nodiscard]] std::vector<Waiver> read_waivers(const std::filesystem::path& file,
                                               const std::string& today);

// Reads [{device, test, configuration, outcome, reason}, …]; an entry may also have an `expiry`. A
// missing file is an InputError too.
[[nodiscard]] std::vector<Waiver> read_expected(const std::filesystem::path& file);

// The text of such a file: sorted, one entry a line.
[[nodiscard]] std::string expected_text(std::vector<Waiver> waivers);

}  // namespace triptych::judge
