#include "fixture.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "report/exports/verdict_json.hpp"

namespace triptych::judge {
namespace {

record::Device make_device(const std::string& id) {
  record::Device device;
  device.id = id;
  device.api = id.substr(0, id.find(':'));
  device.driver_version = "22.3.6";
  device.api_version = "1.3";
  return device;
}

std::vector<record::Device> devices() {
  return {make_device("gl:llvmpipe-egl"), make_device("opencl:pocl"),
          make_device("vulkan:lavapipe")};
}

}  // namespace

JudgeTest::JudgeTest() : store_(folder_.path() / "store.sqlite", record::Store::Mode::append) {
  request_.plan = plan;
  request_.today = "2026-03-01";
  request_.truth = [](const record::Record& record) {
    TruthPair pair{truth_of(record.scene), core::Image(8, 6)};
    for (float& value : pair.bound.rgba) value = bound;
    return pair;
  };
}

core::Image JudgeTest::truth_of(const std::string& scene) {
  core::Image image(8, 6);
  const float level = scene == front_ ? 0.25F : 0.5F;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = level + static_cast<float>(i) / 1024;
  }
  return image;
}

record::Record JudgeTest::make_record(const std::string& run, const record::Device& device,
                                      const std::string& scene, const std::string& variant) {
  record::Record record;
  record.run = run;
  record.suite = "volume";
  record.plan = plan;
  record.scene = scene;
  record.device = device.id;
  record.technique = "raycast";
  record.configuration = fmt::format("{},{}technique={}", scene,
                                     variant == "bricks" ? "skip=bricks," : "", record.technique);
  record.outcome = record::Outcome::measured;
  record.factors = {{"data", "ball"}, {"skip", variant == "bricks" ? "bricks" : "none"}};
  record.kernel_hash = "kernel-" + device.id;
  const double level = 1e6 * static_cast<double>(1 + record.configuration.size() % 7);
  record.warm_up_frames = 4;
  record.wall_ns = noisy(level);
  record.counters = {{"rays", 48}, {"samples", 1000000}};
  if (device.api != "opencl") {
    record.statistics = {{"compute_invocations", 48}, {"fragment_invocations", 64}};
  }
  return record;
}

std::vector<double> JudgeTest::noisy(double level) {
  std::vector<double> times;
  for (int frame = 0; frame < 5; ++frame) {
    const double noise = random_.uniform() + random_.uniform() + random_.uniform() - 1.5;
    times.push_back(level * std::exp(0.01 * noise));
  }
  return times;
}

void JudgeTest::add_run(const std::string& run, const Tweak& tweak) {
  store_.add_run({run, plan, "2026-02-01T00:00:00Z", {}, checks_, plan_hash_});
  for (record::Device device : devices()) {
    device.statistics_calibration = calibrations_[device.id];
    device.environment.insert(settings_.begin(), settings_.end());
    if (driver_versions_.contains(device.id)) device.driver_version = driver_versions_[device.id];
    store_.add_device(run, device, {});
    for (const std::string& scene : {front_, std::string("camera=side,data=ball")}) {
      for (const std::string variant : {"plain", "bricks"}) {
        record::Record record = make_record(run, device, scene, variant);
        core::Image image = truth_of(scene);
        // Each device rounds differently.
        for (float& value : image.rgba) value += 1e-6F * static_cast<float>(device.id.size());
        if (tweak) tweak(record, image);
        if (record.outcome == record::Outcome::measured) {
          const auto bytes = core::encode_exr(image);
          record.image = core::content_hash(bytes);
          store_.add_image(record.image, bytes);
        }
        store_.add_record(record);
      }
    }
  }
}

std::vector<std::string> JudgeTest::accept_run(const std::string& run, AcceptRequest request) {
  request.plan = plan;
  request.reason = "a test";
  request.date = "2026-02-01";
  if (!request.truth) {
    request.truth = [](const record::Record& record) { return truth_of(record.scene); };
  }
  return accept(store_, run, folder_.path() / "baselines", request);
}

void JudgeTest::accept_first(const Tweak& tweak) {
  add_run("accepted", tweak);
  (void)accept_run("accepted");
}

void JudgeTest::rewrite(const std::string& name, const std::string& content) {
  core::write_file(content, baseline(name));
  core::Json manifest = core::Json::parse(folder_.read(baseline("manifest.json")));
  manifest["files"][name] = core::content_hash(content);
  core::write_file(manifest.dump(1), baseline("manifest.json"));
}

GateResult JudgeTest::gate(const std::string& run, const GateRequest& request) const {
  return judge_run(store_, run, Baselines(folder_.path() / "baselines", plan), request);
}

std::filesystem::path JudgeTest::baseline(const std::string& name) const {
  return folder_.path() / "baselines" / plan / name;
}

std::filesystem::path JudgeTest::device_file(const std::string& folder,
                                             const std::string& start) const {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(baseline(folder))) {
    if (entry.path().filename().string().starts_with(start)) found.push_back(entry.path());
  }
  EXPECT_EQ(found.size(), 1U);
  return found.at(0);
}

std::vector<Finding> JudgeTest::with(const GateResult& result, Verdict verdict) {
  std::vector<Finding> found;
  for (const Finding& finding : result.findings) {
    if (finding.verdict == verdict) found.push_back(finding);
  }
  return found;
}

std::vector<Finding> JudgeTest::with(const GateResult& result, Verdict verdict, Check check) {
  std::vector<Finding> found = with(result, verdict);
  std::erase_if(found, [&](const Finding& finding) { return finding.check != check; });
  return found;
}

std::vector<Finding> JudgeTest::with(const GateResult& result, Cause cause) {
  std::vector<Finding> found = result.findings;
  std::erase_if(found, [&](const Finding& finding) { return finding.cause != cause; });
  return found;
}

Change change_of(const Observation& observation, const std::string& name) {
  const auto found = std::ranges::find(observation.changes, name, &Change::name);
  if (found != observation.changes.end()) return *found;
  ADD_FAILURE() << name << " did not change";
  return {};
}

bool has_cause(const std::vector<Observation>& because, Cause cause) {
  return std::ranges::find(because, cause, &Observation::cause) != because.end();
}

std::string JudgeTest::text(const GateResult& result) {
  return report::to_json(result).dump(1);
}

}  // namespace triptych::judge
