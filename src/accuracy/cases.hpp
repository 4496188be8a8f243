#pragma once
// The cases of a run for which accuracy is reported. Each image is compared with its limit image
// and with its reference image.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "accuracy/hypervolume.hpp"
#include "core/image.hpp"
#include "record/store.hpp"

namespace triptych::accuracy {

// The limit image of a scene: the image for step → 0.
struct LimitImage {
  std::string key;  // equal for all records that share this limit image
  core::Image image;
  core::Image uncertainty;  // per pixel, a bound on the distance from the exact limit image
  std::optional<core::Image> closed_form;
};

struct LimitErrors {
  double rmse = 0;
  double largest = 0;
  double error_99 = 0;
  double lattice = 0;
  double arithmetic = 0;
};
// Returns the errors of an image compared with its limit image. `truth` is the reference image at
// the sample positions of the device's image. Returns nullopt if the three images differ in size,
// or if the device's image contains a value that is not finite.
[[nodiscard]] std::optional<LimitErrors> limit_errors(const core::Image& image,
                                                      const core::Image& truth,
                                                      const core::Image& limit);

// One scene on one device.
struct AccuracyScene {
  std::string device;
  std::string limit;  // LimitImage::key; equal for scenes with the same limit image
  std::string scene;  // "camera=…,data=…": the factor levels that all cases share
  std::string data;
  double uncertainty = 0;  // root mean square of LimitImage::uncertainty
  // Root mean square difference between the limit image and the closed-form solution, which the
  // voxel grid and the transfer-function table cannot represent exactly.
  std::optional<double> representation;
  // The root mean square error that the limit image would have with 8 bits per channel.
  double eight_bit_error = 0;
  double empty_image_error = 0;  // root mean square error of an empty image
  std::vector<AccuracyCase> cases;
  std::vector<AccuracyFamily> families;
  std::vector<std::size_t> front;
  std::vector<Dominated> dominated;
  std::optional<FrontArea> area;  // set only if any configuration was timed
};

// Combines a record, the errors of its image, and the median of its times on the clock `clock`.
[[nodiscard]] AccuracyCase accuracy_case(const record::Record& record, const LimitErrors& error,
                                         std::string_view clock);

// accuracy_scene() returns a scene without cases. narrow() removes factor levels from
// AccuracyScene::scene: those that `record` does not have. evaluate() computes the results after
// all cases have been added.
[[nodiscard]] AccuracyScene accuracy_scene(const record::Record& record, const LimitImage& limit);
void keep_common_levels(AccuracyScene& scene, const record::Record& record);
void evaluate(AccuracyScene& scene);

// Returns {"device", "scene", "data", "uncertainty", "representation", "eight_bits",
// "nothing", "hypervolume", "configurations": [{"configuration", "time_ns", "samples",
// "instructions", "fetched_bytes", "memory_bytes", "joules", "rmse", "largest", "error_99",
// "lattice", "arithmetic", "front"}], "families": [{"name", "order", "half_width",
// "configurations"}]}. A value is null if it was not timed, counted or determined.
[[nodiscard]] nlohmann::json to_json(const AccuracyScene& scene);

}  // namespace triptych::accuracy
