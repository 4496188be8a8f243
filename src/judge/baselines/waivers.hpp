#pragma once
// What is known to fail, as files say: baselines/waivers.json by hand, with an expiry, and what a
// validation writes of itself, by configuration.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// What becomes of it. A waiver that says none excuses failures and flakes.
enum class Known : std::uint8_t {
  fail,   // a regression
  flake,  // a regression in some runs, a pass in others
  skip    // the device cannot draw it
};
[[nodiscard]] std::string_view name_of(Known known);

// Globs over ids of devices and tests and over keys of configurations.
struct Waiver {
  std::string device;
  std::string test;
  std::string reason;
  std::string expiry;  // ISO date; from that day on it excuses nothing. Empty: never
  std::string configuration = "*";
  Known known = Known::fail;
};

// [{device, test, reason, expiry}, …], each with a `configuration` where it has one; none where
// there is no such file. Throws InputError with file and line.
[[nodiscard]] std::vector<Waiver> read_waivers(const std::filesystem::path& file);

// [{device, test, configuration, outcome, reason}, …], each with an `expiry` where it has one; an
// InputError too where there is no such file.
[[nodiscard]] std::vector<Waiver> read_expected(const std::filesystem::path& file);

// Such a file: sorted, one entry a line.
[[nodiscard]] std::string expected_text(std::vector<Waiver> waivers);

}  // namespace triptych::judge
