#include "reference/sphere_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace triptych::reference {

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

double largest_difference(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double largest = 0;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    largest = std::max(largest, std::abs(a[channel] - b[channel]));
  }
  return largest;
}

}  // namespace

SphereSetup::SphereSetup(const scene::ParticleScene& scene_, const SphereErrorModel& model_)
    : scene(scene_),
      model(model_),
      pixel_(2 * std::tan(scene.camera.fov_y_deg * std::numbers::pi / 360) / scene.height),
      table_(scene.intensity_colours, 0.0),
      tree(scene, growth()) {}

// At distance 1/along from the eye, the ray reaches the plane that is at distance 1 along the view
// axis, because `along` is the cosine between the ray and this axis. A displacement by ε in that
// plane rotates the ray by φ with sin φ ≤ x = ε·along, and 2·sin(φ/2) ≤ x/cos(φ/2). For x ≥ 1, even
// opposite rays are possible.
double SphereSetup::chord(double pixels, double along) const {
  const double sine = pixels * pixel_ * along;
  if (!(sine < 1)) return 2;
  return sine / std::sqrt(0.5 + 0.5 * std::sqrt(1 - sine * sine));
}

// Let D be the distance from the eye to a box's farthest corner (no radius in the box is above D),
// and κ = chord + shift (GeometryError). According to hit_range(), a nearby ray may hit a sphere in
// the box only if the central ray comes within δ ≤ κD of the sphere, and the hit may move along the
// ray by up to Δb ≤ (chord + chord²/2)·D. 1e-12 is added for rounding.
double SphereSetup::growth() const {
  const double turn = chord(std::max(model.margin_px, model.lateral_px), 1.0);
  const double kappa = turn + model.lateral_relative;
  return (kappa + turn + 0.5 * turn * turn) * (1 + 1e-9) + 1e-12;
}

std::array<double, 3> SphereSetup::colour(std::size_t index) const {
  const scene::ParticleSet& set = *scene.particles;
  switch (set.colour) {
    case scene::ColourKind::rgba8: {
      const std::uint32_t packed = set.rgba8[index];
      return {(packed & 0xFFU) / 255.0, (packed >> 8 & 0xFFU) / 255.0,
              (packed >> 16 & 0xFFU) / 255.0};
    }
    case scene::ColourKind::rgba32: {
      const auto& [red, green, blue, alpha] = set.rgba32[index];
      return {red, green, blue};
    }
    case scene::ColourKind::intensity:
      break;
  }
  return table_.look_up(Table::span_of({static_cast<double>(set.intensity[index]), 0.0})).colour;
}

SpherePixel SphereTracer::operator()(int x, int y) {
  const View view = this->view(x, y);
  candidates_.clear();
  covered_ = distance_ = unreached;
  const double slack = setup_.model.depth_relative * setup_.tree.farthest();
  setup_.tree.walk(
      view.direction, [&] { return (covered_ + slack) / view.along * (1 + 1e-12); },
      [&](std::uint32_t place) { test_sphere(view, place); });

  SpherePixel pixel;
  const bool hit = distance_ < unreached;
  if (hit) {
    const Passage ray = pass(view, visible_);
    pixel.rgba = shaded(visible_, std::sqrt(ray.half_squared) / ray.radius);
    pixel.depth = distance_ * view.along;
    pixel.id = setup_.scene.particles->ids[setup_.tree.sphere(visible_).index];
  } else {
    std::ranges::copy(setup_.scene.background, pixel.rgba.begin());
    pixel.depth = unreached;
    pixel.id = core::Image::no_particle;
  }
  const bool covers = covered_ < unreached;
  pixel.certain = covers == hit && std::ranges::none_of(candidates_, [this](const Candidate& c) {
                    return is_rival(c);
                  });
  if (!pixel.certain) {
    bound_from_candidates(view, pixel);
  } else if (hit) {
    bound_from_visible_sphere(view, pixel);
  }
  pixel.bound += setup_.model.colour_relative;
  return pixel;
}

std::vector<std::uint32_t> SphereTracer::spheres_near(int x, int y) const {
  const View view = this->view(x, y);
  std::vector<Candidate> found;
  setup_.tree.walk(
      view.direction, [] { return unreached; },
      [&](std::uint32_t place) {
        const HitRange range = hit_range(pass(view, place), view.margin);
        if (range.possible) found.push_back({place, range.nearest});
      });
  std::ranges::stable_sort(found, {}, &Candidate::nearest);
  std::vector<std::uint32_t> indices;
  indices.reserve(found.size());
  for (const Candidate& each : found) indices.push_back(setup_.tree.sphere(each.place).index);
  return indices;
}

