#pragma once
// The look-up table that a raycaster uses in addition to the transfer function. It depends on the
// scene's quadrature and has rows of four floats.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::technique {

using QuadratureTable = std::vector<std::array<float, 4>>;

// Returns the table for quadrature=cells. A kink is an entry of the transfer function at which its
// slope changes (scene/kinks.hpp). Row i, 0 ≤ i ≤ 256, contains the indices of the smallest
// kink ≥ i, of the largest kink < i, and of the first entry ≥ i that has any opacity. An index that
// does not exist is represented by ±3·10³⁸.
[[nodiscard]] QuadratureTable kink_table(const scene::TransferFunction& function);

// Returns preintegrated_pairs, kink_table, or one row that is never read, depending on the scene's
// quadrature.
[[nodiscard]] QuadratureTable quadrature_table(const scene::VolumeScene& scene);
[[nodiscard]] std::uint64_t quadrature_table_bytes(scene::Quadrature quadrature);

}  // namespace triptych::technique
