#pragma once
// Writes one frame as files: the device's image, the reference image, and the difference.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "judge/stress/stress.hpp"
#include "record/record.hpp"

namespace triptych::report {

// Returns the content of frame.json, from which another program can draw the same frame. `scene` is
// the suite's description of the scene.
[[nodiscard]] nlohmann::json frame_json(nlohmann::json scene, const record::Record& record,
                                        const record::Device& device);

// Removes all files that the functions below write. A command calls this first if it may end
// without an image, because users could otherwise mistake the images of an earlier frame for images
// of the current frame.
void remove_frame(const std::filesystem::path& folder);

// Writes image.png, image.exr and frame.json, and removes the files of an earlier frame's
// comparison with the reference renderer. The files of the earlier frame are replaced only after
// all new files are complete, so that an error leaves them unchanged. Returns the files. Throws
// IoError.
[[nodiscard]] std::vector<std::string> replace_frame(const std::filesystem::path& folder,
                                                     const core::Image& image,
                                                     const nlohmann::json& frame);

// Returns the folder for the results of `reduce`, after removing the files of an earlier `reduce`
// from it. It is `named` or, if `named` contains a frame that `render` drew, the subfolder
// "reduced", so that the files of both frames are not mixed. If there is a README.md next to the
// frame, `reduce` drew it.
[[nodiscard]] std::filesystem::path prepare_reduced_folder(const std::filesystem::path& named);

// Writes `image` to NAME.exr and NAME.png. Throws IoError.
void write_image_files(const std::filesystem::path& folder, const std::string& name,
                       const core::Image& image);

// The result of comparing an image with its reference image.
struct ReferenceComparison {
  judge::Observation what;
  bool has_difference = false;  // whether difference.png was written; false if the sizes differ
  [[nodiscard]] bool right() const { return what.cause == judge::Cause::within_bound; }
};

// Compares an image with its reference image. Writes truth.exr, truth.png, and difference.png,
// which shows the error of each pixel as a share of its error bound (figures/share_of_bound.hpp).
// Throws IoError.
[[nodiscard]] ReferenceComparison write_difference(const std::filesystem::path& folder,
                                                   const core::Image& image,
                                                   const judge::TruthPair& pair);

}  // namespace triptych::report