SphereTracer::View SphereTracer::view(int x, int y) const {
  const scene::ParticleScene& scene = setup_.scene;
  const SphereErrorModel& model = setup_.model;
  View view;
  view.direction = scene.camera.ray_direction(x, y, scene.width, scene.height);
  view.along = glm::dot(view.direction, scene.camera.forward);
  view.lateral = {setup_.chord(model.lateral_px, view.along), model.lateral_relative,
                  model.depth_relative};
  view.margin = view.lateral;
  view.margin.chord = setup_.chord(std::max(model.margin_px, model.lateral_px), view.along);
  return view;
}

Passage SphereTracer::pass(const View& view, std::uint32_t place) const {
  const SphereTree::Sphere& sphere = setup_.tree.sphere(place);
  return passage(view.direction, glm::dvec3(sphere.centre) - setup_.scene.camera.eye,
                 sphere.radius);
}

void SphereTracer::test_sphere(const View& view, std::uint32_t place) {
  const Passage ray = pass(view, place);
  const HitRange range = hit_range(ray, view.margin);
  if (!range.possible) return;
  const double error = setup_.model.depth_relative * (ray.distance + ray.radius);
  const double nearest = range.nearest * view.along - error;
  if (nearest > covered_) return;
  candidates_.push_back({place, nearest});
  if (range.covers) covered_ = std::min(covered_, range.farthest * view.along + error);

  const double distance = first_surface(ray);
  if (!(distance <= distance_) || distance == unreached) return;
  const auto id = [&](std::uint32_t other) {
    return setup_.scene.particles->ids[setup_.tree.sphere(other).index];
  };
  if (distance < distance_ || id(place) < id(visible_)) {
    distance_ = distance;
    visible_ = place;
  }
}

bool SphereTracer::is_rival(const Candidate& candidate) const {
  // A sphere that was a candidate when it was found is hidden if a surface in front of it was found
  // later.
  if (candidate.nearest > covered_) return false;
  if (distance_ == unreached) return true;
  const SphereTree::Sphere& visible = setup_.tree.sphere(visible_);
  const SphereTree::Sphere& other = setup_.tree.sphere(candidate.place);
  return other.centre != visible.centre || other.radius != visible.radius;
}

std::array<double, 4> SphereTracer::shaded(std::uint32_t place, double half) const {
  const scene::SphereShading& shading = setup_.scene.shading;
  const std::array<double, 3> colour = setup_.colour(setup_.tree.sphere(place).index);
  const double light = shading.ambient + shading.diffuse * half;
  return {colour[0] * light, colour[1] * light, colour[2] * light, 1.0};
}

// A prime marks a quantity of a device. The distance t' along the ray and half the chord h' are
// within the intervals that HitRange contains. The depth Z is t·cos α, where α is the angle between
// the ray and the view axis. A device's ray is rotated by φ, which changes α, too:
//   |cos α' − cos α| = 2·sin(φ/2)·|sin(α ± φ/2)| ≤ chord·(sin α + chord/2).
// The colour is linear in h.
void SphereTracer::bound_from_visible_sphere(const View& view, SpherePixel& pixel) const {
  const Passage ray = pass(view, visible_);
  const HitRange range = hit_range(ray, view.lateral);
  const double change =
      std::max(range.farthest - distance_, distance_ - range.nearest) * view.along;
  const double sine = std::sqrt(std::max(1 - view.along * view.along, 0.0));
  const double turn =
      view.lateral.chord * std::min(sine + 0.5 * view.lateral.chord, 1.0) * range.farthest;
  pixel.depth_bound = change + turn + setup_.model.depth_relative * (ray.distance + ray.radius);
  for (const double half : {range.half_lo, std::min(range.half_hi, ray.radius)}) {
    pixel.bound =
        std::max(pixel.bound, largest_difference(pixel.rgba, shaded(visible_, half / ray.radius)));
  }
}

void SphereTracer::bound_from_candidates(const View& view, SpherePixel& pixel) const {
  pixel.depth_bound = unreached;
  if (covered_ == unreached) {
    std::array<double, 4> background{};
    std::ranges::copy(setup_.scene.background, background.begin());
    pixel.bound = largest_difference(pixel.rgba, background);
  }
  for (const Candidate& candidate : candidates_) {
    if (candidate.nearest > covered_) continue;
    const Passage ray = pass(view, candidate.place);
    const HitRange range = hit_range(ray, view.margin);
    for (const double half : {range.half_lo, std::min(range.half_hi, ray.radius)}) {
      const auto other = shaded(candidate.place, half / ray.radius);
      pixel.bound = std::max(pixel.bound, largest_difference(pixel.rgba, other));
    }
  }
}

}  // namespace triptych::reference
