#pragma once
// Checks the manifest of the baselines. The manifest contains checksums of all other files, but no
// file contains a checksum of the whole manifest. Therefore its content is compared with the
// content of the other files.

#include <filesystem>
#include <string>

#include "core/json.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::judge {

// Describes the first contradiction between the manifest and the other files in one line. Returns
// "" if there is none. Without this check, somebody could remove a device, a driver or a check from
// the manifest; the device or driver would then count as new, and the check as not requested.
// Throws InputError for a file that does not have the expected form.
[[nodiscard]] std::string contradiction_in(const std::filesystem::path& folder,
                                           const Manifest& manifest);

// Returns the hash of a manifest without its list of file hashes. Each entry of history.json
// contains this hash for the manifest that was written together with the entry.
[[nodiscard]] std::string manifest_hash(core::Json manifest);

}  // namespace triptych::judge
