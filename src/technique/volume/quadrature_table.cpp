#include "technique/volume/quadrature_table.hpp"

#include <cstddef>

#include "scene/kinks.hpp"
#include "technique/volume/preintegration.hpp"

namespace triptych::technique {
namespace {

constexpr std::size_t table_entries = 256;
constexpr float none = 3.0e38F;

}  // namespace

QuadratureTable kink_table(const scene::TransferFunction& function) {
  const auto kinks = scene::kinks(function);
  QuadratureTable table(table_entries + 1, {none, -none, none, 0});
  for (std::size_t i = table_entries; i-- > 0;) {
    table[i] = table[i + 1];
    if (kinks[i]) table[i][0] = static_cast<float>(i);
    if (function.entries[i][3] > 0) table[i][2] = static_cast<float>(i);
  }
  for (std::size_t i = 0; i < table_entries; ++i) {
    table[i + 1][1] = kinks[i] ? static_cast<float>(i) : table[i][1];
  }
  return table;
}

QuadratureTable quadrature_table(const scene::VolumeScene& scene) {
  switch (scene.quadrature) {
    case scene::Quadrature::preintegrated:
      return preintegrated_pairs(scene.transfer_function);
    case scene::Quadrature::cells:
      return kink_table(scene.transfer_function);
    case scene::Quadrature::midpoint:
      break;
  }
  return QuadratureTable(1);
}

std::uint64_t quadrature_table_bytes(scene::Quadrature quadrature) {
  constexpr std::uint64_t row = 4 * sizeof(float);
  switch (quadrature) {
    case scene::Quadrature::preintegrated:
      return row * texels_per_pair * table_entries * table_entries;
    case scene::Quadrature::cells:
      return row * (table_entries + 1);
    case scene::Quadrature::midpoint:
      break;
  }
  return row;
}

}  // namespace triptych::technique
