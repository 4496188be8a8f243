#pragma once
// Lists the devices of this machine. The devices of each API are enumerated in a separate process
// (own_program.hpp), so that a driver that crashes or hangs does not affect other APIs.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/backend.hpp"

namespace triptych::measure {

// Returns those of `apis` that may have a device that matches one of the globs. Returns all APIs if
// there are no globs. Also returns all APIs if none of them can match, so that the resulting error
// message can list all devices.
[[nodiscard]] std::vector<std::string> apis_of(const std::vector<std::string>& globs,
                                               const std::vector<std::string>& apis);

// Adds the devices and the errors of `more` to `all`.
void append(Listing& all, Listing more);

[[nodiscard]] Listing list_devices(const std::vector<std::string>& apis);

// Returns the ids of the usual compile-only devices whose driver is installed. This function does
// not load any driver. Whether a driver supports the GPU family is determined only by
// list_compilers().
[[nodiscard]] std::vector<std::string> installed_compilers();

// Lists compile-only devices (measure/system/compile_only.hpp): the usual devices that match any of
// the globs, or all usual devices if there are no globs. If a glob is the full id of a compile-only
// device, this device is also listed. If a device cannot be used, for example because a package is
// missing, `broken` has an entry with the device's id.
[[nodiscard]] Listing list_compilers(const std::vector<std::string>& globs);

// Returns whether any of the globs is the full id of a compile-only device.
[[nodiscard]] bool names_compile_only_device(const std::vector<std::string>& globs);

// Returns the globs that match no device in the listing, without the ids of compile-only devices.
[[nodiscard]] std::vector<std::string> unmatched(const Listing& listing,
                                                 const std::vector<std::string>& globs);

// Returns the ids of all devices and of `more`, followed by the drivers that cannot be used, for
// messages.
[[nodiscard]] std::string available_devices(const Listing& listing,
                                            const std::vector<std::string>& more = {});

// Returns the ids of the devices that match any of the globs (all devices if there are no globs),
// in the order of the listing. If a glob matches no device, throws a core::NotSupported that lists
// the available devices.
[[nodiscard]] std::vector<std::string> choose_devices(const Listing& listing,
                                                      const std::vector<std::string>& globs);

// Returns the only device that matches the glob. `option` is the name of the command-line option in
// error messages. Throws core::NotSupported if no device matches, and core::InputError if several
// devices match.
[[nodiscard]] std::string choose_device(const Listing& listing, std::string_view option,
                                        const std::string& glob);

// A worker's report about a device. The clocks are calibrated with work from the suite.
struct Greeting {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
  std::optional<record::Reason> refused;  // the reason if the device cannot be used
};
[[nodiscard]] Greeting greet(const record::Device& device, const std::string& suite);

// The main function of a process that enumerates the devices of one API. Waits for a request, and
// then sends the listing.
void answer_listing(const Backend& backend);

}  // namespace triptych::measure
