// Compares every technique on every device directly with closed-form solutions for spheres
// (reference/sphere_closed_forms.hpp), without using the reference renderer.

#include <algorithm>
#include <numbers>

#include "core/random.hpp"
#include "particle_scenes.hpp"
#include "reference/sphere_closed_forms.hpp"

namespace triptych::contract {
namespace {

using std::numbers::pi;

constexpr int side = 160;

ParticleWork white_spheres(const std::vector<std::array<double, 4>>& spheres,
                           const scene::Camera& camera) {
  scene::ParticleSet set;
  set.name = "white";
  set.colour = scene::ColourKind::rgba32;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (scene::append(set, spheres[i], i)) set.rgba32.push_back({1, 1, 1, 1});
  }
  return particle_work(std::move(set), camera, side, side);
}

double pixels_with_ids(const core::Image& image) {
  return static_cast<double>(std::ranges::count_if(
      image.ids, [](std::uint32_t id) { return id != core::Image::no_particle; }));
}

// Returns the expected error: the number of pixel centres within a convex outline differs from its
// area by a few times the square root of the outline's length (as if the outline crossed the pixels
// at random positions).
double lattice_error(double length) {
  return 2 * std::sqrt(length) + 2;
}

TEST(SphereForms, S1SilhouettesAreEllipses) {
  on_every_driver([](measure::Device& device) {
    const double focal = 0.5 * side / std::tan(80 * pi / 360);  // in pixels
    for (const double theta : {0.0, 0.25, 0.5}) {
      SCOPED_TRACE(theta);
      const double sine = 0.2;
      const glm::dvec3 centre{5 * std::sin(theta), 0, -5 * std::cos(theta)};
      const ParticleWork work = white_spheres({{centre.x, centre.y, centre.z, 5 * sine}},
                                              camera_looking_at({0, 0, 0}, {0, 0, -1}, 80));
      const auto ellipse = reference::s1_silhouette(sine, theta, focal);
      ASSERT_TRUE(ellipse);
      with_every_technique(device, work, [&](const measure::Work& whole) {
        EXPECT_NEAR(pixels_with_ids(draw(device, whole)), ellipse->area,
                    lattice_error(2 * pi * ellipse->semi_major));
      });
    }
  });
}

// From a distance of 200,000 radii, rays are parallel to within 1e-5. At the rim of a disc with a
// radius of R pixels, the integrand falls to 0 like a square root, so it changes by about R^−½ from
// one pixel to the next. About R of the R² pixels are at the rim, so the error of the mean is below
// R^−3/2.
TEST(SphereForms, S3TheMeanCosineOverADiscIsTwoThirds) {
  on_every_driver([](measure::Device& device) {
    const double radius_px = 60;
    const double fov = 2 * std::atan(side / (2 * radius_px) / 2e5) * 180 / pi;
    const ParticleWork work =
        white_spheres({{0, 0, 0, 1}}, camera_looking_at({0, 0, 2e5}, {0, 0, 0}, fov));
    const scene::SphereShading shading;
    with_every_technique(device, work, [&](const measure::Work& whole) {
      const core::Image image = draw(device, whole);
      double sum = 0;
      for (std::size_t i = 0; i < image.ids.size(); ++i) {
        if (image.ids[i] == 0) sum += static_cast<double>(image.rgba[4 * i]);
      }
      const double cosine = (sum / pixels_with_ids(image) - shading.ambient) / shading.diffuse;
      EXPECT_NEAR(cosine, reference::s3_mean_cosine, std::pow(radius_px, -1.5));
    });
  });
}

// Tests the boundary between two equal spheres: a pixel that shows one of them lies on that
// sphere's side of the bisecting plane, up to the error of depth.
TEST(SphereForms, S4EqualSpheresMeetInTheBisectingPlane) {
  on_every_driver([](measure::Device& device) {
    const std::array<glm::dvec3, 2> centres{glm::dvec3{-0.3, 0.1, 0.2}, glm::dvec3{0.4, 0, -0.1}};
    const scene::Camera camera = camera_looking_at({1, 2, 5}, {0, 0, 0}, 30);
    const ParticleWork work = white_spheres({{centres[0].x, centres[0].y, centres[0].z, 0.8},
                                             {centres[1].x, centres[1].y, centres[1].z, 0.8}},
                                            camera);
    // The rounding error of the depth is at most 24·2⁻²⁴ times the distance to the far side of a
    // sphere (suites/particles/tolerance.hpp). Here, this distance is less than 7.
    const double rounding = 24 * 0x1.0p-24 * 7;
    with_every_technique(device, work, [&](const measure::Work& whole) {
      const core::Image image = draw(device, whole);
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const auto at = static_cast<std::size_t>(y * side + x);
          const std::uint32_t id = image.ids[at];
          if (id == core::Image::no_particle) continue;
          const glm::dvec3 ray = camera.ray_direction(x, y, side, side);
          const double t = static_cast<double>(image.depth[at]) / glm::dot(ray, camera.forward);
          ASSERT_GE(
              reference::s4_bisector(camera.eye + t * ray, centres.at(id), centres.at(1 - id)),
              -rounding)
              << x << ' ' << y;
        }
      }
    });
  });
}

