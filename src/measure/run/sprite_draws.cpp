#include "measure/run/sprite_draws.hpp"

#include <memory>
#include <numeric>
#include <utility>

#include "scene/particle_subset.hpp"

namespace triptych::measure {
namespace {

using accuracy::Particles;
using accuracy::SurfaceDifference;

// The maximum number of spheres in a history, and the maximum number of draws in the search for the
// smallest set of spheres with which the pixel is wrong. The numbers are limited, because a device
// takes several milliseconds to prepare and draw even a few spheres.
constexpr std::size_t most_rows = 64;
constexpr int most_draws = 128;

class SpriteDraws {
 public:
  SpriteDraws(Device& device, const Work& work, SpriteReference& reference,
              const ReferenceInput& input, PixelPlace place)
      : device_(device),
        work_(work),
        reference_(reference),
        input_(input),
        place_(place),
        all_(std::get<ParticleWork>(work.scene).scene.particles) {}

  [[nodiscard]] Particles nearby() const {
    return reference_.particles_near(input_.configuration, input_.precision, place_.x, place_.y);
  }

  [[nodiscard]] Particles all() const {
    Particles particles(all_->count());
    std::iota(particles.begin(), particles.end(), 0U);
    return particles;
  }

  [[nodiscard]] std::uint32_t id_of(std::uint32_t particle) const { return all_->ids[particle]; }

  [[nodiscard]] accuracy::ExpectedSurface expected(const Particles& particles) const {
    return reference_.expected_surface(input_.configuration, input_.precision, particles, place_.x,
                                       place_.y);
  }

  // Returns the pixel after the device has drawn only these particles.
  [[nodiscard]] accuracy::DrawnSurface shown(const Particles& particles) {
    std::get<ParticleWork>(work_.scene).scene.particles =
        std::make_shared<const scene::ParticleSet>(scene::particle_subset(*all_, particles));
    const std::unique_ptr<Prepared> prepared = device_.prepare(work_);
    prepared->poison();
    static_cast<void>(prepared->frame(Purpose::timing));
    return shown_at(prepared->image(), place_);
  }

  [[nodiscard]] SurfaceDifference difference(const Particles& particles) {
    return accuracy::compare(expected(particles), shown(particles));
  }

 private:
  Device& device_;
  Work work_;
  SpriteReference& reference_;
  ReferenceInput input_;
  PixelPlace place_;
  std::shared_ptr<const scene::ParticleSet> all_;
};

void add_row(accuracy::SpriteHistory& history, SpriteDraws& draws, std::uint32_t particle) {
  accuracy::SpriteRow row{.id = draws.id_of(particle),
                          .expected = draws.expected({particle}),
                          .shown = draws.shown({particle}),
                          .differs = {}};
  row.differs = accuracy::compare(row.expected, row.shown);
  if (row.differs != SurfaceDifference::none && !history.first) {
    history.first = history.rows.size();
  }
  history.rows.push_back(row);
}

void find_smallest_set(accuracy::SpriteHistory& history, SpriteDraws& draws,
                       const Particles& nearby) {
  const auto is_wrong = [&](const Particles& particles) {
    return draws.difference(particles) != SurfaceDifference::none;
  };
  const Particles begin = is_wrong(nearby) ? nearby : draws.all();
  accuracy::SmallestSet smallest = accuracy::smallest_set_of(begin, is_wrong, most_draws);
  history.smallest_set_differs = draws.difference(smallest.particles);
  history.stopped_early = smallest.stopped_early;
  for (const std::uint32_t each : smallest.particles)
    history.smallest_set.push_back(draws.id_of(each));
}

}  // namespace

accuracy::DrawnSurface shown_at(const core::Image& image, PixelPlace place) {
  const std::size_t at = static_cast<std::size_t>(place.y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(place.x);
  accuracy::DrawnSurface shown{.id = core::Image::no_particle};
  if (!image.ids.empty()) shown.id = image.ids[at];
  if (!image.depth.empty()) shown.depth = image.depth[at];
  for (std::size_t k = 0; k < 4; ++k) shown.colour[k] = image.rgba[4 * at + k];
  return shown;
}

accuracy::SpriteHistory sprite_history(Device& device, const Work& work, Suite& suite,
                                       const ReferenceInput& input, PixelPlace place,
                                       const accuracy::DrawnSurface& whole) {
  auto* const reference = dynamic_cast<SpriteReference*>(&suite);
  if (reference == nullptr) throw core::NotSupported(pixel_history_of_suite_unsupported);
  SpriteDraws draws(device, work, *reference, input, place);
  const Particles nearby = draws.nearby();
  accuracy::SpriteHistory history;
  for (const std::uint32_t particle : nearby) {
    if (history.rows.size() == most_rows) break;
    add_row(history, draws, particle);
  }
  history.untested = nearby.size() - history.rows.size();
  const bool wrong =
      accuracy::compare(draws.expected(draws.all()), whole) != SurfaceDifference::none;
  if (wrong && !history.first) find_smallest_set(history, draws, nearby);
  return history;
}

}  // namespace triptych::measure
