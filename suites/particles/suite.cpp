#include "suites/particles/suite.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/json.hpp"
#include "measure/factor.hpp"
#include "reference/spheres.hpp"
#include "suites/particles/factors.hpp"
#include "suites/particles/tolerance.hpp"
#include "triptych_suite_particles_embedded.hpp"

namespace triptych::particles_suite {
namespace {

using measure::as_number;
using measure::Configuration;

class ParticleSuite final : public measure::SuiteWithTruth {
 public:
  explicit ParticleSuite(std::vector<std::filesystem::path> folders)
      : folders_(std::move(folders)) {}

  std::string_view name() const override { return "particles"; }
  const std::vector<measure::Factor>& factors() const override { return particle_factors(); }
  void check(const measure::Factor& factor, std::string_view value) const override {
    check_value(factor, value, folders_);
  }

  std::vector<std::string_view> plan_names() const override;
  std::string_view plan_text(std::string_view plan) const override;
  std::string missing_data(const Configuration& configuration) const override;
  measure::Work work(Configuration& configuration, const measure::Device& device) override;
  measure::Work calibration(technique::Work kind) override;
  measure::Truth truth(const Configuration& configuration,
                       const std::map<std::string, double>& precision) override;
  std::string truth_key(const Configuration& configuration,
                        const std::map<std::string, double>& precision) override;
  nlohmann::json describe(const Configuration& configuration) override;
  std::string limit_key(const Configuration& configuration) override;
  measure::Limit limit(const Configuration& configuration) override;

 private:
  [[nodiscard]] scene::ParticleScene scene(const Configuration& configuration);

  std::vector<std::filesystem::path> folders_;
  // The last set loaded: neighbours in a plan share it.
  std::string loaded_;
  std::shared_ptr<const scene::ParticleSet> particles_;
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
  if (scene::particles_present(data, folders_)) return {};
  return fmt::format(
      "data file '{}' is not here; set TRIPTYCH_DATA to the folder that holds particles/", data);
}

scene::ParticleScene ParticleSuite::scene(const Configuration& configuration) {
  const std::string wanted = configuration.at("colour") + " " + configuration.at("data");
  if (loaded_ != wanted) {
    particles_.reset();  // frees the old set before the new one is loaded
    const std::string& data = configuration.at("data");
    tell({.what = data, .share = 0});
    particles_ = std::make_shared<const scene::ParticleSet>(
        scene::load_particles(data, scene::colour_kind(configuration.at("colour")), folders_,
                              [&](double share) { tell({.what = data, .share = share}); }));
    tell({.what = data, .share = 1});
    loaded_ = wanted;
  }
  const auto [width, height] = measure::parse_viewport(configuration.at("viewport"));
  return {
      .particles = particles_,
      .intensity_colours =
          scene::load_transfer_function(configuration.at("transfer_function"), folders_),
      .camera = scene::particle_camera(configuration.at("camera"), *particles_,
                                       as_number(configuration, "fov")),
      .width = width,
      .height = height,
      .radius_scale = as_number(configuration, "radius_scale"),
  };
}

measure::Work ParticleSuite::work(Configuration& configuration, const measure::Device&) {
  return {.technique = configuration.at("technique"),
          .scene = measure::ParticleWork{
              .scene = scene(configuration),
              .options = {
                  .transfer = technique::computed_at(configuration.at("transfer")),
                  .ray = technique::computed_at(configuration.at("ray")),
                  .conservative_depth = configuration.at("conservative_depth") == "on",
                  .corners = static_cast<int>(as_number(configuration, "corners")),
                  .culling = technique::culling(configuration.at("culling")),
              }}};
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

measure::Truth ParticleSuite::truth(const Configuration& configuration,
                                    const std::map<std::string, double>&) {
  const scene::ParticleScene pictured = scene(configuration);
  const reference::SphereTruth truth = reference::render_spheres(
      pictured, error_model(pictured, technique::computed_at(configuration.at("ray"))));
  return {.image = truth.image(), .bound = truth.bound_image()};
}

std::string ParticleSuite::truth_key(const Configuration& configuration,
                                     const std::map<std::string, double>&) {
  const scene::ParticleScene pictured = scene(configuration);
  const reference::SphereErrorModel model =
      error_model(pictured, technique::computed_at(configuration.at("ray")));
  return fmt::format("spheres {} data {} model {:a} {:a} {:a} {:a} {:a}",
                     reference::spheres_version, pictured.particles->hash, model.margin_px,
                     model.lateral_px, model.lateral_relative, model.depth_relative,
                     model.colour_relative);
}

nlohmann::json ParticleSuite::describe(const Configuration& configuration) {
  const scene::ParticleScene pictured = scene(configuration);
  const scene::ParticleSet& set = *pictured.particles;
  return {{"viewport", {pictured.width, pictured.height}},
          {"camera", measure::camera_json(pictured.camera)},
          {"particles",
           {{"count", set.count()},
            {"dropped", set.dropped},
            {"radius_scale", pictured.radius_scale},
            {"shading",
             {{"model", "headlight"},
              {"ambient", pictured.shading.ambient},
              {"diffuse", pictured.shading.diffuse}}},
            {"background", pictured.background}}}};
}

std::string ParticleSuite::limit_key(const Configuration& configuration) {
  return fmt::format(
      "spheres {} data {} {}, colour {}, transfer_function {}, radius_scale {}, camera {}, fov {}, "
      "viewport {}",
      reference::spheres_version, configuration.at("data"), scene(configuration).particles->hash,
      configuration.at("colour"), configuration.at("transfer_function"),
      configuration.at("radius_scale"), configuration.at("camera"), configuration.at("fov"),
      configuration.at("viewport"));
}

// A pixel shows what the ray through its centre meets: there is nothing to refine, and the truth in
// double precision is the limit itself.
measure::Limit ParticleSuite::limit(const Configuration& configuration) {
  core::Image image = reference::render_spheres(scene(configuration)).image();
  core::Image none(image.width, image.height);
  return {.image = std::move(image), .uncertainty = std::move(none)};
}

}  // namespace

std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders) {
  return std::make_unique<ParticleSuite>(std::move(data_folders));
}

}  // namespace triptych::particles_suite
