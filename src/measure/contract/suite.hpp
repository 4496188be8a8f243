#pragma once
// The contract between plans and a suite: which factors there are, and what a configuration means.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "accuracy/truth_pair.hpp"
#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/loading.hpp"
#include "record/expectation.hpp"
#include "scene/generators.hpp"

namespace triptych::measure {

enum class FactorKind : std::uint8_t {
  choice,  // one of `levels`
  number,  // a finite real number within [minimum, maximum], or one of `levels`
  text     // checked by Suite::check
};

struct Factor {
  std::string name;
  FactorKind kind = FactorKind::text;
  std::vector<std::string> levels;  // of a number, words that stand for one
  double minimum = 0;               // number only
  double maximum = 0;
  std::string standard;  // its value when a plan leaves it out; "auto": the device's default path
  bool of_scene = true;  // decides the picture, or only how it is computed
  // At its default it is no part of a scene's key: keys are older than the factor.
  bool silent_default = false;
  // What "auto" stands for in a plan, where it is no default: all of them are measured, and the
  // fastest is told (measure/request/fastest.hpp).
  std::vector<std::string> automatic = {};
  std::string summary;  // one line with unit and source, for --help and docs
};

// Factor → value as canonical text ("0.5", "orbit_y:1/8"); every factor of the suite is present.
using Configuration = std::map<std::string, std::string>;

// The work of a configuration without what its scene cannot tell.
struct PlainWork {
  // Every level that the scene cannot tell from a plainer one replaced by that one; without the
  // factor that `ends_below` stands for. The same levels and end: the same frames.
  Configuration levels;
  double ends_below = 0;                        // a ray ends below this transmittance; 0: never
  std::map<std::string, std::string> why = {};  // factor → why its level is replaced
};

class Suite {
 public:
  Suite() = default;
  Suite(const Suite&) = delete;
  Suite& operator=(const Suite&) = delete;
  virtual ~Suite() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual const std::vector<Factor>& factors() const = 0;
  // Checks a value beyond its kind; throws InputError saying what was expected.
  virtual void check(const Factor& factor, std::string_view value) const = 0;

  // What "generate:NAME:…" may name in its data; none where it takes no data.
  [[nodiscard]] virtual std::vector<scene::GeneratorInfo> generators() const { return {}; }

  // The plans that come with the suite: short name ("quick") and YAML text.
  [[nodiscard]] virtual std::vector<std::string_view> plan_names() const = 0;
  [[nodiscard]] virtual std::string_view plan_text(std::string_view plan) const = 0;

  // Empty when the data of the configuration is here, else why not (a file that is absent).
  [[nodiscard]] virtual std::string missing_data(const Configuration& configuration) const = 0;

  // Builds what is to be drawn; "auto" levels are resolved with the device and written back into
  // `configuration`. The suite keeps the last data set loaded, so that neighbours in a plan share
  // it.
  [[nodiscard]] virtual Work work(Configuration& configuration, const Device& device) = 0;
  // What `work` made of a configuration whose "auto" levels are resolved. A level may be replaced
  // only where the same samples, fragments and counts follow, not where merely the picture is the
  // same.
  [[nodiscard]] virtual PlainWork plain(const Configuration& configuration, const Work&) const {
    return {.levels = configuration};
  }
  // A work for calibrating clocks: small enough for a very slow device; calibrate_clock lengthens
  // it where it is too short to tell. Its picture tells nothing.
  [[nodiscard]] virtual Work calibration(technique::Work kind) = 0;

  // Whom to tell of every step of loading data (`paced` makes few of them); nobody when empty.
  void tell_of_loading(OnLoading tell) { on_loading_ = std::move(tell); }

 protected:
  void tell(const Loading& loading) const {
    if (on_loading_) on_loading_(loading);
  }

 private:
  OnLoading on_loading_;
};

// What the pictures of a scene tend to as its sampling is refined: errors against it are what
// sampling costs, beside all else.
struct Limit {
  core::Image image;
  core::Image uncertainty;  // per pixel in all four channels: how far it may be from the limit
};

// A suite whose pictures can be judged.
class SuiteWithTruth : public Suite {
 public:
  // `precision`: what Record::precision tells of the device's path. Throws as Suite::work does.
  [[nodiscard]] virtual accuracy::TruthPair truth(
      const Configuration& configuration, const std::map<std::string, double>& precision) = 0;
  // What another program needs to draw the same frame: "viewport", "camera" and the scene, as in
  // the `frame.json` of `triptych render`.
  [[nodiscard]] virtual nlohmann::json describe(const Configuration& configuration) = 0;
  // Two configurations with the same text share their truth and bound.
  [[nodiscard]] virtual std::string truth_key(const Configuration& configuration,
                                              const std::map<std::string, double>& precision) = 0;

  // By how much a counter may differ between two devices that are both right, as rounding decides
  // it; none is named that it does not decide.
  [[nodiscard]] virtual std::map<std::string, double> open_counts(
      const Configuration&, const std::map<std::string, double>&) {
    return {};
  }

  // Content hash of a configuration's data as they are now, in its voxel format, of which "auto" is
  // resolved: what Record::data_hash was when it was measured. Empty: it has no data. Throws as
  // Suite::work does.
  [[nodiscard]] virtual std::string data_hash(const Configuration&) { return {}; }

  // Two configurations with the same text share their limit; empty: they have none.
  [[nodiscard]] virtual std::string limit_key(const Configuration&) { return {}; }
  // Of a configuration with a limit_key.
  [[nodiscard]] virtual Limit limit(const Configuration&) { return {}; }
  // The picture by a formula, where the scene has one. It differs from the limit by what the data's
  // grid and tables cannot represent.
  [[nodiscard]] virtual std::optional<core::Image> closed_form(const Configuration&) {
    return std::nullopt;
  }

  // What must hold of a stress case beside its truth.
  [[nodiscard]] virtual std::vector<record::Expectation> expectations(const Configuration&) {
    return {};
  }
};

// Canonical text of the factors of a configuration that decide the picture: "camera=…,data=…".
// Without those with a silent default that have it.
[[nodiscard]] std::string scene_key(const Suite& suite, const Configuration& configuration);

}  // namespace triptych::measure
