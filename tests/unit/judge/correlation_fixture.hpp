#pragma once
// Runs of two synthetic devices, one of them accepted, as the correlation's gate meets them.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/hash.hpp"
#include "core/image_io.hpp"
#include "core/random.hpp"
#include "fixture.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {

// A plan of 48 configurations and the anchors' own, on the device "a:known" whose runs are
// accepted, on "b:new", half as fast, and on others.
class CorrelationGateTest : public JudgeTest {
 protected:
  static constexpr const char* plan = "volume/correlation";
  static constexpr const char* anchors = "anchors/frozen";
  using Times = std::function<double(const record::Record&)>;  // factor on a record's times

  CorrelationGateTest() {
    request_.plan = plan;
    request_.checks = {Check::correlation};
    request_.truth = nullptr;
  }

  static record::Device device(const std::string& id) {
    record::Device device;
    device.id = id;
    device.api = "gl";
    device.driver_version = "1";
    device.cpu_features = id.starts_with("c:") ? "avx512f" : "avx2";
    return device;
  }

  void add(const std::string& run, const std::string& in_plan, const std::string& on,
           record::Record record, double level, const Times& times) {
    record.run = run;
    record.plan = in_plan;
    record.suite = in_plan.substr(0, in_plan.find('/'));
    record.device = on;
    record.scene = record.configuration;
    record.outcome = record::Outcome::measured;
    record.kernel_hash = "k";
    const double speed = on == "b:new" ? 2 : 1;
    // How a configuration differs from the line is a device's own, its noise is a run's.
    const double own = on == "b:new" ? 0.02 * std::sin(level * 1e3) : 0;
    const double factor = times ? times(record) : 1;
    for (int frame = 0; frame < 7; ++frame) {
      record.wall_ns.push_back(factor * speed * std::exp(level + own + 0.005 * scatter()));
    }
    if (record.suite != "anchors") {
      const auto bytes = core::encode_exr(truth_of(record.scene));
      record.image = core::content_hash(bytes);
      store_.add_image(record.image, bytes);
    }
    store_.add_record(record);
  }

  void measure(const std::string& run, const std::string& on, const Times& times = {}) {
    store_.add_run({run, plan, "2026-02-01T00:00:00Z", {}});
    store_.add_device(run, device(on), {});
    for (int i = 0; i < 48; ++i) {
      record::Record record;
      record.technique = i % 2 == 0 ? "raycast" : "raycast_fragment";
      record.factors = {{"technique", record.technique},
                        {"data", fmt::format("d{}", i / 2 % 4)},
                        {"step", fmt::format("{}", i / 8)}};
      record.configuration =
          fmt::format("data=d{},step={},technique={}", i / 2 % 4, i / 8, record.technique);
      record.counters = {{"samples", 1000}};
      add(run, plan, on, record, 14 + 0.06 * i, times);
    }
  }

  void measure_anchors(const std::string& run, const std::string& on) {
    store_.add_run({run, anchors, "2026-02-01T00:00:00Z", {}});
    store_.add_device(run, device(on), {});
    int i = 0;
    for (const char* technique :
         {"anchor_arithmetic", "anchor_fetch", "anchor_memory", "anchor_raster"}) {
      for (int size = 1; size <= 4; size *= 2) {
        record::Record record;
        record.technique = technique;
        record.factors = {{"technique", technique}, {"size", fmt::format("{}", size)}};
        record.configuration = fmt::format("size={},technique={}", size, technique);
        add(run, anchors, on, record, 14.3 + 0.1 * ++i + std::log(size), {});
      }
    }
  }

  void accept_plan(const std::string& run, const std::string& of) {
    AcceptRequest request;
    request.plan = of;
    request.reason = "a test";
    request.date = "2026-02-01";
    request.truth = [](const record::Record& record) { return truth_of(record.scene); };
    (void)accept(store_, run, folder_.path() / "baselines", request);
  }

  void accept_runs_of(const std::string& on, std::size_t runs, const Times& times = {}) {
    for (std::size_t i = 1; i <= runs; ++i) {
      // As real ids do, they stand in the order of time: anchors are measured first.
      const std::string beside = fmt::format("{} {} anchors", on, i);
      measure_anchors(beside, on);
      accept_plan(beside, anchors);
      const std::string run = fmt::format("{} {} plan", on, i);
      measure(run, on, times);
      accept_plan(run, plan);
    }
  }

  void accept_known(std::size_t runs = TimingModel::least_runs) { accept_runs_of("a:known", runs); }

  [[nodiscard]] GateResult judge(const std::string& run) const {
    return judge_run(store_, run, Baselines(folder_.path() / "baselines", plan), request_);
  }

 private:
  double scatter() { return random_.uniform(-1, 1) + random_.uniform(-1, 1); }
  core::Random random_{11};
};

}  // namespace triptych::judge
