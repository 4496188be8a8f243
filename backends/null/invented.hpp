#pragma once
// The invented results of a scripted device: numbers and images that depend only on the work and
// are the same every time.

#include <cstdint>
#include <string>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::null_backend {

// A number from the leading digits of the text's hash.
[[nodiscard]] std::uint64_t number_of(const std::string& text);

// The basis of times and counts: about as many samples as a raycaster would take, or as many
// fragments as sprites would cover.
[[nodiscard]] double samples_of(const measure::Work& work);
// The injected slowdown, as a share of the frame; 0 for none.
[[nodiscard]] double extra_share(const measure::Work& work);

[[nodiscard]] record::Counts counters_of(const measure::Work& work);
[[nodiscard]] record::Counts statistics_of(const measure::Work& work);

// Slopes in x and y whose strength and offset depend on the scene. An injected fault of the
// technique changes it as it would change a real image. Particles also have depth and ids.
[[nodiscard]] core::Image pattern(const measure::Work& work);

// A key for the device code that would be compiled for this work.
[[nodiscard]] std::string code_key(const measure::Work& work);

}  // namespace triptych::null_backend
