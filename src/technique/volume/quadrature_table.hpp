#pragma once
// What a raycaster of the scene's quadrature looks up beside the transfer function, in rows of four
// floats.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::technique {

using QuadratureTable = std::vector<std::array<float, 4>>;

// Of cells: row i, 0 ≤ i ≤ 256, holds the least kink ≥ i, the greatest < i (scene/kinks.hpp), and
// the first entry ≥ i with any opacity; ±3·10³⁸ where there is none.
[[nodiscard]] QuadratureTable kink_table(const scene::TransferFunction& function);

// preintegrated_pairs, kink_table, or one row that nothing reads.
[[nodiscard]] QuadratureTable quadrature_table(const scene::VolumeScene& scene);
[[nodiscard]] std::uint64_t quadrature_table_bytes(scene::Quadrature quadrature);

}  // namespace triptych::technique
