#pragma once
// One pixel of a particle scene: the surface that its ray hits first, and the surfaces that nearby
// rays may hit instead.

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

// Data that all pixels of an image share. The scene and the model must outlive this object.
class SphereSetup {
 public:
  SphereSetup(const scene::ParticleScene& scene, const SphereErrorModel& model);

  // Returns the largest distance between two unit directions that are `pixels` apart in the image,
  // if `along` is the cosine between one of them and the view axis.
  [[nodiscard]] double chord(double pixels, double along) const;
  // Returns the colour of a particle before shading, not premultiplied.
  [[nodiscard]] std::array<double, 3> colour(std::size_t index) const;

  const scene::ParticleScene& scene;
  const SphereErrorModel& model;

 private:
  // Returns the growth that the tree's boxes need, so that every sphere that a ray may reach is
  // found.
  [[nodiscard]] double growth() const;

  double pixel_;  // size of a pixel at distance 1 along the view axis
  Table table_;

 public:
  const SphereTree tree;
};

// Draws pixels. Each thread has its own tracer, because a tracer reuses its memory from pixel to
// pixel.
//
// Depths are Z values, that is, distances along the view axis. A sphere is a candidate if some ray
// within the margin (SphereErrorModel::margin_px) may hit it at a smaller depth than the largest
// depth at which another sphere covers all these rays. Depths are widened by their relative error
// before they are compared. A pixel is certain if there is exactly one candidate and it covers all
// rays, or if there is no candidate. Further candidates with the same centre and radius as the
// visible particle do not make a pixel uncertain, because on an exact tie the lowest id must win.
//
// Instead of sampling rays, this method computes an interval of depth over the whole disc of rays.
// It therefore finds particles that are smaller than the margin, and in case of doubt it reports
// uncertainty.
class SphereTracer {
 public:
  explicit SphereTracer(const SphereSetup& setup) : setup_(setup) {}
  [[nodiscard]] SpherePixel operator()(int x, int y);
  // Returns the indices in the particle set of all spheres that some ray within the margin may hit,
  // including hidden spheres, sorted by the smallest Z at which a ray may hit them.
  [[nodiscard]] std::vector<std::uint32_t> spheres_near(int x, int y) const;

 private:
  struct Candidate {
    std::uint32_t place = 0;
    double nearest = 0;  // smallest Z
  };
  struct View {
    glm::dvec3 direction{};
    double along = 0;  // cosine between the ray and the view axis
    // A pixel is certain only if all rays within this margin hit the same particle.
    GeometryError margin;
    GeometryError lateral;  // errors of the ray and of spheres on a device
  };

  [[nodiscard]] View view(int x, int y) const;
  [[nodiscard]] Passage pass(const View& view, std::uint32_t place) const;
  void test_sphere(const View& view, std::uint32_t place);
  [[nodiscard]] bool is_rival(const Candidate& candidate) const;
  // Returns the colour at a point where half the chord is `half` times the radius.
  [[nodiscard]] std::array<double, 4> shaded(std::uint32_t place, double half) const;
  void bound_from_visible_sphere(const View& view, SpherePixel& pixel) const;
  void bound_from_candidates(const View& view, SpherePixel& pixel) const;

  const SphereSetup& setup_;
  std::vector<Candidate> candidates_;
  double covered_ = 0;         // smallest Z at which every ray within the margin has hit a sphere
  double distance_ = 0;        // distance of the visible surface along the ray
  std::uint32_t visible_ = 0;  // index of the visible sphere in the tree
};

}  // namespace triptych::reference
