#pragma once
// Lists the devices of this machine. Every API is listed in a separate process (own_program.hpp),
// so that a driver that crashes or hangs while it is listed affects nothing else.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

// The APIs in which a glob may match a device. All APIs if there are no globs, or if no API fits,
// so that the resulting error message can list all devices.
[[nodiscard]] std::vector<std::string> apis_of(const std::vector<std::string>& globs,
                                               const std::vector<std::string>& apis);

[[nodiscard]] Listing list_devices(const std::vector<std::string>& apis);

// The ids of the usual devices that only compile and whose driver is installed. No driver is
// started: list_compilers() determines whether the driver supports the family.
[[nodiscard]] std::vector<std::string> installed_compilers();

// Lists the devices that only compile (measure/system/compile_only.hpp): the usual ones that match
// any of the globs (all if there are no globs), and every family that a glob names in full. If
// something is missing for one, `broken` has an entry with its id.
[[nodiscard]] Listing list_compilers(const std::vector<std::string>& globs);

// Returns whether a glob is the full name of a device that only compiles.
[[nodiscard]] bool name_a_compiler(const std::vector<std::string>& globs);

// The ids of the devices that match any of the globs (all if there are no globs), in the order of
// the listing. Throws core::NotSupported with the devices that there are if a glob matches none.
[[nodiscard]] std::vector<std::string> choose_devices(const Listing& listing,
                                                      const std::vector<std::string>& globs);

// The only device that the glob matches. `option` is the name of the command-line option in error
// messages. Throws core::NotSupported as above, and core::InputError if several devices match.
[[nodiscard]] std::string choose_device(const Listing& listing, std::string_view option,
                                        const std::string& glob);

// The report of a device that was opened. Its clocks are calibrated with the work of the suite.
struct Greeting {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
  std::optional<record::Reason> refused;  // the reason why it cannot be used
};
[[nodiscard]] Greeting greet(const record::Device& device, const std::string& suite);

// The main function of the process for one API: it waits for a request and then sends its listing.
void answer_listing(const Backend& backend);

}  // namespace triptych::measure
