#include "backends/null/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/hash.hpp"
#include "core/random.hpp"

namespace triptych::null_backend {
namespace {

using measure::ParticleWork;
using measure::VolumeWork;

template <typename Scene>
double pixels_of(const Scene& scene) {
  return static_cast<double>(scene.width) * static_cast<double>(scene.height);
}

std::size_t particles_of(const ParticleWork& work) {
  return work.scene.particles ? work.scene.particles->count() : 0;
}

double samples_of(const VolumeWork& work) {
  int longest = 1;
  if (work.scene.grid) longest = std::ranges::max(work.scene.grid->size);
  return pixels_of(work.scene) * longest / work.scene.step_voxels;
}

double samples_of(const ParticleWork& work) {
  return pixels_of(work.scene) + static_cast<double>(particles_of(work));
}

record::Counts counters_of(const VolumeWork& work) {
  const auto rays = static_cast<std::uint64_t>(pixels_of(work.scene));
  const auto samples = static_cast<std::uint64_t>(samples_of(work));
  const bool bricks = work.options.skip != technique::Skip::none;
  const bool ends_early = work.options.ert > 0;
  return {{"rays_hit", rays},
          {"samples", samples},
          {"samples_nonzero", samples / 2},
          {"bricks_visited", bricks ? samples / 8 : 0},
          {"bricks_skipped", bricks ? samples / 16 : 0},
          {"rays_terminated", ends_early ? rays / 4 : 0},
          {"samples_saved", ends_early ? samples / 8 : 0}};
}

record::Counts counters_of(const ParticleWork& work) {
  const std::uint64_t particles = particles_of(work);
  const auto pixels = static_cast<std::uint64_t>(pixels_of(work.scene));
  return {{"cells", particles / 512 + 1},
          {"cells_culled", 0},
          {"particles_submitted", particles},
          {"particles_culled", 0},
          {"sprites", particles},
          {"vertices", 4 * particles},
          {"fragments", pixels},
          {"fragments_discarded", pixels / 4},
          {"fragments_kept", pixels - pixels / 4},
          {"visible_ids", std::min(particles, pixels)}};
}

// Returns the number of invocations of the compute pass or of the fragment stage.
std::uint64_t invocations_of(const VolumeWork& work) {
  return static_cast<std::uint64_t>(pixels_of(work.scene));
}

std::uint64_t invocations_of(const ParticleWork& work) {
  return static_cast<std::uint64_t>(pixels_of(work.scene));
}

int stride_of(const VolumeWork& work) {
  return work.options.extra_work_stride;
}

int stride_of(const ParticleWork& work) {
  return work.options.extra_work_stride;
}

// camera_key() and image_key() describe everything that determines an image, but not how the
// image is computed.
std::string camera_key(const scene::Camera& c) {
  return fmt::format("{} {} {} {} {} {} {} {}", c.eye.x, c.eye.y, c.eye.z, c.forward.x, c.forward.y,
                     c.forward.z, c.up.x, c.fov_y_deg);
}

std::string image_key(const VolumeWork& work) {
  const scene::VolumeScene& scene = work.scene;
  return fmt::format("{} {} {} {} {}", scene.grid ? scene.grid->name : "",
                     scene.transfer_function.name, scene.step_voxels, scene.shading.enabled,
                     camera_key(scene.camera));
}

std::string image_key(const ParticleWork& work) {
  const scene::ParticleScene& scene = work.scene;
  return fmt::format("{} {} {}", scene.particles ? scene.particles->name : "", scene.radius_scale,
                     camera_key(scene.camera));
}

core::Image slopes(int width, int height, const std::string& key, double fault) {
  core::Random random(number_of(key));
  core::Image image(width, height);
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const double ground = random.uniform(0.1, 0.4) + 0.02 * fault;
    const double along_x = random.uniform(0, 0.25);
    const double along_y = random.uniform(0, 0.25);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x));
        image.rgba[i + channel] =
            static_cast<float>(ground + along_x * (x + 0.5) / width + along_y * (y + 0.5) / height);
      }
    }
  }
  return image;
}

// Adds a different particle to each pixel, and leaves every tenth pixel empty. An injected fault
// also changes ids and depths.
void add_particles(core::Image& image, std::uint32_t fault) {
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const bool empty = i % 10 == 0;
    image.ids.push_back(empty ? core::Image::no_particle : static_cast<std::uint32_t>(i) + fault);
    image.depth.push_back(empty ? std::numeric_limits<float>::infinity()
                                : 1.0F + 0.001F * static_cast<float>(i + fault));
  }
}

std::string code_options(const VolumeWork& work) {
  const technique::RaycastOptions& options = work.options;
  return fmt::format("{} {} {} {}", technique::name_of(options.sampler),
                     technique::name_of(options.skip), static_cast<int>(options.fault),
                     options.extra_work_stride);
}

std::string code_options(const ParticleWork& work) {
  const technique::ParticleOptions& options = work.options;
  return fmt::format("{} {} {} {} {} {} {}", technique::name_of(options.transfer),
                     technique::name_of(options.ray), options.conservative_depth, options.corners,
                     technique::name_of(options.culling), static_cast<int>(options.fault),
                     options.extra_work_stride);
}

core::Image pattern(const VolumeWork& work) {
  return slopes(work.scene.width, work.scene.height, image_key(work),
                static_cast<double>(work.options.fault));
}

core::Image pattern(const ParticleWork& work) {
  core::Image image = slopes(work.scene.width, work.scene.height, image_key(work),
                             static_cast<double>(work.options.fault));
  add_particles(image, static_cast<std::uint32_t>(work.options.fault));
  return image;
}

}  // namespace

std::uint64_t number_of(const std::string& text) {
  return std::stoull(core::content_hash(text).substr(0, 16), nullptr, 16);
}

double samples_of(const measure::Work& work) {
  return std::visit([](const auto& each) { return samples_of(each); }, work.scene);
}

double extra_share(const measure::Work& work) {
  const int stride = std::visit([](const auto& each) { return stride_of(each); }, work.scene);
  return stride > 0 ? 1.0 / stride : 0;
}

record::Counts counters_of(const measure::Work& work) {
  return std::visit([](const auto& each) { return counters_of(each); }, work.scene);
}

record::Counts statistics_of(const measure::Work& work) {
  const std::uint64_t pixels =
      std::visit([](const auto& each) { return invocations_of(each); }, work.scene);
  if (technique::technique(work.technique).work == technique::Work::compute) {
    return {{"compute_invocations", pixels}};
  }
  return {{"input_assembly_vertices", 3}, {"input_assembly_primitives", 1},
          {"vertex_invocations", 3},      {"clipping_invocations", 1},
          {"clipping_primitives", 1},     {"fragment_invocations", pixels}};
}

core::Image pattern(const measure::Work& work) {
  return std::visit([](const auto& each) { return pattern(each); }, work.scene);
}

std::string code_key(const measure::Work& work) {
  return work.technique + " " +
         std::visit([](const auto& each) { return code_options(each); }, work.scene);
}

}  // namespace triptych::null_backend
