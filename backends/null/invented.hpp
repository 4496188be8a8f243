#pragma once
// What a scripted device says that it did: numbers and pictures made from the work alone, the same
// every time.

#include <cstdint>
#include <string>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::null_backend {

// The leading digits of the text's hash.
[[nodiscard]] std::uint64_t number_of(const std::string& text);

// What times and counts are made of: about the samples that a raycaster would take, or the
// fragments that sprites would cover.
[[nodiscard]] double samples_of(const measure::Work& work);
// The injected slowdown, as a share of the frame; 0 for none.
[[nodiscard]] double extra_share(const measure::Work& work);

[[nodiscard]] record::Counts counters_of(const measure::Work& work);
[[nodiscard]] record::Counts statistics_of(const measure::Work& work);

// Slopes in x and y whose strength and ground depend on the scene; an injected fault of the
// technique shows in it as it would in a picture. Particles also have depth and ids.
[[nodiscard]] core::Image pattern(const measure::Work& work);

// What device code would be compiled for this work.
[[nodiscard]] std::string code_key(const measure::Work& work);

}  // namespace triptych::null_backend
