#include "float_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych::reference {

namespace {

using glm::ivec3;
using glm::vec3;
using glm::vec4;

vec3 single(const glm::dvec3& v) {
  return vec3(v);
}

// A scene in the numbers that a device receives. Positions are in units of voxels.
class FloatRenderer {
 public:
  FloatRenderer(const scene::VolumeScene& scene, const FloatOptions& options)
      : scene_(scene),
        grid_(*scene.grid),
        options_(options),
        size_(grid_.size[0], grid_.size[1], grid_.size[2]),
        inverse_spacing_(single(1.0 / spacing())),
        eye_(single(scene.camera.eye / spacing())),
        step_(static_cast<float>(scene.step_world())),
        smallest_(static_cast<float>(scene.smallest_spacing())) {}

  [[nodiscard]] vec4 pixel(int x, int y) const {
    const Chord chord = chord_of(x, y);
    vec3 colour(0.0F);
    float transmittance = 1.0F;
    for (int i = 0; i < chord.count; ++i) {
      const float share = std::min(1.0F, std::max(chord.steps - static_cast<float>(i), 0.0F));
      add(chord.at(i), chord.direction, share, colour, transmittance);
      if (transmittance < static_cast<float>(options_.ert)) break;
    }
    const vec4 behind(scene_.background[0], scene_.background[1], scene_.background[2],
                      scene_.background[3]);
    return vec4(colour, 1.0F - transmittance) + transmittance * behind;
  }

  void count(int x, int y, FloatCounts& counts) const {
    const Chord chord = chord_of(x, y);
    counts.hits += chord.count > 0 ? 1 : 0;
    counts.samples += chord.count;
    for (int i = 0; i < chord.count; ++i) {
      if (transfer(field(chord.at(i))).a > 0.0F) counts.nonzero += 1;
    }
  }

 private:
  struct Chord {
    vec3 direction;
    vec3 entry;
    vec3 stride;
    float steps = 0;
    int count = 0;
    [[nodiscard]] vec3 at(int i) const { return entry + (static_cast<float>(i) + 0.5F) * stride; }
  };

  [[nodiscard]] Chord chord_of(int x, int y) const {
    Chord chord;
    chord.direction = direction(x, y);
    const vec3 v = chord.direction * inverse_spacing_;
    float begin = 0.0F;
    float end = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) clip(axis, v[axis], begin, end);
    if (!(end > begin)) return chord;
    chord.steps = (end - begin) / step_;
    chord.entry = eye_ + begin * v;
    chord.stride = v * step_;
    chord.count = static_cast<int>(std::ceil(chord.steps));
    return chord;
  }

  [[nodiscard]] glm::dvec3 spacing() const {
    return {grid_.spacing[0], grid_.spacing[1], grid_.spacing[2]};
  }

  [[nodiscard]] vec3 direction(int x, int y) const {
    const double half = std::tan(glm::radians(scene_.camera.fov_y_deg) / 2);
    const glm::dvec3 right = glm::cross(scene_.camera.forward, scene_.camera.up);
    const vec3 across = single(right * (half * scene_.width / scene_.height));
    const vec3 up = single(scene_.camera.up * half);
    const float u =
        (2.0F * (static_cast<float>(x) + 0.5F)) / static_cast<float>(scene_.width) - 1.0F;
    const float v =
        (2.0F * (static_cast<float>(y) + 0.5F)) / static_cast<float>(scene_.height) - 1.0F;
    const vec3 d = single(scene_.camera.forward) + u * across - v * up;
    return d / std::sqrt(glm::dot(d, d));
  }

  void clip(int axis, float v, float& begin, float& end) const {
    const auto extent = static_cast<float>(size_[axis]);
    if (v == 0.0F) {
      if (eye_[axis] < 0.0F || eye_[axis] > extent) end = -1.0F;
      return;
    }
    const float a = (0.0F - eye_[axis]) / v;
    const float b = (extent - eye_[axis]) / v;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }

  [[nodiscard]] float voxel(const ivec3& at) const {
    const ivec3 p = glm::clamp(at, ivec3(0), size_ - 1);
    const auto index = static_cast<std::size_t>(p.x + size_.x * (p.y + size_.y * p.z));
    // Recovers the stored value exactly.
    return static_cast<float>((grid_.normalised(index) - grid_.offset) / grid_.scale);
  }

  [[nodiscard]] float field(vec3 p) const {
    p.x += static_cast<float>(options_.shift_voxels);
    const vec3 q = p - 0.5F;
    const vec3 base = glm::floor(q);
    vec3 f = q - base;
    if (options_.weight_bits > 0) {
      const auto one = static_cast<float>(1 << options_.weight_bits);
      f = glm::floor(f * one + 0.5F) / one;
    }
    const ivec3 a(base);
    float plane[2];
    for (int z = 0; z < 2; ++z) {
      float row[2];
      for (int y = 0; y < 2; ++y) {
        const float left = voxel(a + ivec3(0, y, z));
        row[y] = left + f.x * (voxel(a + ivec3(1, y, z)) - left);
      }
      plane[z] = row[0] + f.y * (row[1] - row[0]);
    }
    const float stored = plane[0] + f.z * (plane[1] - plane[0]);
    return stored * static_cast<float>(grid_.scale) + static_cast<float>(grid_.offset);
  }

