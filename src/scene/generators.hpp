#pragma once
// Seeded generators whose voxels are bit-identical for every machine, compiler and standard
// library. They use only + − × ÷ and sqrt of IEEE doubles, which are correctly rounded, and tables
// or polynomials built from these operations (scene/exact_math.hpp). They never use the C library's
// sin, pow or exp, whose last bits differ between implementations.
//
// Fields are sampled at voxel centres: u = (i+½)/nx, v = (j+½)/ny and w = (k+½)/nz are the
// coordinates in the unit cube, and (x, y, z) = 2(u, v, w) − 1. The voxel spacing is 1. b(t) is (1
// − t²)² for |t| < 1 and 0 elsewhere. Integer formats store a field f as floor(f·hi + ½), where hi
// is the upper end of the range.
//
// clang-format off
//   uniform_box     f32  0..1       ½ everywhere
//   gradient_box    u16  0..hi      i + j + k; hi = nx + ny + nz − 3, reached in the last corner
//   frequency_box   f32  0..1       ½ + ½·s(u)·s(v)·s(w) with s(t) = sin(2π·12·t)
//   mandelbulb      u8   0..255     max(0, 1 − d/0.2)² at c = 1.2·(x, y, z). d estimates the distance from c
//                                   to the set of points for which z ← z⁸ + c stays bounded (with the
//                                   z⁸ of White and Nylander). d = ½·|z|·ln|z|/|dz/dc| after the last
//                                   iteration, and d = 0 inside the set
//   marschner_lobb  f32  0..1       (1 − sin(πz/2) + ¼(1 + cos(12π·cos(πρ/2))))/2.5, ρ = √(x² + y²)
//                                   (Marschner and Lobb 1994 with f = 6, α = ¼)
//   nested_shells   u16  0..65535   Σ a·b((√(x² + y² + z²) − r)/0.08), (r, a) = (0.3, 1), (0.6, 0.7),
//                                   (0.9, 0.4)
//   sparse_field    u8   0..255     the largest of 40 blobs b(distance/radius) in (u, v, w), seeded,
//                                   centres in [0.1, 0.9]³, radii 0.04…0.08: about 96 % are exactly 0
//   gaussian_blob   f32  0..1       exp(−q²/(2σ²)), q the distance in voxels from the volume's centre,
//                                   σ = min(nx, ny, nz)/8 voxels
// clang-format on

#include <array>
#include <string_view>
#include <vector>

#include "scene/volume.hpp"

namespace triptych::scene {

struct GeneratorInfo {
  std::string_view name;
  std::string_view summary;
};

// Returns the eight generators above, in that order.
[[nodiscard]] std::vector<GeneratorInfo> volume_generators();

// Throws InputError for an unknown name, or for a size outside 1…4096 along any axis. Does not
// generate the volume.
void check_volume_generator(std::string_view name, std::array<int, 3> size);

// Generates a volume, whose name is generate:NAME:SIZE. Throws the same exceptions as
// check_volume_generator().
[[nodiscard]] Volume generate_volume(std::string_view name, std::array<int, 3> size);

}  // namespace triptych::scene
