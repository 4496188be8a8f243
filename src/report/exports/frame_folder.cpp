#include "report/exports/frame_folder.hpp"

#include <utility>

#include "accuracy/image_metrics.hpp"
#include "core/image_io.hpp"
#include "core/json.hpp"
#include "judge/image_observation.hpp"
#include "report/figures/share_of_bound.hpp"

namespace triptych::report {
namespace {

core::Json clock_json(const std::vector<double>& samples) {
  return {{"samples", samples}};
}

}  // namespace

core::Json frame_json(core::Json scene, const record::Record& record,
                      const record::Device& device) {
  core::Json frame = std::move(scene);
  frame["schema"] = 1;
  frame["suite"] = record.suite;
  frame["technique"] = record.technique;
  frame["device"] = record.device;
  frame["driver"] = device.driver + " " + device.driver_version;
  frame["factors"] = record.factors;
  frame["counters"] = record.counters;
  frame["statistics"] = record.statistics;
  frame["time_ns"] = {{"device", clock_json(record.device_ns)},
                      {"wall", clock_json(record.wall_ns)}};
  frame["time_ns"]["device"]["trusted"] = record.device_clock_trusted;
  return frame;
}

void remove_frame(const std::filesystem::path& folder) {
  for (const char* file : {"image.exr", "image.png", "truth.exr", "truth.png", "difference.png",
                           "frame.json", "pixel.txt"}) {
    std::filesystem::remove(folder / file);
  }
}

void write_image_files(const std::filesystem::path& folder, const std::string& name,
                       const core::Image& image) {
  core::write_exr(image, folder / (name + ".exr"));
  core::write_png(image, folder / (name + ".png"));
}

ReferenceComparison write_difference(const std::filesystem::path& folder, const core::Image& image,
                                     const judge::TruthPair& pair) {
  const accuracy::ImageComparison comparison = accuracy::compare(image, pair.truth, pair.bound);
  write_image_files(folder, "truth", pair.truth);
  ReferenceComparison result{
      judge::image_observation(comparison, image, pair.truth, judge::Against::reference)};
  if (!comparison.size_mismatch) {
    core::write_png(share_of_bound(image, pair.truth, pair.bound).image, folder / "difference.png");
    result.has_difference = true;
  }
  return result;
}

}  // namespace triptych::report
