#pragma once
// The verdict on a run, from records and baselines alone.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "judge/accuracy/cases.hpp"
#include "judge/baselines/baselines.hpp"
#include "judge/correlation/pair.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::judge {

using record::Check;
using record::check;
using record::name_of;
// What one launch on a busy machine cannot decide.
[[nodiscard]] bool is_of_times(Check check);

enum class Verdict : std::uint8_t {
  pass,
  improved,      // passes, and is better than the baseline beyond doubt
  advisory,      // worth knowing, decides nothing: too few stored runs, another driver version
  skipped,       // the device cannot do this; the reason is the message
  waived,        // a regression that waivers.json excuses until its expiry
  cannot_judge,  // no baseline, nothing measured, noise: never a pass
  regression
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

// One answer about one configuration on one device (both empty where the finding is about the whole
// plan).
struct Finding {
  Check check = Check::image;
  Verdict verdict = Verdict::pass;
  std::string test;  // test id, Record::test_id
  std::string device;
  std::string configuration;
  std::string message;  // one line: what, by how much, against which bound, what to do about it
  std::map<std::string, double> numbers;  // "max_error", "bound", "rmse", "ratio", …
  // What of the device and configuration, where that is not all of it: "program", "step=0.5"; of a
  // correlation also by which device. The same in every launch.
  std::string subject = {};
};

struct GateResult {
  std::string plan;
  std::string run;
  std::vector<Finding> findings;                   // worst first, then by device and configuration
  std::vector<CorrelationPair> correlations = {};  // where that was checked
  std::vector<AccuracyScene> accuracies = {};      // likewise; by device, then as measured
  std::set<std::string> devices = {};              // that measured something, of those asked for
  std::set<std::string> measured_again = {};       // of these, all of it, by another launch
  // On which something may be slower that is no regression yet, noise left a time open or kept a
  // stored device from judging; and all with a regression in time. Another launch should settle it.
  std::set<std::string> in_doubt = {};
  // Of which all findings are advice or reasons for not judging.
  [[nodiscard]] std::vector<std::string> nothing_decided() const;
  // In doubt, and no other launch has settled it.
  [[nodiscard]] std::vector<std::string> left_in_doubt() const;
  [[nodiscard]] core::ExitCode exit_code() const;
  [[nodiscard]] std::string headline()
      const;  // "FAIL: 2 regressions in image on vulkan:lavapipe; 96 checks, 4 devices"
};

// A regression in time: of numbers, where a crash that a check of times reports is none.
[[nodiscard]] bool is_slower(const Finding& finding);

// {"plan", "run", "exit_code", "headline", "findings": [{"check", "verdict", "test", "device",
// "configuration", "message", "numbers"}], "in_doubt": [device], "measured_again": [device],
// "correlations": [as of the pair], "accuracies": [as of the scene]}
[[nodiscard]] nlohmann::json to_json(const GateResult& result);
// {"device_a", "device_b", "signal", "new_device", "line": {"configurations", "intercept", "slope",
// "scale", "rho", "pearson", "admitted", "refusal"}, "points": [{"configuration", "x", "y",
// "residual", "outlier"}]}; what is no number is null.
[[nodiscard]] nlohmann::json to_json(const CorrelationPair& pair);

struct GateRequest {
  std::string plan;
  std::set<Check> checks;  // empty: all; the correlation only of a plan
                           // SUITE/correlation, accuracy only of a plan SUITE/accuracy; of a plan
                           // SUITE/stress counters and stress
  std::vector<std::string> devices;  // globs; empty: all in the run
  std::vector<std::string>
      required_devices;  // globs; each must match a device that measured something
  // The truth for a record's scene with the bound that holds for the record's path. Computed by the
  // suite, cached in the store by the caller.
  FindTruth truth;
  // The limit of a record's scene, nullptr where it has none; it lives as long as the request.
  std::function<const LimitPicture*(const record::Record&)> limit = {};
  // What must hold of a record beside its truth; nothing: no record has any.
  FindExpectations expectations = {};
  std::string today;  // ISO date, for the expiry of waivers
};

// Another run of the same plan by the same program on the same machine.
struct Launch {
  const record::Store* store;  // which also holds the anchors measured beside it
  std::string run;
  std::optional<std::set<std::string>> devices =
      {};  // counts of these; nullopt: of all it measured
};

// Times are judged by the quieter of all launches (judge/gate/confirmation.hpp), everything else by
// the first. Throws InputError for a corrupt baseline (file and line), never because of what was
// measured.
[[nodiscard]] GateResult judge_launches(const Launch& first, std::span<const Launch> again,
                                        const Baselines& baselines, const GateRequest& request);

// A run with every one in the store that confirms it.
[[nodiscard]] GateResult judge_run(const record::Store& store, const std::string& run,
                                   const Baselines& baselines, const GateRequest& request);

}  // namespace triptych::judge
