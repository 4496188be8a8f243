#pragma once
// Creates a store and a verdict like those of `gate` with two devices, without using any device.

#include <cmath>
#include <span>
#include <string>

#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "findings.hpp"
#include "record/factor_list.hpp"
#include "report/page/page.hpp"

namespace triptych::report {

constexpr int side = 48;

inline core::Image disc(double radius, float shade) {
  core::Image image(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double distance = std::hypot(x - 23.5, y - 23.5);
      float* pixel = image.rgba.data() +
                     4 * (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x));
      if (distance > radius) continue;
      pixel[0] = shade;
      pixel[1] = static_cast<float>(1 - distance / radius);
      pixel[2] = 0.3F;
      pixel[3] = 1;
    }
  }
  return image;
}

inline judge::TruthPair truth_of(const record::Record& record) {
  core::Image bound(side, side);
  for (float& each : bound.rgba) each = 1e-3F;
  return {disc(record.factors.at("data") == "ball" ? 20 : 12, 0.9F), bound};
}

// If `wrong` is true, raycast on the second device draws too small a disc, and one of its frames
// crashes.
class ScriptedStore {
 public:
  ScriptedStore(const std::filesystem::path& file, bool wrong, const std::string& name = "step")
      : store_(file, record::Store::Mode::append), wrong_(wrong) {
    run_ = {.id = "r",
            .plan = "volume/quick",
            .started_at = "2026-01-02T03:04:05Z",
            .system = {{"processor", "two cores"}}};
    store_.add_run(run_);
    verdict_ = {.plan = run_.plan, .run = run_.id, .findings = {}};
    for (const char* device : {"opencl:pocl", "vulkan:lavapipe"}) {
      store_.add_device(run_.id,
                        {.id = device,
                         .api = "x",
                         .name = "a device",
                         .vendor = "v",
                         .driver = "d",
                         .driver_version = "1",
                         .api_version = "1"},
                        {});
      verdict_.devices.insert(device);
      for (const char* data : {"ball", "blob"}) {
        for (const char* technique : {"raycast", "slices"}) {
          for (const char* level : {"0.5", "1"}) add(device, data, technique, name, level);
        }
      }
    }
  }

  [[nodiscard]] std::string page() const {
    return report::page(store_, {.plans = {{run_, verdict_}}, .truth = truth_of});
  }
  [[nodiscard]] const judge::GateResult& verdict() const { return verdict_; }

 private:
  void add(const std::string& device, const std::string& data, const std::string& technique,
           const std::string& name, const std::string& level) {
    record::Record record;
    record.run = run_.id;
    record.suite = "volume";
    record.plan = run_.plan;
    record.factors = {{"data", data}, {"technique", technique}, {name, level}};
    record.configuration = record::factor_list(record.factors);
    record.scene = record::factor_list({{"data", data}});
    record.technique = technique;
    record.device = device;
    record.factors["skip"] = "distance";
    const bool bad = wrong_ && device == "vulkan:lavapipe" && technique == "raycast";
    const bool crashed = bad && data == "blob" && level == "1";
    record.outcome = crashed ? record::Outcome::crashed : record::Outcome::measured;
    if (crashed) {
      record.reason = {.cause = record::Cause::signal,
                       .numbers = {{"signal", 11}},
                       .last_output = "in the driver <x>"};
    }
    if (!crashed) {
      core::Image image = truth_of(record).truth;
      for (float& each : image.rgba) each += each > 0 ? 3e-4F * (technique[0] == 'r' ? 1 : 2) : 0;
      if (bad) image = disc(level == "1" ? 17 : 18, 0.9F);
      const std::vector<std::byte> exr = core::encode_exr(image);
      record.image = core::content_hash(exr);
      store_.add_image(record.image, exr);
      for (int i = 0; i < 12; ++i)
        record.wall_ns.push_back(1e6 * (1 + 0.03 * i) * (device[0] == 'o' ? 1 : 1.7));
      record.counters = {{"samples", 123456}, {"samples_nonzero", 92592}};
      record.cost = {{"device_code", 987654}, {"driver", 1234}};
    }
    store_.add_record(record);
    find(record, judge::Check::image,
         crashed ? ended(record.outcome, record.reason)
         : bad   ? over_bound(811)
                 : within_bound(),
         bad);
    const bool counts_differ = bad && !crashed;
    find(record, judge::Check::counters,
         counts_differ ? changed("samples") : judge::Observation{.cause = judge::Cause::as_stored},
         counts_differ);
    if (crashed) return;
    const bool costlier = wrong_ && device == "vulkan:lavapipe" && technique == "slices";
    find(record, judge::Check::cost, changed("device_code"), costlier);
    verdict_.findings.back().numbers = {{"ratio", costlier ? 1.02 : 1},
                                        {"device_code", 987654},
                                        {"stored_device_code", costlier ? 968288 : 987654}};
    find(record, judge::Check::timing, {.cause = judge::Cause::time}, false);
    verdict_.findings.back().numbers = {{"ratio", 0.9}};
  }
  void find(const record::Record& record, judge::Check check, const judge::Observation& what,
            bool bad) {
    verdict_.findings.push_back(finding_of(check,
                                           bad ? judge::Verdict::regression : judge::Verdict::pass,
                                           record.device, record.configuration, what));
  }

  record::Store store_;
  bool wrong_;
  record::Run run_;
  judge::GateResult verdict_;
};

}  // namespace triptych::report
