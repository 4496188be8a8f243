#include "reference/spheres.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"
#include "reference/rows.hpp"
#include "reference/sphere_pixel.hpp"

namespace triptych::reference {

namespace {

void check(const scene::ParticleScene& scene) {
  if (!scene.particles) throw core::InputError("the scene has no particles");
  const scene::ParticleSet& set = *scene.particles;
  if (scene.width < 1 || scene.height < 1) throw core::InputError("the viewport has no pixels");
  if (!(scene.camera.fov_y_deg > 0 && scene.camera.fov_y_deg < 180)) {
    throw core::InputError("the field of view must lie between 0 and 180 degrees");
  }
  const bool coloured =
      (set.colour == scene::ColourKind::rgba8 && set.rgba8.size() == set.count()) ||
      (set.colour == scene::ColourKind::rgba32 && set.rgba32.size() == set.count()) ||
      (set.colour == scene::ColourKind::intensity && set.intensity.size() == set.count());
  if (set.ids.size() != set.count() || !coloured) {
    throw core::InputError(
        "every particle needs an id, and a colour in the colour format of the particle set");
  }
}

float rounded_up(double value) {
  const auto rounded = static_cast<float>(value);
  if (static_cast<double>(rounded) >= value) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

SphereTruth blank(const scene::ParticleScene& scene) {
  SphereTruth truth;
  truth.width = scene.width;
  truth.height = scene.height;
  const std::size_t pixels =
      static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  truth.rgba.resize(4 * pixels);
  truth.depth.resize(pixels);
  truth.ids.resize(pixels);
  truth.bound.resize(pixels);
  truth.depth_bound.resize(pixels);
  truth.certain.resize(pixels);
  return truth;
}

void store(const SpherePixel& pixel, std::size_t at, SphereTruth& truth) {
  std::ranges::copy(pixel.rgba, truth.rgba.begin() + static_cast<std::ptrdiff_t>(4 * at));
  truth.depth[at] = pixel.depth;
  truth.ids[at] = pixel.id;
  truth.bound[at] = pixel.bound;
  truth.depth_bound[at] = pixel.depth_bound;
  truth.certain[at] = pixel.certain ? 1 : 0;
}

}  // namespace

SphereTruth render_spheres(const scene::ParticleScene& scene, const SphereErrorModel& model,
                           int threads) {
  check(scene);
  const SphereSetup setup(scene, model);
  SphereTruth truth = blank(scene);
  for_each_row(scene.height, threads, [&]() -> RowWorker {
    return [&, trace = SphereTracer(setup)](int y) mutable {
      for (int x = 0; x < scene.width; ++x) {
        const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) +
                        static_cast<std::size_t>(x);
        store(trace(x, y), at, truth);
      }
    };
  });
  const auto empty = std::ranges::count(truth.ids, core::Image::no_particle);
  truth.coverage = 1 - static_cast<double>(empty) / static_cast<double>(truth.ids.size());
  return truth;
}

core::Image SphereTruth::image() const {
  core::Image image(width, height);
  const auto to_float = [](double value) { return static_cast<float>(value); };
  std::ranges::transform(rgba, image.rgba.begin(), to_float);
  image.depth.resize(depth.size());
  std::ranges::transform(depth, image.depth.begin(), to_float);
  image.ids = ids;
  return image;
}

core::Image SphereTruth::bound_image() const {
  core::Image image(width, height);
  image.depth.resize(depth_bound.size());
  std::ranges::transform(depth_bound, image.depth.begin(), rounded_up);
  image.ids.resize(certain.size());
  std::ranges::transform(certain, image.ids.begin(), [](std::uint8_t is_certain) {
    return is_certain != 0 ? 0U : core::Image::no_particle;
  });
  for (std::size_t i = 0; i < bound.size(); ++i) {
    std::fill_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, rounded_up(bound[i]));
  }
  return image;
}

}  // namespace triptych::reference
