#pragma once
// Lists of known failures. baselines/waivers.json is written by hand, and its entries have expiry
// dates. A file of expectations is written by `validate`, with one configuration per entry.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// The result that an entry in a file of expectations expects. Entries of waivers.json do not state
// an expected result, because they always excuse failures and flakes.
enum class ExpectedOutcome : std::uint8_t {
  fail,   // a regression
  flake,  // a regression in some runs and a pass in others
  skip    // the device cannot draw the configuration
};
[[nodiscard]] std::string_view name_of(ExpectedOutcome outcome);

struct Waiver {
  std::string device;  // glob for device ids
  std::string test;    // glob for test ids
  std::string reason;
  std::string expiry;               // ISO date from which the entry is ignored; empty: never
  std::string configuration = "*";  // glob for configuration keys
  ExpectedOutcome outcome = ExpectedOutcome::fail;
};

// Reads [{device, test, reason, expiry}, …]; an entry may also have a `configuration`. Returns an
// empty list if the file does not exist. Throws InputError with file and line for a malformed
// entry, an entry that excuses everything, and an entry that expires more than a year after `today`
// (an ISO date).
[[nodiscard]] std::vector<Waiver> read_waivers(const std::filesystem::path& file,
                                               const std::string& today);

// Reads a file of expectations: [{device, test, configuration, outcome, reason}, …]; an entry may
// also have an `expiry`. Throws InputError if the file does not exist, and InputError with file and
// line for a malformed entry.
[[nodiscard]] std::vector<Waiver> read_expected_outcomes(const std::filesystem::path& file);

// Returns the content of a file of expectations, sorted, with one entry per line.
[[nodiscard]] std::string expected_outcomes_text(std::vector<Waiver> waivers);

}  // namespace triptych::judge
