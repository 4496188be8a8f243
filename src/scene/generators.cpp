#include "scene/generators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/exact_math.hpp"
#include "scene/mandelbulb.hpp"

namespace triptych::scene {
namespace {

constexpr int largest_side = 4096;

template <typename T>
constexpr ScalarType scalar_type_of() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return ScalarType::u8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ScalarType::u16;
  return ScalarType::f32;
}

// Quantizes a value in [0, 1] to the full range of an unsigned integer type. Floats are not
// quantized.
template <typename T>
T quantise(double x) {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(std::floor(x * std::numeric_limits<T>::max() + 0.5));
  } else {
    return static_cast<T>(x);
  }
}

// Fills a volume with the results of voxel(i, j, k).
template <typename T, typename VoxelAt>
Volume fill(std::array<int, 3> size, double range_hi, VoxelAt&& voxel) {
  Volume volume;
  volume.size = size;
  volume.type = scalar_type_of<T>();
  volume.range_lo = 0;
  volume.range_hi = range_hi;
  volume.voxels.resize(volume.voxel_count() * sizeof(T));
  std::byte* out = volume.voxels.data();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i, out += sizeof(T)) {
        const T value = voxel(i, j, k);
        std::memcpy(out, &value, sizeof(T));
      }
    }
  }
  return volume;
}

// Fills a volume by sampling a field over the unit cube. The values of the field are in [0, 1].
template <typename T, typename Field>
Volume sample(std::array<int, 3> size, Field&& field) {
  const double top = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1;
  return fill<T>(size, top, [&](int i, int j, int k) {
    return quantise<T>(
        field(glm::dvec3((i + 0.5) / size[0], (j + 0.5) / size[1], (k + 0.5) / size[2])));
  });
}

// Returns a smooth bump: 1 at t = 0, and exactly 0 at |t| = 1 and beyond.
double bump(double t) {
  const double s = 1 - t * t;
  return s > 0 ? s * s : 0;
}

Volume uniform_box(std::array<int, 3> size) {
  return sample<float>(size, [](glm::dvec3) { return 0.5; });
}

Volume gradient_box(std::array<int, 3> size) {
  return fill<std::uint16_t>(size, size[0] + size[1] + size[2] - 3, [](int i, int j, int k) {
    return static_cast<std::uint16_t>(i + j + k);
  });
}

Volume frequency_box(std::array<int, 3> size) {
  constexpr double periods = 12;
  std::array<std::vector<double>, 3> wave;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < size.at(axis); ++i) {
      wave.at(axis).push_back(sine_turns(periods * (i + 0.5) / size.at(axis)));
    }
  }
  const auto at = [&wave](std::size_t axis, int i) {
    return wave[axis][static_cast<std::size_t>(i)];
  };
  return fill<float>(size, 1, [&](int i, int j, int k) {
    return static_cast<float>(0.5 + 0.5 * at(0, i) * at(1, j) * at(2, k));
  });
}

Volume mandelbulb(std::array<int, 3> size) {
  constexpr double half_side = 1.2;
  constexpr double reach = 0.2;
  return sample<std::uint8_t>(size, [](glm::dvec3 place) {
    const double distance = mandelbulb_distance(half_side * (2.0 * place - 1.0));
    const double nearness = std::max(0.0, 1 - distance / reach);
    return nearness * nearness;
  });
}

Volume marschner_lobb(std::array<int, 3> size) {
  constexpr double frequency = 6;
  constexpr double alpha = 0.25;
  return sample<float>(size, [](glm::dvec3 place) {
    const glm::dvec3 p = 2.0 * place - 1.0;
    const double rho = std::sqrt(p.x * p.x + p.y * p.y);
    const double ripple = cosine_turns(frequency * cosine_turns(rho / 4));
    return (1 - sine_turns(p.z / 4) + alpha * (1 + ripple)) / (2 * (1 + alpha));
  });
}

Volume nested_shells(std::array<int, 3> size) {
  struct Shell {
    double radius;
    double value;
  };
  static constexpr std::array<Shell, 3> shells{{{0.3, 1.0}, {0.6, 0.7}, {0.9, 0.4}}};
  constexpr double half_width = 0.08;
  return sample<std::uint16_t>(size, [](glm::dvec3 place) {
    const glm::dvec3 p = 2.0 * place - 1.0;
    const double r = std::sqrt(glm::dot(p, p));
    double sum = 0;
    for (const Shell& shell : shells) sum += shell.value * bump((r - shell.radius) / half_width);
    return sum;
  });
}

struct Blob {
  glm::dvec3 centre;
  double radius = 0;
};

std::array<Blob, 40> sparse_blobs() {
  core::Random random(20240229);
  std::array<Blob, 40> blobs;
  for (Blob& blob : blobs) {
    // Each statement draws one random number, because within an expression the compiler may choose
    // the order of evaluation.
    blob.centre.x = random.uniform(0.1, 0.9);
    blob.centre.y = random.uniform(0.1, 0.9);
    blob.centre.z = random.uniform(0.1, 0.9);
    blob.radius = random.uniform(0.04, 0.08);
  }
  return blobs;
}

