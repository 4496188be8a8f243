#include "report/exports/frame_folder.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "accuracy/image_metrics.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "judge/image_observation.hpp"
#include "report/figures/share_of_bound.hpp"

namespace triptych::report {
namespace {

constexpr std::array frame_files{"image.png", "image.exr", "frame.json"};

// Removes the files that compare a frame with the reference renderer.
void remove_comparison(const std::filesystem::path& folder) {
  for (const char* file : {"truth.exr", "truth.png", "difference.png", "pixel.txt"}) {
    std::filesystem::remove(folder / file);
  }
}

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
  for (const char* file : frame_files) std::filesystem::remove(folder / file);
  remove_comparison(folder);
}

std::vector<std::string> replace_frame(const std::filesystem::path& folder,
                                       const core::Image& image, const core::Json& frame) {
  const std::vector<std::byte> png = core::encode_png(image);
  const std::vector<std::byte> exr = core::encode_exr(image);
  const std::string json = core::json_text(frame, 2) + "\n";
  core::write_files({{folder / "image.png", png},
                     {folder / "image.exr", exr},
                     {folder / "frame.json", std::as_bytes(std::span(json))}});
  remove_comparison(folder);
  std::vector<std::string> written;
  for (const char* file : frame_files) written.push_back((folder / file).string());
  return written;
}

std::filesystem::path prepare_reduced_folder(const std::filesystem::path& named) {
  const bool has_frame = std::filesystem::exists(named / "frame.json");
  const bool of_render = has_frame && !std::filesystem::exists(named / "README.md");
  if (of_render) return prepare_reduced_folder(named / "reduced");
  // A README.md without frame.json next to it was not written by `reduce`, so it is kept.
  if (has_frame) std::filesystem::remove(named / "README.md");
  remove_frame(named);
  std::filesystem::remove(named / "sequence.txt");
  if (std::filesystem::exists(named / "dump" / "what-was-given.txt")) {
    std::filesystem::remove_all(named / "dump");
  }
  return named;
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
