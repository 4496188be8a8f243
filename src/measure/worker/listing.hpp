#pragma once
// Lists the devices of this machine. The devices of each API are enumerated in a separate process
// (own_program.hpp), so that a driver that crashes or hangs does not affect other APIs.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

// Returns those of `apis` that may have a device that matches a glob. Returns all of them if there
// are no globs, or if no API fits, so that the resulting error message can list all devices.
[[nodiscard]] std::vector<std::string> apis_of(const std::vector<std::string>& globs,
                                               const std::vector<std::string>& apis);

[[nodiscard]] Listing list_devices(const std::vector<std::string>& apis);

// Returns the ids of the usual compile-only devices whose driver is installed. Loads no driver, so
// only list_compilers() can determine whether the driver supports the GPU family.
[[nodiscard]] std::vector<std::string> installed_compilers();

// Lists compile-only devices (measure/system/compile_only.hpp): the usual devices that match any of
// the globs (all usual devices if there are no globs), and every device that a glob names in full.
// If a device cannot be used, for example because a package is missing, `broken` has an entry with
// the device's id.
[[nodiscard]] Listing list_compilers(const std::vector<std::string>& globs);

// Returns whether a glob is the full id of a compile-only device.
[[nodiscard]] bool name_a_compiler(const std::vector<std::string>& globs);

// Returns the ids of the devices that match any of the globs (all devices if there are no globs),
// in the order of the listing. If a glob matches no device, throws a core::NotSupported that lists
// the available devices.
[[nodiscard]] std::vector<std::string> choose_devices(const Listing& listing,
                                                      const std::vector<std::string>& globs);

// Returns the only device that the glob matches. `option` is the name of the command-line option in
// error messages. Throws core::NotSupported if no device matches, and core::InputError if several
// devices match.
[[nodiscard]] std::string choose_device(const Listing& listing, std::string_view option,
                                        const std::string& glob);

// A worker's report about a device that it opened. The clocks are calibrated with work from the
// suite.
struct Greeting {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
  std::optional<record::Reason> refused;  // the reason if the device cannot be used
};
[[nodiscard]] Greeting greet(const record::Device& device, const std::string& suite);

// The main function of the process that enumerates the devices of one API: waits for a request and
// then sends the listing.
void answer_listing(const Backend& backend);

}  // namespace triptych::measure
