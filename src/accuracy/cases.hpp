#pragma once
// The cases of a run that accuracy is told of: each picture against its limit and its truth.

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

// What the pictures of a scene tend to.
struct LimitPicture {
  std::string key;  // the same for all records that share it
  core::Image image;
  core::Image uncertainty;  // per pixel, how far the image may be from the limit
  std::optional<core::Image> closed_form;
};

struct PictureError {
  double rmse = 0;
  double largest = 0;
  double error_99 = 0;
  double lattice = 0;
  double arithmetic = 0;
};
// `truth`: on the picture's own sample lattice. All three of one size, else nullopt; so for a
// picture with values that are not finite.
[[nodiscard]] std::optional<PictureError> picture_error(const core::Image& picture,
                                                        const core::Image& truth,
                                                        const core::Image& limit);

// One scene on one device.
struct AccuracyScene {
  std::string device;
  std::string limit;  // LimitPicture::key: scenes of one limit are the same picture
  std::string scene;  // "camera=…,data=…" of what all its records have in common
  std::string data;
  double uncertainty = 0;  // root mean square of the limit's
  // From the limit to the closed form, root mean square: what grid and table cannot represent.
  std::optional<double> representation;
  double eight_bits = 0;  // root mean square error of the limit written with 8 bits a channel
  double nothing = 0;     // and of a picture in which nothing was drawn
  std::vector<AccuracyCase> cases;
  std::vector<AccuracyFamily> families;
  std::vector<std::size_t> front;
  std::vector<Dominated> dominated;
  std::optional<FrontArea> area;  // where anything was timed
};

// A record with its errors, its time by this clock.
[[nodiscard]] AccuracyCase accuracy_case(const record::Record& record, const PictureError& error,
                                         std::string_view clock);

// A scene without cases, what it has in common with one more record, and what follows from its
// cases once they are there.
[[nodiscard]] AccuracyScene accuracy_scene(const record::Record& record, const LimitPicture& limit);
void narrow(AccuracyScene& scene, const record::Record& record);
void evaluate(AccuracyScene& scene);

// {"device", "scene", "data", "uncertainty", "representation", "eight_bits", "nothing",
// "hypervolume", "configurations": [{"configuration", "time_ns", "samples", "instructions",
// "fetched_bytes", "memory_bytes", "joules", "rmse", "largest", "error_99", "lattice",
// "arithmetic", "front"}], "families": [{"name", "order", "half_width", "configurations"}]}; null
// for what was not timed, counted or found
[[nodiscard]] nlohmann::json to_json(const AccuracyScene& scene);

}  // namespace triptych::accuracy
