#pragma once
// Seals are hashes that are stored next to the data from which they were computed. They are needed
// because SQLite detects broken pages, but not a changed value in an intact page.

#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

[[nodiscard]] std::string seal_of(const Run& run);
[[nodiscard]] std::string seal_of(const Device& device, const std::vector<ClockTrust>& clocks);
// Returns the hash of everything in a record except the id of its run. Therefore the same record
// has the same seal in two stores.
[[nodiscard]] std::string seal_of(const Record& record);
[[nodiscard]] std::string seal_of(const TruthImage& truth);

// Throws an InputError if the two seals differ. Its message begins with `what`: if `what` is "image
// '5f0c'", the message is "image '5f0c' was changed after it was written".
void require_seal(std::string_view stored, std::string_view found, const std::string& what);

}  // namespace triptych::record
