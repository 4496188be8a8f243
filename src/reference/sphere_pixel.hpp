#pragma once
// One pixel of a particle scene: what its ray shows, and what rays beside it may show instead.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/sphere_hit.hpp"
#include "reference/sphere_tree.hpp"
#include "reference/spheres.hpp"
#include "reference/table.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::reference {

struct SpherePixel {
  std::array<double, 4> rgba{};
  double depth = 0;
  std::uint32_t id = 0;
  double bound = 0;
  double depth_bound = 0;
  bool certain = false;
};

// What all pixels of a picture share. Scene and model must outlive it.
class SpherePicture {
 public:
  SpherePicture(const scene::ParticleScene& scene, const SphereErrorModel& model);

  // Largest distance of two unit directions, one of them at `along` to the view axis (cosine), that
  // `pixels` apart in the image.
  [[nodiscard]] double chord(double pixels, double along) const;
  // Straight colour of a particle before shading.
  [[nodiscard]] std::array<double, 3> colour(std::size_t index) const;

  const scene::ParticleScene& scene;
  const SphereErrorModel& model;

 private:
  // By which the tree's boxes must grow so that it finds every sphere that may be reached.
  [[nodiscard]] double growth() const;

  double pixel_;  // size at distance 1 along the view axis
  Table table_;

 public:
  const SphereTree tree;
};

// Draws pixels; one per thread, as it keeps its memory from pixel to pixel.
//
// A sphere is a candidate where some ray within the margin may meet it (Reach) not behind the
// farthest depth at which another one covers all these rays. Z is compared, widened by its relative
// error. A pixel is certain where there is exactly one candidate and it covers, or none at all;
// particles with the shown one's centre and radius are no rivals, for on an exact tie the lowest id
// must win. This is an interval of depth over the whole disc of rays, not a sample of them: it
// finds the particle that is smaller than the margin, and errs towards uncertainty.
class SphereTracer {
 public:
  explicit SphereTracer(const SpherePicture& picture) : picture_(picture) {}
  [[nodiscard]] SpherePixel operator()(int x, int y);

 private:
  struct Candidate {
    std::uint32_t place = 0;
    double nearest = 0;  // least Z
  };
  struct View {
    glm::dvec3 direction{};
    double along = 0;  // cosine to the view axis
    Wobble margin;     // within which the pixel must keep its id
    Wobble lateral;    // by which a device's ray and sphere may be off
  };

  [[nodiscard]] View view(int x, int y) const;
  [[nodiscard]] Passage pass(const View& view, std::uint32_t place) const;
  void meet(const View& view, std::uint32_t place);
  [[nodiscard]] bool is_rival(const Candidate& candidate) const;
  // Colour where the half chord is `half` of the radius.
  [[nodiscard]] std::array<double, 4> shaded(std::uint32_t place, double half) const;
  void bound_shown(const View& view, SpherePixel& pixel) const;
  void bound_all(const View& view, SpherePixel& pixel) const;

  const SpherePicture& picture_;
  std::vector<Candidate> candidates_;
  double covered_ = 0;       // least Z at which every ray within the margin has met something
  double distance_ = 0;      // of the shown surface along the ray …
  std::uint32_t shown_ = 0;  // … and its place in the tree
};

}  // namespace triptych::reference
