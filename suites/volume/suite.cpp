#include "suites/volume/suite.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "measure/contract/factor.hpp"
#include "measure/contract/pixel_history.hpp"
#include "reference/open_counts.hpp"
#include "reference/volume.hpp"
#include "scene/denormals.hpp"
#include "scene/file_table.hpp"
#include "scene/find_file.hpp"
#include "scene/generators.hpp"
#include "scene/raw_spec.hpp"
#include "suites/volume/analytic_data.hpp"
#include "suites/volume/factors.hpp"
#include "suites/volume/frame_description.hpp"
#include "suites/volume/loaded_data.hpp"
#include "suites/volume/own_levels.hpp"
#include "suites/volume/pixel_history.hpp"
#include "suites/volume/plain_work.hpp"
#include "suites/volume/storage_error.hpp"
#include "suites/volume/stress_cases.hpp"
#include "suites/volume/tolerance.hpp"
#include "technique/volume/bricks.hpp"
#include "triptych_suite_volume_embedded.hpp"

namespace triptych::volume_suite {
namespace {

using measure::Configuration;

class VolumeSuite final : public measure::SuiteWithTruth, public measure::RayReference {
 public:
  explicit VolumeSuite(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  std::string_view name() const override { return "volume"; }
  const std::vector<measure::Factor>& factors() const override { return volume_factors(); }
  void check(const measure::Factor& factor, std::string_view value) const override {
    check_value(factor, value, folders_);
  }
  std::vector<scene::GeneratorInfo> generators() const override {
    return scene::volume_generators();
  }

  std::vector<std::string_view> plan_names() const override;
  std::string_view plan_text(std::string_view plan) const override;
  std::string missing_data(const Configuration& configuration) const override;
  measure::Work work(Configuration& configuration, const measure::Device& device) override;
  measure::PlainWork plain(const Configuration& configuration,
                           const measure::Work& work) const override {
    return plain_work(configuration, std::get<measure::VolumeWork>(work.scene));
  }
  measure::Work calibration(technique::Work kind) override;
  accuracy::TruthPair truth(const Configuration& configuration,
                            const std::map<std::string, double>& precision) override;
  std::string truth_key(const Configuration& configuration,
                        const std::map<std::string, double>& precision) override;
  nlohmann::json describe(const Configuration& configuration) override;
  std::vector<std::string> describe_data(const Configuration& configuration) override {
    return data_.describe(configuration);
  }
  std::string data_hash(const Configuration& configuration) override;
  std::string limit_key(const Configuration& configuration) override;
  std::map<std::string, double> open_counts(
      const Configuration& configuration, const std::map<std::string, double>& precision) override;
  measure::Limit limit(const Configuration& configuration) override;
  std::optional<core::Image> closed_form(const Configuration& configuration) override;
  std::vector<record::Expectation> expectations(const Configuration& configuration) override;
  accuracy::ExpectedRay expected_ray(const Configuration& configuration,
                                     const std::map<std::string, double>& precision, int x,
                                     int y) override;

 private:
  // The input of the reference renderer: the scene, and the errors that a device may make when it
  // draws the scene.
  struct Judged {
    scene::VolumeScene scene;
    reference::ErrorModel model;
  };

  const LoadedData& load(const Configuration& configuration, const ChooseFormat& choose) {
    return data_.load(configuration, choose, [&](const std::string& note) {
      report_loading({.what = configuration.at("data"), .share = 1, .note = note});
    });
  }
  const LoadedData& load_native(const Configuration& configuration) {
    return load(configuration, [](scene::VoxelFormat native, const auto&) { return native; });
  }
  scene::VolumeScene scene(const Configuration& configuration, const LoadedData& loaded) const;
  Judged judged(const Configuration& configuration, const std::map<std::string, double>& precision);
  // Returns a function that reports the progress of rendering an image of the configuration.
  [[nodiscard]] reference::OnRows reporting(measure::Rendering::Image image,
                                            const Configuration& configuration) const {
    return [this, image, viewport = configuration.at("viewport")](double share) {
      report_rendering({.image = image, .viewport = viewport, .share = share});
    };
  }

  std::vector<std::filesystem::path> folders_;
  DataLoader data_{folders_};
};

std::vector<std::string_view> VolumeSuite::plan_names() const {
  std::vector<std::string_view> names;
  for (const std::string_view file : embedded_names())
    names.push_back(file.substr(0, file.rfind('.')));
  return names;
}

std::string_view VolumeSuite::plan_text(std::string_view plan) const {
  return embedded(std::string(plan) + ".yaml");
}

std::string VolumeSuite::missing_data(const Configuration& configuration) const {
  const std::string& data = configuration.at("data");
  if (analytic_data(data) || stress_data(data) || scene::is_present(data, folders_)) return {};
  const auto raw = scene::parse_raw_spec(data);
  return scene::not_found_text(data, raw ? raw->file : data, folders_, "volumes");
}

// Resolves the levels `own` of a configuration whose data have been loaded.
OwnLevels levels_of(const Configuration& configuration, const std::optional<StressScene>& stress) {
  return {configuration, stress ? &*stress : nullptr};
}

scene::VolumeScene VolumeSuite::scene(const Configuration& configuration,
                                      const LoadedData& loaded) const {
  const OwnLevels levels = levels_of(configuration, loaded.stress);
  const auto [width, height] = levels.viewport();
  scene::TransferFunction function = scene::without_denormals(levels.transfer_function(folders_));
  if (const std::string note = loaded.empty_image_note(function); !note.empty()) {
    report_loading({.what = loaded.data, .share = 1, .note = note});
  }
  return {
      .grid = loaded.grid,
      .transfer_function = std::move(function),
      .camera = levels.camera(scene::bounding_box(*loaded.grid)),
      .width = width,
      .height = height,
      .step_voxels = levels.step(),
      .quadrature = levels.quadrature(),
      .shading = {.enabled = levels.shaded()},
      .background = levels.background(),
  };
}

// Returns the memory budget for voxels in bytes, or 0 if there is none.
std::uint64_t budget_of(const measure::Configuration& configuration) {
  if (configuration.at("budget") == no_budget) return 0;
  return static_cast<std::uint64_t>(measure::as_number(configuration, "budget") * (1U << 20U));
}

// Returns the voxel format and the sampler that the device uses by default, but without the
// hardware sampler in three cases. With precision=fp64, a hardware sampler would not interpolate in
// double precision; in addition, integers are not stored as floats, because that would round them.
// quadrature=cells needs no sampler. In a volume that is drawn in parts, a hardware sampler would
// round differently than in the whole volume.
measure::VolumePath default_path(const measure::Device& device, measure::VolumeKind volume,
                                 const measure::Configuration& configuration,
                                 scene::Quadrature quadrature) {
  const bool avoids_hardware_sampler =
      technique::precision(configuration.at("precision")) == technique::Precision::fp64 ||
      quadrature == scene::Quadrature::cells || budget_of(configuration) > 0;
  if (avoids_hardware_sampler) volume.filter_suffices = false;
  const measure::VolumePath path = device.default_path(volume);
  if (avoids_hardware_sampler && path.sampler == technique::Sampler::hardware) {
    return {volume.native, technique::Sampler::manual};
  }
  return path;
}

measure::Work VolumeSuite::work(Configuration& configuration, const measure::Device& device) {
  const scene::Quadrature quadrature = levels_of(configuration, {}).quadrature();
  std::optional<technique::Sampler> named;
  if (configuration.at("sampler") != "auto") {
    named = technique::sampler(configuration.at("sampler"));
  }
  measure::VolumePath path;
  const auto choose = [&](scene::VoxelFormat native, const std::array<int, 3>& size) {
    path = default_path(device, {native, size, named, configuration.at("shading") == "none"},
                        configuration, quadrature);
    if (configuration.at("voxel") != "auto")
      path.voxel = scene::voxel_format(configuration.at("voxel"));
    return path.voxel;
  };
  const LoadedData& loaded = load(configuration, choose);
  choose(loaded.native, loaded.grid->size);
  path.sampler = named.value_or(path.sampler);
  configuration["voxel"] = scene::name_of(path.voxel);
  configuration["sampler"] = technique::name_of(path.sampler);
  return {.technique = configuration.at("technique"),
          .scene = measure::VolumeWork{
              .scene = scene(configuration, loaded),
              .options = {.sampler = path.sampler,
                          .skip = technique::skip(configuration.at("skip")),
                          .ert = levels_of(configuration, loaded.stress).ert(),
                          .adapt = levels_of(configuration, loaded.stress).adapt(),
                          .precision = technique::precision(configuration.at("precision")),
                          .budget = budget_of(configuration)}}};
}

measure::Work VolumeSuite::calibration(technique::Work kind) {
  // A scene without empty space and with many samples per ray. Drawing it takes milliseconds on a
  // software device, and does not take minutes even on a very slow device. The calibration repeats
  // the frame if it is too short.
  scene::Volume volume = scene::generate_volume("uniform_box", {32, 32, 32});
  scene::VolumeScene scene{
      .grid = std::make_shared<const scene::VoxelGrid>(
          scene::encode(std::move(volume), scene::VoxelFormat::f32)),
      .transfer_function = scene::load_transfer_function("haze"),
      .width = 64,
      .height = 64,
      .step_voxels = 0.125,
  };
  scene.camera = scene::camera_at("orbit_y:1/8", scene.box(), 60);
  return {.technique = kind == technique::Work::draw ? "raycast_fragment" : "raycast",
          .scene = measure::VolumeWork{
              .scene = std::move(scene),
              .options = {
                  .sampler = technique::Sampler::manual, .skip = technique::Skip::none, .ert = 0}}};
}

VolumeSuite::Judged VolumeSuite::judged(const Configuration& configuration,
                                        const std::map<std::string, double>& precision) {
  const LoadedData& loaded = load_native(configuration);
  scene::VolumeScene drawn = scene(configuration, loaded);
  const auto probed = precision.find("filter_weight_error");
  const technique::Precision computed = technique::precision(configuration.at("precision"));
  const StorageError stored =
      storage_error(configuration.at("voxel"), loaded.native, loaded.fits_halves, computed);
  const reference::ErrorModel model =
      error_model(drawn, {.ert = levels_of(configuration, loaded.stress).ert(),
                          .adapt = levels_of(configuration, loaded.stress).adapt(),
                          .filter_weight_error = probed == precision.end() ? 0 : probed->second,
                          .storage_step = stored.step,
                          .voxel_rounding = stored.rounding,
                          .precision = computed});
  return {std::move(drawn), model};
}

accuracy::TruthPair VolumeSuite::truth(const Configuration& configuration,
                                       const std::map<std::string, double>& precision) {
  const auto [drawn, model] = judged(configuration, precision);
  const reference::Truth truth = reference::render_volume(
      drawn, model, 0, reporting(measure::Rendering::Image::reference, configuration));
  return {.truth = truth.image(), .bound = truth.bound_image()};
}

std::map<std::string, double> VolumeSuite::open_counts(
    const Configuration& configuration, const std::map<std::string, double>& precision) {
  const auto [drawn, model] = judged(configuration, precision);
  reference::BrickPlanes planes;
  if (const technique::Skip skip = technique::skip(configuration.at("skip"));
      skip != technique::Skip::none) {
    const technique::BrickLayout layout = technique::brick_layout(drawn, skip, model.adapt);
    planes = {.edge = layout.edge, .origin = layout.is_cell_aligned ? 0.5 : 0.0};
  }
  return reference::open_counts(drawn, model, planes);
}

accuracy::ExpectedRay VolumeSuite::expected_ray(const Configuration& configuration,
                                                const std::map<std::string, double>& precision,
                                                int x, int y) {
  const auto [drawn, model] = judged(configuration, precision);
  return pixel_history(drawn, model, x, y);
}

// Returns the part of an image's key that contains the hash of the transfer function's file. It is
// necessary because the factor contains only the name of the file.
std::string table_text(const Configuration& configuration,
                       const scene::TransferFunction& function) {
  if (configuration.at("transfer_function") == own_level) return {};
  const std::string hash = scene::file_table_hash(function);
  return hash.empty() ? hash : " table " + hash;
}

std::string VolumeSuite::truth_key(const Configuration& configuration,
                                   const std::map<std::string, double>& precision) {
  const auto [drawn, model] = judged(configuration, precision);
  const std::string model_hash = core::HashBuilder("volume error model")
                                     .add(model.position_error_voxels)
                                     .add(model.value_error)
                                     .add(model.voxel_rounding)
                                     .add(model.filter_weight_error)
                                     .add(model.table_error)
                                     .add(model.opacity_error)
                                     .add(model.compositing_error)
                                     .add(model.ert)
                                     .add(model.adapt)
                                     .add(model.output_error)
                                     .hash();
  std::string key = fmt::format("reference {} data {} model {}", reference::volume_version,
                                drawn.grid->hash, model_hash);
  // The properties of a stress case's frame (such as its own camera) are added to the key, because
  // they are not levels of factors.
  if (stress_data(configuration.at("data"))) {
    key += " frame " + core::json_hash(describe_frame(drawn, model.ert, model.adapt));
  }
  return key + table_text(configuration, drawn.transfer_function);
}

std::string VolumeSuite::data_hash(const Configuration& configuration) {
  const auto choose = [&](scene::VoxelFormat native, const auto&) {
    const std::string& voxel = configuration.at("voxel");
    return voxel == "auto" ? native : scene::voxel_format(voxel);
  };
  return load(configuration, choose).grid->hash;
}

nlohmann::json VolumeSuite::describe(const Configuration& configuration) {
  const LoadedData& loaded = load_native(configuration);
  return describe_frame(scene(configuration, loaded), levels_of(configuration, loaded.stress).ert(),
                        levels_of(configuration, loaded.stress).adapt());
}

std::vector<record::Expectation> VolumeSuite::expectations(const Configuration& configuration) {
  std::vector<record::Expectation> result;
  const auto& stress = load_native(configuration).stress;
  if (!stress) return result;
  result = stress->expectations;
  if (configuration.at("skip") == "none") return result;
  result.insert(result.end(), stress->when_skipping.begin(), stress->when_skipping.end());
  if (configuration.at("skip") == "distance") {
    result.insert(result.end(), stress->when_leaping.begin(), stress->when_leaping.end());
  }
  // If samples are merged (factor `adapt`), the images are close but not bit-identical.
  if (levels_of(configuration, stress).adapt() > 0) return result;
  result.push_back({"an image that is bit-identical to the image without skipping",
                    record::SameImage{.changed = {{"skip", "none"}}}});
  return result;
}

// The step is not part of the key, because the limit is the image for a step that tends to zero.
std::string VolumeSuite::limit_key(const Configuration& configuration) {
  if (stress_data(configuration.at("data"))) return {};
  const LoadedData& loaded = load_native(configuration);
  const scene::TransferFunction function =
      levels_of(configuration, loaded.stress).transfer_function(folders_);
  return fmt::format(
      "converged {} data {} {}, transfer_function {}, shading {}, camera {}, "
      "viewport {}{}",
      reference::converged_version, configuration.at("data"), loaded.grid->hash,
      configuration.at("transfer_function"), configuration.at("shading"),
      configuration.at("camera"), configuration.at("viewport"),
      table_text(configuration, function));
}

measure::Limit VolumeSuite::limit(const Configuration& configuration) {
  // The largest error with which the limit is computed. It does not exceed the rounding error of a
  // float image with values up to 1.
  constexpr double tolerance = 0x1.0p-24;
  const reference::Truth truth = reference::render_volume_converged(
      scene(configuration, load_native(configuration)), tolerance, 0,
      reporting(measure::Rendering::Image::limit, configuration));
  return {.image = truth.image(), .uncertainty = truth.bound_image()};
}

std::optional<core::Image> VolumeSuite::closed_form(const Configuration& configuration) {
  const auto analytic = analytic_data(configuration.at("data"));
  const bool has_own_function = configuration.at("transfer_function") == own_transfer_function;
  const bool mapped =
      configuration.at("window") != "full" || configuration.at("mapping") != "linear";
  if (!analytic || !has_own_function || mapped) return std::nullopt;
  const scene::VolumeScene drawn = scene(configuration, load_native(configuration));
  if (drawn.shading.enabled != reference::is_shaded(analytic->problem)) return std::nullopt;
  return analytic_image(*analytic, drawn);
}

}  // namespace

std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders) {
  return std::make_unique<VolumeSuite>(std::move(data_folders));
}

}  // namespace triptych::volume_suite
