#pragma once
// Hashes that are stored beside what they are of. SQLite finds broken pages, not a changed value in
// a whole one.

#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

[[nodiscard]] std::string seal_of(const Run& run);
[[nodiscard]] std::string seal_of(const Device& device, const std::vector<ClockTrust>& clocks);
// Of what was measured, whichever run holds it: the same record in two stores has one seal.
[[nodiscard]] std::string seal_of(const Record& record);
[[nodiscard]] std::string seal_of(const TruthImage& truth);

// Throws InputError, "WHAT is not as it was written", where the two differ.
void require_seal(std::string_view stored, std::string_view found, const std::string& what);

}  // namespace triptych::record