// Returns the range [first, last) of voxels along one axis whose centres lie within `radius` of
// `centre`.
std::array<int, 2> covered_indices(double centre, double radius, int n) {
  return {std::max(0, static_cast<int>(std::floor((centre - radius) * n))),
          std::min(n, static_cast<int>(std::floor((centre + radius) * n)) + 1)};
}

Volume sparse_field(std::array<int, 3> size) {
  Volume volume = fill<std::uint8_t>(size, 255, [](int, int, int) { return std::uint8_t{0}; });
  for (const Blob& blob : sparse_blobs()) {
    const auto is = covered_indices(blob.centre.x, blob.radius, size[0]);
    const auto js = covered_indices(blob.centre.y, blob.radius, size[1]);
    const auto ks = covered_indices(blob.centre.z, blob.radius, size[2]);
    for (int k = ks[0]; k < ks[1]; ++k) {
      for (int j = js[0]; j < js[1]; ++j) {
        for (int i = is[0]; i < is[1]; ++i) {
          const glm::dvec3 place((i + 0.5) / size[0], (j + 0.5) / size[1], (k + 0.5) / size[2]);
          const glm::dvec3 away = (place - blob.centre) / blob.radius;
          const auto index = (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
                              static_cast<std::size_t>(j)) *
                                 static_cast<std::size_t>(size[0]) +
                             static_cast<std::size_t>(i);
          const std::byte value{quantise<std::uint8_t>(bump(std::sqrt(glm::dot(away, away))))};
          volume.voxels[index] = std::max(volume.voxels[index], value);
        }
      }
    }
  }
  return volume;
}

Volume gaussian_blob(std::array<int, 3> size) {
  const double sigma = *std::min_element(size.begin(), size.end()) / 8.0;
  return fill<float>(size, 1, [&](int i, int j, int k) {
    const glm::dvec3 q(i + 0.5 - size[0] / 2.0, j + 0.5 - size[1] / 2.0, k + 0.5 - size[2] / 2.0);
    return static_cast<float>(exponential(-glm::dot(q, q) / (2 * sigma * sigma)));
  });
}

struct Generator {
  GeneratorInfo info;
  Volume (*make)(std::array<int, 3> size);
};

constexpr std::array<Generator, 8> generators{{
    {{"uniform_box",
      "a constant field without empty space, with a closed-form solution for every ray"},
     uniform_box},
    {{"gradient_box", "a ramp from corner to corner"}, gradient_box},
    {{"frequency_box",
      "twelve sine periods along each axis: the worst case for caches and step sizes"},
     frequency_box},
    {{"mandelbulb", "distance to the power-8 Mandelbulb: a dense core with fine surface details"},
     mandelbulb},
    {{"marschner_lobb", "the Marschner-Lobb test signal for reconstruction filters"},
     marschner_lobb},
    {{"nested_shells", "three smooth concentric shells"}, nested_shells},
    {{"sparse_field", "forty small blobs in empty space, about 4 % occupied"}, sparse_field},
    {{"gaussian_blob", "a Gaussian, with a closed-form solution for every ray"}, gaussian_blob},
}};

// Throws InputError for an unknown name or an unsupported size.
const Generator& generator_of(std::string_view name, std::array<int, 3> size) {
  for (const int n : size) {
    if (n < 1 || n > largest_side) {
      throw core::InputError(fmt::format("generate:{}: size {} is out of range; expected 1 to {}",
                                         name, n, largest_side));
    }
  }
  const auto found = std::find_if(generators.begin(), generators.end(),
                                  [&](const Generator& g) { return g.info.name == name; });
  if (found == generators.end()) {
    std::string known;
    for (const Generator& g : generators) known += fmt::format(" {}", g.info.name);
    throw core::InputError(
        fmt::format("unknown volume generator '{}'; expected one of{}", name, known));
  }
  return *found;
}

}  // namespace

std::vector<GeneratorInfo> volume_generators() {
  std::vector<GeneratorInfo> infos;
  for (const Generator& generator : generators) infos.push_back(generator.info);
  return infos;
}

void check_volume_generator(std::string_view name, std::array<int, 3> size) {
  static_cast<void>(generator_of(name, size));
}

Volume generate_volume(std::string_view name, std::array<int, 3> size) {
  Volume volume = generator_of(name, size).make(size);
  const bool cube = size[0] == size[1] && size[1] == size[2];
  volume.name = cube ? fmt::format("generate:{}:{}", name, size[0])
                     : fmt::format("generate:{}:{}x{}x{}", name, size[0], size[1], size[2]);
  return volume;
}

}  // namespace triptych::scene
