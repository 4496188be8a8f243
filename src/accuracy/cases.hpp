#pragma once
// The cases of a run for which accuracy is reported: each image against its limit and its reference
// image.

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

// The limit of the images of a scene.
struct LimitPicture {
  std::string key;  // this key is the same for all records that share the limit
  core::Image image;
  core::Image uncertainty;  // per pixel, the largest distance of the image from the exact limit
  std::optional<core::Image> closed_form;
};

struct PictureError {
  double rmse = 0;
  double largest = 0;
  double error_99 = 0;
  double lattice = 0;
  double arithmetic = 0;
};
// `truth` is the reference image on the same sample positions as the device's image. nullopt if the
// three images differ in size, or if the device's image has values that are not finite.
[[nodiscard]] std::optional<PictureError> picture_error(const core::Image& picture,
                                                        const core::Image& truth,
                                                        const core::Image& limit);

// One scene on one device.
struct AccuracyScene {
  std::string device;
  std::string limit;  // LimitPicture::key: scenes with the same limit show the same image
  std::string scene;  // "camera=…,data=…": the levels that all its records have in common
  std::string data;
  double uncertainty = 0;  // root mean square of the limit's uncertainty
  // Root mean square difference between the limit and the closed form: the part that grid and table
  // cannot represent.
  std::optional<double> representation;
  // Root mean square error of the limit when it is stored with 8 bits per channel.
  double eight_bits = 0;
  double nothing = 0;  // the same for an image in which nothing was drawn
  std::vector<AccuracyCase> cases;
  std::vector<AccuracyFamily> families;
  std::vector<std::size_t> front;
  std::vector<Dominated> dominated;
  std::optional<FrontArea> area;  // if anything was timed
};

// A record with its errors, and its time by this clock.
[[nodiscard]] AccuracyCase accuracy_case(const record::Record& record, const PictureError& error,
                                         std::string_view clock);

// A scene without cases. The other functions update the levels that it has in common with one more
// record, and compute the results once all cases are there.
[[nodiscard]] AccuracyScene accuracy_scene(const record::Record& record, const LimitPicture& limit);
void narrow(AccuracyScene& scene, const record::Record& record);
void evaluate(AccuracyScene& scene);

// The JSON form {"device", "scene", "data", "uncertainty", "representation", "eight_bits",
// "nothing", "hypervolume", "configurations": [{"configuration", "time_ns", "samples",
// "instructions", "fetched_bytes", "memory_bytes", "joules", "rmse", "largest", "error_99",
// "lattice", "arithmetic", "front"}], "families": [{"name", "order", "half_width",
// "configurations"}]}. A value that was not timed, counted or found is null.
[[nodiscard]] nlohmann::json to_json(const AccuracyScene& scene);

}  // namespace triptych::accuracy
