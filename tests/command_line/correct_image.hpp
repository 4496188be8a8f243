#pragma once
#include <filesystem>
#include <string>

#include "core/image_io.hpp"
#include "measure/plan/plan.hpp"
#include "program.hpp"
#include "suites/volume/suite.hpp"

namespace triptych::command_line {

// Writes the reference image of the tiny plan's scene to a file, so that scripted devices can draw
// it. Returns the file. `transfer_function` is a preset, or a file in the program's folder.
inline std::filesystem::path correct_image(const Program& program,
                                           const std::string& transfer_function = "haze") {
  const auto suite = volume_suite::make_suite({program.folder()});
  const measure::Plan plan =
      measure::load_plan("volume/quick",
                         {{"technique", {"raycast"}},
                          {"data", {"generate:gaussian_blob:16"}},
                          {"transfer_function", {transfer_function}},
                          {"viewport", {"16"}}},
                         [&](std::string_view) -> measure::Suite& { return *suite; });
  const auto file = program.folder() / "right.exr";
  core::write_exr(suite->truth(plan.configurations.at(0), {}).truth, file);
  return file;
}

}  // namespace triptych::command_line