// The centres are distributed over a square whose central part is in view, so that discs reach in
// from outside as they would on a torus. Let s be the expected share of the view that remains
// uncovered, r the radius of a disc, and A the area of the view. The uncovered share has a standard
// deviation of less than √(s·(1−s)·4πr²/A), because only points within 2r of each other are
// correlated.
TEST(SphereForms, S5RandomDiscsLeaveTheExpectedShareUncovered) {
  on_every_driver([](measure::Device& device) {
    constexpr int discs = 400;
    constexpr double distance = 1e4;
    constexpr double radius = 0.05;
    const double fov = 2 * std::atan(0.9 / distance) * 180 / pi;  // views the square [−1, 1]²
    core::Random random(21);
    std::vector<std::array<double, 4>> spheres;
    for (int i = 0; i < discs; ++i) {
      spheres.push_back({random.uniform(-1, 1), random.uniform(-1, 1), 0, radius});
    }
    const ParticleWork work =
        white_spheres(spheres, camera_looking_at({0, 0, distance}, {0, 0, 0}, fov));
    const double free = reference::s5_uncovered(discs, radius, 4);
    const double deviation = std::sqrt(free * (1 - free) * 4 * pi * radius * radius / 3.24);
    with_every_technique(device, work, [&](const measure::Work& whole) {
      EXPECT_NEAR(1 - pixels_with_ids(draw(device, whole)) / (side * side), free, 3 * deviation);
    });
  });
}

// Compares the number of fragments of an N-gon around a disc with the expected ratio of their
// areas. The polygon is enlarged by 1/64 pixel and by perspective, both of which are below a
// thousandth here. Some of its edges are horizontal, vertical or at 45°, so a whole edge may lie on
// one side of the pixel centres. This adds or removes up to half a pixel per pixel of the outline,
// whose length is at most 8R for a disc with a radius of R pixels.
TEST(SphereForms, S6PolygonsWasteTheExpectedFragments) {
  on_every_driver([](measure::Device& device) {
    const double radius_px = 60;
    const double fov = 2 * std::atan(side / (2 * radius_px) / 1e3) * 180 / pi;
    ParticleWork work =
        white_spheres({{0, 0, 0, 1}}, camera_looking_at({0, 0, 1e3}, {0, 0, 0}, fov));
    for (const int corners : {4, 8, 16}) {
      SCOPED_TRACE(corners);
      work.options.corners = corners;
      const measure::Work whole{.technique = "polygon_tess", .scene = work};
      if (device.unsupported(whole)) return;
      const auto prepared = device.prepare(whole);
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      const record::Counts counts = prepared->frame(measure::Purpose::counters).counts;
      const double area = pi * radius_px * radius_px / reference::s6_tightness(corners);
      EXPECT_NEAR(static_cast<double>(counts.at("fragments")), area, 0.002 * area + 4 * radius_px);
      EXPECT_NEAR(static_cast<double>(counts.at("fragments_kept")), pi * radius_px * radius_px,
                  lattice_error(2 * pi * radius_px));
    }
  });
}

}  // namespace
}  // namespace triptych::contract
