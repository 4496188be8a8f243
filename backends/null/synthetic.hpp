#pragma once
// The synthetic results of a scripted device: numbers and images that depend only on the work, so
// that they are identical every time.

#include <cstdint>
#include <string>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::null_backend {

// Returns a number from the leading digits of the hash of `text`.
[[nodiscard]] std::uint64_t number_of(const std::string& text);

// Returns the basis of times and counts: roughly the number of samples that a raycaster would take,
// or of fragments that sprites would cover.
[[nodiscard]] double samples_of(const measure::Work& work);
// Returns the injected slowdown as a fraction of the frame time; 0 for none.
[[nodiscard]] double extra_share(const measure::Work& work);

[[nodiscard]] record::Counts counters_of(const measure::Work& work);
[[nodiscard]] record::Counts statistics_of(const measure::Work& work);

// Returns an image with gradients in x and y, whose slopes and offsets depend on the scene. A fault
// injected into the technique changes the pattern as it would change a real image. Images of
// particles also have depths and ids.
[[nodiscard]] core::Image pattern(const measure::Work& work);

// Returns a key for the device code that would be compiled for this work.
[[nodiscard]] std::string code_key(const measure::Work& work);

}  // namespace triptych::null_backend
