#include "suites/particles/suite.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "measure/contract/factor.hpp"
#include "measure/contract/pixel_history.hpp"
#include "reference/sphere_pixel.hpp"
#include "reference/spheres.hpp"
#include "scene/data_summary.hpp"
#include "scene/file_table.hpp"
#include "scene/find_file.hpp"
#include "scene/particle_generators.hpp"
#include "scene/particle_subset.hpp"
#include "suites/particles/factors.hpp"
#include "suites/particles/grown_sprites.hpp"
#include "suites/particles/large_points.hpp"
#include "suites/particles/plain_work.hpp"
#include "suites/particles/stress_cases.hpp"
#include "suites/particles/tolerance.hpp"
#include "technique/particles/margins.hpp"
#include "triptych_suite_particles_embedded.hpp"

namespace triptych::particles_suite {
namespace {

using measure::as_number;
using measure::Configuration;

// Returns the error model for a device with this precision. A device that does not report its
// number of sub-pixel bits is assumed to have 8, like all devices seen so far.
reference::SphereErrorModel model_of(const scene::ParticleScene& scene,
                                     const Configuration& configuration,
                                     const std::map<std::string, double>& precision) {
  const technique::ComputedAt ray = technique::computed_at(configuration.at("ray"));
  const auto bits = precision.find("sub_pixel_bits");
  if (bits == precision.end()) return error_model(scene, ray);
  return error_model(scene, ray, static_cast<int>(bits->second));
}

class ParticleSuite final : public measure::SuiteWithTruth, public measure::SpriteReference {
 public:
  explicit ParticleSuite(std::vector<std::filesystem::path> folders)
      : folders_(std::move(folders)) {}

  std::string_view name() const override { return "particles"; }
  const std::vector<measure::Factor>& factors() const override { return particle_factors(); }
  void check(const measure::Factor& factor, std::string_view value) const override {
    check_value(factor, value, folders_);
  }
  std::vector<scene::GeneratorInfo> generators() const override {
    return scene::particle_generators();
  }

  std::vector<std::string_view> plan_names() const override;
  std::string_view plan_text(std::string_view plan) const override;
  std::string missing_data(const Configuration& configuration) const override;
  measure::Work work(Configuration& configuration, const measure::Device& device) override;
  measure::PlainWork plain(const Configuration& configuration,
                           const measure::Work& work) const override {
    return plain_work(configuration, std::get<measure::ParticleWork>(work.scene));
  }
  measure::Work calibration(technique::Work kind) override;
  accuracy::TruthPair truth(const Configuration& configuration,
                            const std::map<std::string, double>& precision) override;
  std::string truth_key(const Configuration& configuration,
                        const std::map<std::string, double>& precision) override;
  nlohmann::json describe(const Configuration& configuration) override;
  std::vector<std::string> describe_data(const Configuration& configuration) override {
    static_cast<void>(read(configuration));  // the summary contains the notes
    return scene::summary_of(*loaded_.particles);
  }
  std::string data_hash(const Configuration& configuration) override {
    load(configuration);
    return loaded_.particles->hash;
  }
  std::map<std::string, double> open_counts(
      const Configuration& configuration, const std::map<std::string, double>& precision) override;
  std::string limit_key(const Configuration& configuration) override;
  measure::Limit limit(const Configuration& configuration) override;
  std::vector<record::Expectation> expectations(const Configuration& configuration) override;
  std::vector<std::uint32_t> particles_near(const Configuration& configuration,
                                            const std::map<std::string, double>& precision, int x,
                                            int y) override;
  accuracy::ExpectedSurface expected_surface(const Configuration& configuration,
                                             const std::map<std::string, double>& precision,
                                             std::span<const std::uint32_t> particles, int x,
                                             int y) override;

 private:
  // The most recently loaded particle set, with the data that belong to it. It is cached because
  // successive configurations of a plan usually use the same set.
  struct Loaded {
    std::string key;
    std::shared_ptr<const scene::ParticleSet> particles;
    // The stress scene without its particles, which were moved to `particles`.
    std::optional<StressScene> stress;
  };

  // Reads the particles, unless they are already loaded. Returns whether it has read them.
  [[nodiscard]] bool read(const Configuration& configuration);
  // Like read(), but also reports the notes of the file reader.
  void load(const Configuration& configuration);
  // Returns the loaded stress scene, which has its own camera and viewport. Throws InputError if
  // other data are loaded.
  [[nodiscard]] const StressScene& own_values(std::string_view factor) const;
  [[nodiscard]] scene::Camera camera(const Configuration& configuration) const;
  [[nodiscard]] scene::ParticleScene scene(const Configuration& configuration);
  // Returns a string that identifies everything that affects the image except for the factors and
  // the particles.
  [[nodiscard]] std::string key_without_factors(const Configuration& configuration);

