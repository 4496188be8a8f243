#include "measure/worker/feature_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "measure/system/environment.hpp"
#include "measure/worker/own_program.hpp"
#include "measure/worker/worker_link.hpp"

namespace triptych::measure {
namespace {

// Runs a probe. Sets `lost` if the device has been lost and must be opened again.
ProbedFeature run_probe(const FeatureProbe& probe, bool& lost) {
  try {
    return probe.run();
  } catch (const core::DeviceLost& error) {
    lost = true;
    return {.verdict = FeatureVerdict::wrong, .size = {}, .detail = error.what()};
  } catch (const core::NotSupported& error) {
    return {.verdict = FeatureVerdict::skipped, .size = {}, .detail = error.what()};
  } catch (const core::Error& error) {
    return {.verdict = FeatureVerdict::wrong, .size = {}, .detail = error.what()};
  }
}

Message as_message(const ProbedFeature& probed) {
  return {.json = {{"verdict", static_cast<int>(probed.verdict)},
                   {"size", probed.size},
                   {"detail", probed.detail}},
          .binary = {}};
}

ProbedFeature as_probed(const nlohmann::json& json) {
  return {.verdict = static_cast<FeatureVerdict>(json.at("verdict").get<int>()),
          .size = json.at("size"),
          .detail = json.at("detail")};
}

// A process that probes one device. If the process dies, the next request starts a new one.
class Prober {
 public:
  Prober(std::string device, std::chrono::seconds limit)
      : device_(std::move(device)), limit_(limit), cache_(device_) {}

  // Returns the answer, or the reason why the process did not answer.
  std::variant<nlohmann::json, record::Reason> send_request(const nlohmann::json& request) {
    if (!link_) {
      link_ = std::make_unique<WorkerLink>(
          std::vector<std::string>{own_program(), "probe-features", device_},
          worker_environment(device_, cache_, {}), interrupts_);
    }
    WorkerLink::Reply reply = link_->send_request({.json = request, .binary = {}}, limit_);
    if (auto* answer = std::get_if<Message>(&reply)) return std::move(answer->json);
    link_.reset();
    if (auto* died = std::get_if<WorkerLink::Died>(&reply)) return std::move(died->reason);
    return std::move(std::get<WorkerLink::TimedOut>(reply).reason);
  }

  void finish() {
    if (link_) link_->finish();
  }

 private:
  std::string device_;
  std::chrono::seconds limit_;
  InterruptGuard interrupts_;
  CacheFolder cache_;
  std::unique_ptr<WorkerLink> link_;
};

FeatureRow failed_row(std::string name, record::Reason reason) {
  return {.name = std::move(name),
          .probed = {.verdict = FeatureVerdict::wrong, .size = {}, .detail = {}},
          .ended = std::move(reason)};
}

}  // namespace

ProbedFeature judged_feature(std::uint64_t right, std::uint64_t expected, std::string size) {
  if (right == expected) return {.verdict = FeatureVerdict::right, .size = std::move(size)};
  return {.verdict = FeatureVerdict::wrong,
          .size = std::move(size),
          .detail = fmt::format("{} of {} values are wrong", expected - right, expected)};
}

std::vector<FeatureRow> probe_features(const std::string& device, const std::string& only,
                                       std::chrono::seconds limit) {
  Prober prober(device, limit);
  auto listed = prober.send_request({{"probe", ""}});
  if (auto* reason = std::get_if<record::Reason>(&listed)) {
    return {failed_row("", std::move(*reason))};
  }
  std::vector<FeatureRow> rows;
  const nlohmann::json names = std::get<nlohmann::json>(listed).at("names");
  for (const nlohmann::json& each : names) {
    const std::string name = each;
    if (!only.empty() && name != only) continue;
    auto answer = prober.send_request({{"probe", name}});
    if (auto* reason = std::get_if<record::Reason>(&answer)) {
      rows.push_back(failed_row(name, std::move(*reason)));
    } else {
      rows.push_back({.name = name, .probed = as_probed(std::get<nlohmann::json>(answer))});
    }
  }
  prober.finish();
  return rows;
}

void answer_features(const Backend& backend, const std::string& device_id) {
  std::unique_ptr<Device> device;
  std::vector<FeatureProbe> probes;
  while (const auto request = receive(Process::child_request_fd)) {
    if (!device) {
      device = backend.open(device_id);
      if (auto* feature_prober = dynamic_cast<FeatureProber*>(device.get()))
        probes = feature_prober->feature_probes();
    }
    const std::string name = request->json.at("probe");
    const auto probe = std::ranges::find(probes, name, &FeatureProbe::name);
    if (probe != probes.end()) {
      bool lost = false;
      send(Process::child_answer_fd, as_message(run_probe(*probe, lost)));
      if (lost) {
        probes.clear();
        device.reset();
      }
      continue;
    }
    Message names{.json = {{"names", nlohmann::json::array()}}, .binary = {}};
    for (const FeatureProbe& each : probes) names.json["names"].push_back(each.name);
    send(Process::child_answer_fd, names);
  }
  probes.clear();  // before the device is closed, because the probes refer to it
}

}  // namespace triptych::measure
