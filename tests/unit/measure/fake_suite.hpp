#pragma once
// A small suite for tests of plans and runs, with factors of every kind. Only the null backend can
// draw its scenes.

#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

class FakeSuite final : public Suite {
 public:
  std::string_view name() const override { return "fake"; }

  const std::vector<Factor>& factors() const override { return factors_; }

  // Accepts any name except "nonsense" for `data`, and integers for `viewport`.
  void check(const Factor& factor, std::string_view value) const override {
    if (factor.name == "data" && value == "nonsense") {
      throw core::InputError("expected a file or generate:NAME:SIZE");
    }
    if (factor.name == "viewport" &&
        value.find_first_not_of("0123456789") != std::string_view::npos) {
      throw core::InputError("expected a size in pixels");
    }
  }

  std::vector<std::string_view> plan_names() const override { return {"quick", "broken"}; }

  std::string_view plan_text(std::string_view plan) const override {
    if (plan == "quick") {
      return "suite: fake\n"
             "technique: [raycast, raycast_fragment]\n"
             "data: [cube, ball]\n"
             "step: [0.5, 1.0]\n"
             "camera: [orbit_y:1/8, random:7]\n"
             "viewport: 8\n";
    }
    if (plan == "broken") return "suite: fake\nstep: [0.5\n";
    return {};
  }

  std::string missing_data(const Configuration& configuration) const override {
    return configuration.at("data") == "absent" ? "absent: no such file" : "";
  }

  // Loading the data "slow" takes long enough to be reported, "huge" needs more memory than the
  // machine has, and "torn" is a broken file.
  Work work(Configuration& configuration, const Device& device) override {
    if (configuration.at("data") == "huge") throw std::bad_alloc();
    if (configuration.at("data") == "torn") {
      throw core::InputError({.file = "torn", .line = 3}, "the file ends here");
    }
    if (configuration.at("data") == "slow") {
      report_loading({.what = "slow", .share = 0});
      std::this_thread::sleep_for(std::chrono::milliseconds(2100));
      report_loading({.what = "slow", .share = 0.5});
      report_loading({.what = "slow", .share = 1});
    }
    auto grid = std::make_shared<scene::VoxelGrid>();
    grid->name = configuration.at("data");
    grid->hash = core::content_hash(grid->name);
    grid->size = {2, 2, 2};
    grid->data.resize(8 * sizeof(float));
    VolumeWork volume;
    volume.scene.grid = std::move(grid);
    volume.scene.step_voxels = std::strtod(configuration.at("step").c_str(), nullptr);
    volume.scene.width = std::atoi(configuration.at("viewport").c_str());
    volume.scene.height = volume.scene.width;
    // A different camera draws a different image. The exact position does not matter.
    volume.scene.camera.eye.x = static_cast<double>(
        std::stoul(core::content_hash(configuration.at("camera")).substr(0, 4), nullptr, 16));
    volume.options.ert = std::strtod(configuration.at("ert").c_str(), nullptr);
    volume.options.skip =
        configuration.at("skip") == "bricks" ? technique::Skip::bricks : technique::Skip::none;
    if (configuration.at("sampler") == "auto") {
      configuration["sampler"] =
          std::string(technique::name_of(device.default_path({scene::VoxelFormat::f32}).sampler));
    }
    volume.options.sampler = technique::sampler(configuration.at("sampler"));
    return {.technique = configuration.at("technique"), .scene = std::move(volume)};
  }

  // Declares that skip=bricks does the same work as skip=none with the data "full", because these
  // data contain no empty bricks.
  PlainWork plain(const Configuration& configuration, const Work&) const override {
    PlainWork plain{.levels = configuration};
    if (configuration.at("data") == "full" && configuration.at("skip") == "bricks") {
      plain.levels["skip"] = "none";
      plain.why["skip"] = "nothing is empty";
    }
    return plain;
  }

  Work calibration(technique::Work kind) override {
    VolumeWork volume;
    volume.scene.width = 64;
    volume.scene.height = 64;
    return {.technique = kind == technique::Work::draw ? "raycast_fragment" : "raycast",
            .scene = std::move(volume)};
  }

 private:
  std::vector<Factor> factors_{
      {.name = "technique",
       .kind = FactorKind::choice,
       .levels = {"raycast", "raycast_fragment"},
       .default_value = "raycast",
       .determines_image = false,
       .automatic = {"raycast", "raycast_fragment"},
       .summary = "how it is drawn"},
      {.name = "data", .default_value = "cube", .summary = "what is drawn"},
      {.name = "sampler",
       .kind = FactorKind::choice,
       .levels = {"hardware", "manual"},
       .default_value = "auto",
       .determines_image = false,
       .summary = "who interpolates"},
      {.name = "step",
       .kind = FactorKind::number,
       .minimum = 0.01,
       .maximum = 16,
       .default_value = "1",
       .summary = "in voxels"},
      {.name = "skip",
       .kind = FactorKind::choice,
       .levels = {"none", "bricks"},
       .default_value = "bricks",
       .determines_image = false,
       .summary = "empty space"},
      {.name = "ert",
       .kind = FactorKind::number,
       .minimum = 0,
       .maximum = 0.5,
       .default_value = "0",
       .determines_image = false,
       .summary = "early ray termination"},
      {.name = "camera", .default_value = "orbit_y:0/8", .summary = "view"},
      {.name = "viewport", .default_value = "16", .summary = "pixels"},
  };
};

}  // namespace triptych::measure
