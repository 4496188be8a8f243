#pragma once
// The manifest contains checksums of all other files of the baselines, but nothing contains a
// checksum of the manifest. Therefore its statements are compared with the contents of the files.

#include <filesystem>
#include <string>

#include "core/json.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::judge {

// The first statement of the manifest that its files contradict, in one line; empty if there is
// none. A device, driver or check that the manifest leaves out would otherwise count as new or as
// not requested. Throws InputError for a file that is not of the expected form.
[[nodiscard]] std::string contradiction_in(const std::filesystem::path& folder,
                                           const Manifest& manifest);

// The hash of everything that a manifest states apart from the hashes of its files. Each entry of
// history.json contains the hash of the manifest that it made.
[[nodiscard]] std::string hash_of_statements(core::Json manifest);

}  // namespace triptych::judge
