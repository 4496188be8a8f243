#pragma once
// One frame as files: what was drawn, what is right, and in what they differ.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/image.hpp"
#include "judge/stress/stress.hpp"
#include "record/record.hpp"

namespace triptych::report {

// frame.json: enough for another program to draw the same frame. `scene`: what its suite describes.
[[nodiscard]] nlohmann::json frame_json(nlohmann::json scene, const record::Record& record,
                                        const record::Device& device);

// Removes what the functions below write, and frame.json: what cannot be drawn shall not leave
// another frame's pictures to be taken for its own.
void remove_frame(const std::filesystem::path& folder);

// image.exr and image.png, or truth.exr and truth.png. Throws IoError.
void write_picture(const std::filesystem::path& folder, const std::string& name,
                   const core::Image& image);

// An image compared with its reference image.
struct HeldAgainstTruth {
  judge::Observation what;
  double white = 0;  // error that is white in difference.png; 0: sizes differ, there is none
  [[nodiscard]] bool right() const { return what.cause == judge::Cause::within_bound; }
};

// Writes truth.exr, truth.png and difference.png. Throws IoError.
[[nodiscard]] HeldAgainstTruth write_difference(const std::filesystem::path& folder,
                                                const core::Image& image,
                                                const judge::TruthPair& pair);

}  // namespace triptych::report
