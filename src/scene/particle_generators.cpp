#include "scene/particle_generators.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/exact_math.hpp"
#include "scene/particle_colours.hpp"
#include "scene/progress_steps.hpp"

namespace triptych::scene {
namespace {

constexpr std::uint64_t largest_count = 20'000'000;
constexpr std::uint64_t place_seed = 0x7472697074796368;
constexpr std::uint64_t colour_seed = 0x636F6C6F75727321;

double cube_root(double x) {
  return exponential(logarithm(x) / 3);
}

// Returns the radius at which the volumes of `count` equal spheres add up to `filling` times
// `volume`. Volume that spheres share is counted once per sphere.
double filling_radius(double filling, double volume, double count) {
  return cube_root(filling * volume / count * 3 / (4 * std::numbers::pi));
}

double ball_volume(double radius) {
  return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

// Returns a random position in the unit ball. Rejection sampling is used because it needs only
// exactly rounded operations.
glm::dvec3 place_in_ball(core::Random& random) {
  for (;;) {
    glm::dvec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = random.uniform(-1, 1);
    if (glm::dot(place, place) <= 1) return place;
  }
}

glm::dvec3 place_in_box(core::Random& random, const Box& box) {
  glm::dvec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = random.uniform(box.lo[axis], box.hi[axis]);
  return place;
}

// A set that is being generated. Colours use their own random sequence, so that positions do not
// depend on the colour format.
class Maker {
 public:
  Maker(std::uint64_t count, ColourKind colour, const Progress& progress)
      : count_(count), progress_(progress, count) {
    set_.colour = colour;
    reserve(set_, count);
  }

  // Makes the intensity rise from 0 to 1 along `axis` of the box.
  void colour_along(int axis, const Box& box) {
    axis_ = axis;
    box_ = box;
  }

  void add(const glm::dvec3& centre, double radius) {
    const auto index = static_cast<std::uint32_t>(set_.count());
    if (!append(set_, {centre.x, centre.y, centre.z, radius}, index)) return;
    const double hue = colours_.uniform();
    append_colour(set_, hue_colour(hue),
                  (centre[axis_] - box_.lo[axis_]) / (box_.hi[axis_] - box_.lo[axis_]));
    progress_.advance_to(set_.count());
  }

  [[nodiscard]] core::Random& random() { return random_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t left() const { return count_ - set_.count(); }
  [[nodiscard]] ParticleSet take() { return std::move(set_); }

 private:
  std::uint64_t count_;
  ParticleSet set_;
  core::Random random_{place_seed};
  core::Random colours_{colour_seed};
  ProgressSteps progress_;
  int axis_ = 0;
  Box box_;
};

constexpr double filling_of_paper = 0.1;
const Box cube{glm::dvec3(0), glm::dvec3(10)};
constexpr double cube_volume = 1000;

void uniform(Maker& maker) {
  maker.colour_along(2, cube);
  const double radius =
      filling_radius(filling_of_paper, cube_volume, static_cast<double>(maker.count()));
  while (maker.left() > 0) maker.add(place_in_box(maker.random(), cube), radius);
}

// The spheres of a liquid fill half of the liquid's volume, which is close to the density at which
// a hard-sphere liquid freezes.
constexpr double liquid_filling = 0.5;

struct Ball {
  glm::dvec3 centre;
  double radius;
};

void droplets(Maker& maker) {
  static constexpr double in_droplets = 0.95;
  const Box box{glm::dvec3(0), glm::dvec3(20, 10, 10)};
  const std::array<Ball, 3> balls{{{{5, 5, 5}, 3}, {{12, 3.5, 6}, 2}, {{16.5, 7, 4}, 1.5}}};
  double liquid = 0;
  for (const Ball& ball : balls) liquid += ball_volume(ball.radius);
  const double radius =
      filling_radius(liquid_filling, liquid, in_droplets * static_cast<double>(maker.count()));
  maker.colour_along(0, box);
  const auto in_ball = [](const glm::dvec3& place, const Ball& ball) {
    const glm::dvec3 offset = place - ball.centre;
    return glm::dot(offset, offset) <= ball.radius * ball.radius;
  };
  core::Random& random = maker.random();
  while (maker.left() > 0) {
    if (random.uniform() < in_droplets) {
      double share = random.uniform() * liquid;
      std::size_t chosen = 0;
      while (chosen + 1 < balls.size() && share >= ball_volume(balls.at(chosen).radius)) {
        share -= ball_volume(balls.at(chosen++).radius);
      }
      const Ball& ball = balls.at(chosen);
      maker.add(ball.centre + ball.radius * place_in_ball(random), radius);
    } else {
      glm::dvec3 place = place_in_box(random, box);
      while (std::ranges::any_of(balls, [&](const Ball& ball) { return in_ball(place, ball); })) {
        place = place_in_box(random, box);
      }
      maker.add(place, radius);
    }
  }
}

void layer(Maker& maker) {
  static constexpr double in_liquid = 0.95;
  static constexpr double thickness = 8;
  static constexpr double interface = 0.4;  // thickness of the transition between liquid and vapour
  const Box box{glm::dvec3(0), glm::dvec3(5, 5, 40)};
  maker.colour_along(2, box);
  const double middle = box.hi.z / 2;
  const double volume = box.hi.x * box.hi.y * thickness;
  const double radius =
      filling_radius(liquid_filling, volume, in_liquid * static_cast<double>(maker.count()));
  core::Random& random = maker.random();
  while (maker.left() > 0) {
    glm::dvec3 place = place_in_box(random, box);
    if (random.uniform() < in_liquid) {
      place.z = middle + random.uniform(-thickness / 2, thickness / 2);
      place.z += random.uniform(-interface, interface);
    } else {
      while (std::abs(place.z - middle) < thickness / 2) place = place_in_box(random, box);
    }
    maker.add(place, radius);
  }
}

// The slab below the plume. Its upper face is at y = 0. The crater is a hemisphere that is cut out
// of this face.
struct Slab {
  double half_side = 10;
  double depth = 5;
  double crater = 4;

  [[nodiscard]] double volume() const {
    return 4 * half_side * half_side * depth - ball_volume(crater) / 2;
  }
};

// Adds spheres at the sites of a cubic lattice. Adjacent spheres touch, so that many depths are
// exactly equal.
void add_lattice(Maker& maker, const Slab& slab, double spacing) {
  const auto across =
      static_cast<std::uint64_t>(std::max(1.0, std::floor(2 * slab.half_side / spacing)));
  const auto down = static_cast<std::uint64_t>(std::max(1.0, std::floor(slab.depth / spacing)));
  const double begin = -spacing * static_cast<double>(across - 1) / 2;
  for (std::uint64_t j = 0; j < down; ++j) {
    for (std::uint64_t k = 0; k < across; ++k) {
      for (std::uint64_t i = 0; i < across; ++i) {
        const glm::dvec3 site(begin + static_cast<double>(i) * spacing,
                              -(static_cast<double>(j) + 0.5) * spacing,
                              begin + static_cast<double>(k) * spacing);
        if (glm::dot(site, site) < slab.crater * slab.crater) continue;
        if (maker.left() == 0) return;
        maker.add(site, spacing / 2);
      }
    }
  }
}

// Returns a random position in a cone that opens upwards from the crater. The random number is
// squared, so that low positions are more likely.
glm::dvec3 place_in_plume(core::Random& random, const Slab& slab, double height) {
  const double u = random.uniform();
  const double h = height * u * u;
  glm::dvec3 place = place_in_ball(random);
  const double spread = slab.crater / 2 + h / 2;
  return {place.x * spread, h, place.z * spread};
}

void plume(Maker& maker) {
  static constexpr double in_slab = 0.6;
  static constexpr double height = 25;
  static constexpr double clustered = 0.1;  // probability that a position gets a cluster
  static constexpr std::uint64_t largest_cluster = 32;
  const Slab slab;
  maker.colour_along(1, {{-10, -slab.depth, -10}, {10, height, 10}});
  const double spacing =
      cube_root(slab.volume() / std::max(1.0, in_slab * static_cast<double>(maker.count())));
  add_lattice(maker, slab, spacing);
  core::Random& random = maker.random();
  while (maker.left() > 0) {
    const glm::dvec3 place = place_in_plume(random, slab, height);
    if (random.uniform() >= clustered) {
      maker.add(place, spacing / 2);
      continue;
    }
    const std::uint64_t size = std::min(maker.left(), 2 + random.bits() % (largest_cluster - 1));
    const double radius = spacing / 2 * random.uniform(1, 2);
    const double extent = radius * cube_root(static_cast<double>(size));
    for (std::uint64_t i = 0; i < size; ++i) {
      maker.add(place + extent * place_in_ball(random), radius);
    }
  }
}

void coincident(Maker& maker) {
  static constexpr std::uint64_t copies = 8;
  const std::uint64_t places = (maker.count() + copies - 1) / copies;
  maker.colour_along(2, cube);
  const double radius = filling_radius(filling_of_paper, cube_volume, static_cast<double>(places));
  // Each copy restarts the same random sequence, so that particles at the same position are far
  // apart in the set.
  for (std::uint64_t copy = 0; copy < copies; ++copy) {
    core::Random random(place_seed);
    for (std::uint64_t i = 0; i < places && maker.left() > 0; ++i) {
      maker.add(place_in_box(random, cube), radius);
    }
  }
}

// Creates a wall across the front of the cube, as seen from +z, and hidden spheres behind it. The
// wall is a lattice of squares with a sphere in the middle of each square. It has no gaps: in its
// plane, each sphere extends beyond the corners of its square, so no ray passes through. The wall
// consists of about `wall_count` spheres in complete rows. The very last sphere touches the back of
// the cube. Sets with equal walls therefore have equal bounding boxes, and the same cameras apply
// to them.
void add_wall_and_hidden(Maker& maker, std::uint64_t wall_count) {
  static constexpr double reach =
      0.75;  // radius / edge of a square; the corners of a square are √½ edges from its middle
  maker.colour_along(2, cube);
  const auto rows = wall_count > 1
                        ? static_cast<std::uint64_t>(std::sqrt(static_cast<double>(wall_count - 1)))
                        : 0;
  const double spacing = cube.hi.x / static_cast<double>(std::max<std::uint64_t>(rows, 1));
  const double radius = reach * spacing;
  for (std::uint64_t j = 0; j < rows; ++j) {
    for (std::uint64_t i = 0; i < rows; ++i) {
      maker.add({(static_cast<double>(i) + 0.5) * spacing, (static_cast<double>(j) + 0.5) * spacing,
                 cube.hi.z - radius},
                radius);
    }
  }
  const auto rest = static_cast<double>(maker.left());
  const double small = rest > 1 ? filling_radius(filling_of_paper, cube_volume, rest) : radius;
  // The hidden spheres are behind the plane of the wall and within its sides. If there are only a
  // few, they would be too large to fit there, so their radius is limited.
  const double hidden_radius = std::min(small, 0.05 * cube.hi.x);
  const Box behind{
      cube.lo + hidden_radius,
      {cube.hi.x - hidden_radius, cube.hi.y - hidden_radius, cube.hi.z - radius - hidden_radius}};
  while (maker.left() > 1) maker.add(place_in_box(maker.random(), behind), hidden_radius);
  maker.add({5, 5, std::min(radius, 5.0)}, std::min(radius, 5.0));
}

void wall(Maker& maker) {
  add_wall_and_hidden(maker, maker.count());
}

void hidden(Maker& maker) {
  add_wall_and_hidden(maker, maker.count() / 10);
}

struct Generator {
  GeneratorInfo info;
  void (*make)(Maker&);
};

constexpr std::array<Generator, 7> generators{{
    {{"uniform", "uniformly distributed spheres of equal radius that fill a tenth of a box"},
     uniform},
    {{"droplets", "three dense droplets in thin vapour"}, droplets},
    {{"layer", "a liquid layer across a long box, with vapour on both sides"}, layer},
    {{"plume", "a lattice slab with a crater and an expanding cone of clusters above it"}, plume},
    {{"coincident",
      "eight particles of different colours at every position, so that their depths "
      "are equal"},
     coincident},
    {{"wall", "a wall without gaps, completely visible from +z"}, wall},
    {{"hidden", "a wall made of a tenth of the particles, which hides all other particles"},
     hidden},
}};

// Throws InputError for an unknown name or an unsupported count.
const Generator& generator_of(std::string_view name, std::uint64_t count) {
  const auto found = std::ranges::find(
      generators, name, [](const Generator& generator) { return generator.info.name; });
  if (found == generators.end()) {
    std::vector<std::string_view> names;
    for (const Generator& each : generators) names.push_back(each.info.name);
    throw core::InputError(fmt::format("unknown particle generator '{}'; expected one of {}", name,
                                       fmt::join(names, ", ")));
  }
  if (count < 1 || count > largest_count) {
    throw core::InputError(
        fmt::format("generate:{}:{}: expected a count from 1 to {}", name, count, largest_count));
  }
  return *found;
}

}  // namespace

std::vector<GeneratorInfo> particle_generators() {
  std::vector<GeneratorInfo> infos;
  infos.reserve(generators.size());
  for (const Generator& generator : generators) infos.push_back(generator.info);
  return infos;
}

void check_particle_generator(std::string_view name, std::uint64_t count) {
  static_cast<void>(generator_of(name, count));
}

ParticleSet generate_particles(std::string_view name, std::uint64_t count, ColourKind colour,
                               const Progress& progress) {
  const Generator& generator = generator_of(name, count);
  Maker maker(count, colour, progress);
  generator.make(maker);
  ParticleSet set = maker.take();
  set.name = fmt::format("generate:{}:{}", name, count);
  set.hash = particle_hash(set);
  if (progress) progress(1);
  return set;
}

}  // namespace triptych::scene
