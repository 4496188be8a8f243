#pragma once
// The look-up table that a raycaster uses in addition to the transfer function. It depends on the
// scene's quadrature and has rows of four floats.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::technique {

using QuadratureTable = std::vector<std::array<float, 4>>;

// Returns the table for quadrature=cells. Row i, 0 ≤ i ≤ 256, contains the smallest kink ≥ i, the
// largest kink < i (scene/kinks.hpp), and the first entry ≥ i that has any opacity. A number that
// does not exist is represented by ±3·10³⁸.
[[nodiscard]] QuadratureTable kink_table(const scene::TransferFunction& function);

// Returns preintegrated_pairs, kink_table, or one row that is never read, depending on the scene's
// quadrature.
[[nodiscard]] QuadratureTable quadrature_table(const scene::VolumeScene& scene);
[[nodiscard]] std::uint64_t quadrature_table_bytes(scene::Quadrature quadrature);

}  // namespace triptych::technique