  std::vector<std::filesystem::path> folders_;
  Loaded loaded_;
};

std::vector<std::string_view> ParticleSuite::plan_names() const {
  std::vector<std::string_view> names;
  for (const std::string_view file : embedded_names())
    names.push_back(file.substr(0, file.rfind('.')));
  return names;
}

std::string_view ParticleSuite::plan_text(std::string_view plan) const {
  return embedded(std::string(plan) + ".yaml");
}

std::string ParticleSuite::missing_data(const Configuration& configuration) const {
  const std::string& data = configuration.at("data");
  if (stress_data(data) || scene::particles_present(data, folders_)) return {};
  return scene::not_found_text(data, data.substr(0, data.rfind('@')), folders_, "particles");
}

bool ParticleSuite::read(const Configuration& configuration) {
  const std::string wanted = configuration.at("colour") + " " + configuration.at("data");
  if (loaded_.key == wanted) return false;
  loaded_ = {};  // frees the old set before the new one is loaded
  const std::string& data = configuration.at("data");
  const scene::ColourKind colour = scene::colour_kind(configuration.at("colour"));
  report_loading({.what = data, .share = 0});
  if (const auto stress = stress_data(data)) {
    loaded_.stress = stress_scene(*stress, colour);
    loaded_.particles =
        std::make_shared<const scene::ParticleSet>(std::move(loaded_.stress->particles));
  } else {
    loaded_.particles = std::make_shared<const scene::ParticleSet>(scene::load_particles(
        data, colour, folders_,
        [&](double share) { report_loading({.what = data, .share = share}); }));
  }
  report_loading({.what = data, .share = 1});
  loaded_.key = wanted;
  return true;
}

void ParticleSuite::load(const Configuration& configuration) {
  if (!read(configuration)) return;
  for (const std::string& note : loaded_.particles->facts.notes) {
    report_loading({.what = configuration.at("data"), .share = 1, .note = note});
  }
}

const StressScene& ParticleSuite::own_values(std::string_view factor) const {
  if (loaded_.stress) return *loaded_.stress;
  throw core::InputError(fmt::format("{}: level 'own' requires data=stress:CASE, found data={}",
                                     factor, loaded_.particles->name));
}

scene::Camera ParticleSuite::camera(const Configuration& configuration) const {
  const bool own_fov = configuration.at("fov") == own_level;
  if (configuration.at("camera") != own_level) {
    return scene::particle_camera(
        configuration.at("camera"), *loaded_.particles,
        own_fov ? own_values("fov").camera.fov_y_deg : as_number(configuration, "fov"));
  }
  scene::Camera camera = own_values("camera").camera;
  if (!own_fov) camera.fov_y_deg = as_number(configuration, "fov");
  return camera;
}

scene::ParticleScene ParticleSuite::scene(const Configuration& configuration) {
  load(configuration);
  const bool own_viewport = configuration.at("viewport") == own_level;
  const auto [width, height] =
      own_viewport ? std::array{own_values("viewport").width, own_values("viewport").height}
                   : measure::parse_viewport(configuration.at("viewport"));
  return {
      .particles = loaded_.particles,
      .intensity_colours =
          scene::load_transfer_function(configuration.at("transfer_function"), folders_),
      .camera = camera(configuration),
      .width = width,
      .height = height,
      .radius_scale = as_number(configuration, "radius_scale"),
  };
}

measure::Work ParticleSuite::work(Configuration& configuration, const measure::Device&) {
  measure::ParticleWork work{
      .scene = scene(configuration),
      .options = {
          .transfer = technique::computed_at(configuration.at("transfer")),
          .ray = technique::computed_at(configuration.at("ray")),
          .conservative_depth = configuration.at("conservative_depth") == "on",
          .corners = static_cast<int>(as_number(configuration, "corners")),
          .culling = technique::culling(configuration.at("culling")),
          .structure = technique::structure(configuration.at("structure")),
      }};
  if (loaded_.stress && configuration.at("camera") == own_level) {
    work.camera_before = loaded_.stress->camera_before;
  }
  return {.technique = configuration.at("technique"), .scene = std::move(work)};
}

measure::Work ParticleSuite::calibration(technique::Work kind) {
  auto particles = std::make_shared<const scene::ParticleSet>(
      scene::load_particles("generate:uniform:2000", scene::ColourKind::rgba8));
  measure::ParticleWork work;
  work.scene.particles = particles;
  work.scene.camera = scene::particle_camera("orbit_y:1/8", *particles, 60);
  work.scene.width = 64;
  work.scene.height = 64;
  return {.technique = kind == technique::Work::draw ? "quad_instanced" : "tiles",
          .scene = std::move(work)};
}

accuracy::TruthPair ParticleSuite::truth(const Configuration& configuration,
                                         const std::map<std::string, double>& precision) {
  const scene::ParticleScene drawn = scene(configuration);
  const reference::SphereTruth truth =
      reference::render_spheres(drawn, model_of(drawn, configuration, precision));
  return {.truth = truth.image(), .bound = truth.bound_image()};
}

std::string ParticleSuite::truth_key(const Configuration& configuration,
                                     const std::map<std::string, double>& precision) {
  const scene::ParticleScene drawn = scene(configuration);
  const reference::SphereErrorModel model = model_of(drawn, configuration, precision);
  const std::string model_hash = core::HashBuilder("sphere error model")
                                     .add(model.margin_px)
                                     .add(model.lateral_px)
                                     .add(model.lateral_relative)
                                     .add(model.depth_relative)
                                     .add(model.colour_relative)
                                     .hash();
  return fmt::format("spheres {} data {} model {}{}", reference::spheres_version,
                     drawn.particles->hash, model_hash, key_without_factors(configuration));
}

// Counters may differ between devices for two reasons. A device with a limited point size draws
// larger sprites as quads. On a device that rounds vertex positions to a coarse grid, all sprites
// are made larger than on other devices (technique/particles/margins.hpp).
std::map<std::string, double> ParticleSuite::open_counts(
    const Configuration& configuration, const std::map<std::string, double>& precision) {
  std::map<std::string, double> open;
  if (const auto largest = precision.find("largest_point"); largest != precision.end()) {
    open = open_counts_of_quads(scene(configuration), largest->second,
                                configuration.at("culling") == "occlusion");
  }
  const auto bits = precision.find("sub_pixel_bits");
  if (bits == precision.end()) return open;
  const double growth = technique::sprite_growth(static_cast<int>(bits->second));
  if (growth <= 0) return open;
  const double grown = fragments_of_growth(scene(configuration), growth);
  for (const char* counter : {"fragments", "fragments_discarded"}) open[counter] += grown;
  return open;
}

std::string ParticleSuite::key_without_factors(const Configuration& configuration) {
  std::string text;
  const std::string table = scene::file_table_hash(scene(configuration).intensity_colours);
  if (!table.empty()) text += " table " + table;
  if (stress_data(configuration.at("data"))) {
    text += " frame " + core::json_hash(describe(configuration));
  }
  return text;
}

nlohmann::json ParticleSuite::describe(const Configuration& configuration) {
  const scene::ParticleScene drawn = scene(configuration);
  const scene::ParticleSet& set = *drawn.particles;
  return {{"viewport", {drawn.width, drawn.height}},
          {"camera", measure::camera_json(drawn.camera)},
          {"particles",
           {{"count", set.count()},
            {"dropped", set.dropped},
            {"radius_scale", drawn.radius_scale},
            {"shading",
             {{"model", "headlight"},
              {"ambient", drawn.shading.ambient},
              {"diffuse", drawn.shading.diffuse}}},
            {"background", drawn.background}}}};
}

std::string ParticleSuite::limit_key(const Configuration& configuration) {
  return fmt::format(
      "spheres {} data {} {}, colour {}, transfer_function {}, radius_scale {}, camera {}, fov {}, "
      "viewport {}{}",
      reference::spheres_version, configuration.at("data"), scene(configuration).particles->hash,
      configuration.at("colour"), configuration.at("transfer_function"),
      configuration.at("radius_scale"), configuration.at("camera"), configuration.at("fov"),
      configuration.at("viewport"), key_without_factors(configuration));
}

// A pixel shows the surface on the ray through its centre. There is no sampling that could be
// refined, so the reference image in double precision is already the limit.
measure::Limit ParticleSuite::limit(const Configuration& configuration) {
  core::Image image = reference::render_spheres(scene(configuration)).image();
  core::Image none(image.width, image.height);
  return {.image = std::move(image), .uncertainty = std::move(none)};
}

std::vector<record::Expectation> ParticleSuite::expectations(const Configuration& configuration) {
  const auto stress = stress_data(configuration.at("data"));
  return stress ? stress_expectations(*stress) : std::vector<record::Expectation>{};
}

std::vector<std::uint32_t> ParticleSuite::particles_near(
    const Configuration& configuration, const std::map<std::string, double>& precision, int x,
    int y) {
  const scene::ParticleScene drawn = scene(configuration);
  const reference::SphereErrorModel model = model_of(drawn, configuration, precision);
  const reference::SphereSetup setup(drawn, model);
  return reference::SphereTracer(setup).spheres_near(x, y);
}

accuracy::ExpectedSurface ParticleSuite::expected_surface(
    const Configuration& configuration, const std::map<std::string, double>& precision,
    std::span<const std::uint32_t> particles, int x, int y) {
  scene::ParticleScene drawn = scene(configuration);
  const reference::SphereErrorModel model = model_of(drawn, configuration, precision);
  drawn.particles = std::make_shared<const scene::ParticleSet>(
      scene::particle_subset(*drawn.particles, particles));
  const reference::SphereSetup setup(drawn, model);
  const reference::SpherePixel pixel = reference::SphereTracer(setup)(x, y);
  return {.id = pixel.id,
          .depth = pixel.depth,
          .depth_bound = pixel.depth_bound,
          .colour = pixel.rgba,
          .colour_bound = pixel.bound,
          .certain = pixel.certain};
}

}  // namespace

std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders) {
  return std::make_unique<ParticleSuite>(std::move(data_folders));
}

}  // namespace triptych::particles_suite
