#pragma once
// Writes one frame as files: the device's image, the reference image, and the difference.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/image.hpp"
#include "judge/stress/stress.hpp"
#include "record/record.hpp"

namespace triptych::report {

// The content of frame.json, with which another program can draw the same frame. `scene` is the
// description by its suite.
[[nodiscard]] nlohmann::json frame_json(nlohmann::json scene, const record::Record& record,
                                        const record::Device& device);

// Removes frame.json and the files that the functions below write. Otherwise, if a frame cannot be
// drawn, a reader could take the images of an earlier frame for its images.
void remove_frame(const std::filesystem::path& folder);

// Writes image.exr and image.png, or truth.exr and truth.png. Throws IoError.
void write_picture(const std::filesystem::path& folder, const std::string& name,
                   const core::Image& image);

// An image compared with its reference image.
struct HeldAgainstTruth {
  judge::Observation what;
  // False: there is no difference.png, because the sizes differ.
  bool has_difference = false;
  [[nodiscard]] bool right() const { return what.cause == judge::Cause::within_bound; }
};

// Writes truth.exr, truth.png and difference.png, which shows each error as a share of its pixel's
// bound (figures/share_of_bound.hpp). Throws IoError.
[[nodiscard]] HeldAgainstTruth write_difference(const std::filesystem::path& folder,
                                                const core::Image& image,
                                                const judge::TruthPair& pair);

}  // namespace triptych::report
