#pragma once
// Seeded generators: the same voxels on every machine, compiler and standard library. They use only
// + − × ÷ and sqrt of IEEE doubles, which are exactly rounded, and tables or polynomials built from
// them; never the C library's sin, pow or exp, whose last bits differ between implementations.

#include <array>
#include <string_view>
#include <vector>

#include "scene/volume.hpp"

namespace triptych::scene {

struct GeneratorInfo {
  std::string_view name;
  std::string_view summary;
};

// uniform_box, gradient_box, frequency_box, mandelbulb, marschner_lobb, nested_shells,
// sparse_field, gaussian_blob.
[[nodiscard]] std::vector<GeneratorInfo> volume_generators();

// Throws InputError for an unknown name or a size outside 1…4096 per axis.
[[nodiscard]] Volume generate_volume(std::string_view name, std::array<int, 3> size);

}  // namespace triptych::scene