  [[nodiscard]] vec4 transfer(float x) const {
    const float u = std::min(std::max(x * 256.0F - 0.5F, 0.0F), 255.0F);
    const int k = std::min(static_cast<int>(u), 254);
    const auto& lower = scene_.transfer_function.entries[static_cast<std::size_t>(k)];
    const auto& upper = scene_.transfer_function.entries[static_cast<std::size_t>(k) + 1];
    const vec4 a(lower[0], lower[1], lower[2], lower[3]);
    const vec4 b(upper[0], upper[1], upper[2], upper[3]);
    return a + (u - static_cast<float>(k)) * (b - a);
  }

  [[nodiscard]] vec3 shaded(const vec3& colour, const vec3& p, const vec3& d) const {
    const scene::Shading& s = scene_.shading;
    vec3 g;
    for (int axis = 0; axis < 3; ++axis) {
      vec3 one(0.0F);
      one[axis] = 1.0F;
      g[axis] = (field(p + one) - field(p - one)) * 0.5F * smallest_ * inverse_spacing_[axis];
    }
    const float cosine = std::abs(glm::dot(g, d)) /
                         std::max(std::sqrt(glm::dot(g, g)), static_cast<float>(s.gradient_floor));
    float highlight = cosine;
    for (int n = 1; n < s.exponent; n *= 2) highlight *= highlight;
    return colour * (static_cast<float>(s.ambient) + static_cast<float>(s.diffuse) * cosine) +
           static_cast<float>(s.specular) * highlight;
  }

  void add(const vec3& p, const vec3& d, float share, vec3& colour, float& transmittance) const {
    const vec4 rgba = transfer(field(p));
    if (!(rgba.a > 0.0F)) return;
    const vec3 own = scene_.shading.enabled ? shaded(vec3(rgba), p, d) : vec3(rgba);
    const float steps = static_cast<float>(scene_.step_voxels) * share;
    float opacity = 0.0F;
    if (steps > 0.0F) {
      opacity = rgba.a >= 1.0F ? 1.0F : -std::expm1(steps * std::log1p(-rgba.a));
    }
    const float weight = transmittance * opacity;
    colour += weight * own;
    transmittance -= weight;
  }

  const scene::VolumeScene& scene_;
  const scene::VoxelGrid& grid_;
  FloatOptions options_;
  ivec3 size_;
  vec3 inverse_spacing_;
  vec3 eye_;
  float step_;
  float smallest_;
};

}  // namespace

core::Image render_float(const scene::VolumeScene& scene, const FloatOptions& options) {
  const FloatRenderer renderer(scene, options);
  core::Image image(scene.width, scene.height);
  auto out = image.rgba.begin();
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const vec4 pixel = renderer.pixel(x, y);
      for (int i = 0; i < 4; ++i) *out++ = pixel[i];
    }
  }
  return image;
}

FloatCounts count_float(const scene::VolumeScene& scene, const FloatOptions& options) {
  const FloatRenderer renderer(scene, options);
  FloatCounts counts;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) renderer.count(x, y, counts);
  }
  return counts;
}

ErrorModel float_model(const scene::VolumeScene& scene, const FloatOptions& options) {
  constexpr double unit = 0x1.0p-24;
  const scene::VoxelGrid& grid = *scene.grid;
  const glm::dvec3 spacing{grid.spacing[0], grid.spacing[1], grid.spacing[2]};
  const glm::dvec3 size{grid.size[0], grid.size[1], grid.size[2]};
  const glm::dvec3 eye = scene.camera.eye / spacing;
  // The position of a sample is eye + t·direction. Rounding the eye causes one error. All other
  // errors are relative to `reach`, the distance to the farthest corner: about 20 come from the
  // direction, 20 from the distance t, which is a quotient by a component of the direction, and 10
  // from the products and sums of the position.
  const double reach = glm::length(glm::max(glm::abs(eye), glm::abs(eye - size)));
  ErrorModel model;
  model.position_error_voxels = unit * (glm::length(eye) + 50 * reach);
  // The value results from about 14 operations: three interpolations of three operations each, and
  // a few more for the mapping and for the position in the table.
  model.value_error = 14 * unit;
  model.filter_weight_error =
      options.weight_bits > 0 ? 3 * std::exp2(-options.weight_bits - 1) : unit;
  model.table_error = 3 * unit;
  // The errors of log1p and expm1 are two ulps each, or 4·unit each. The remaining 4·unit allow for
  // rounding the exponent, which is a product.
  model.opacity_error = 12 * unit;
  model.compositing_error = 4 * unit;
  model.ert = options.ert;
  return model;
}

}  // namespace triptych::reference
