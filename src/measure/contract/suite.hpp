#pragma once
// The interface between plans and a suite: the factors of the suite, and the work of a
// configuration.

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
  number,  // a finite real number in [minimum, maximum], or one of `levels`
  text     // checked by Suite::check
};

struct Factor {
  std::string name;
  FactorKind kind = FactorKind::text;
  std::vector<std::string> levels;  // for a number: words that may be written instead of it
  double minimum = 0;               // for a number
  double maximum = 0;
  std::string standard;  // value if a plan does not set it; "auto": the device's default path
  bool of_scene = true;  // true if it decides the image, false if only how it is computed
  // True for a factor that was added after scene keys had been stored: a scene's key leaves it out
  // if it has its default.
  bool silent_default = false;
  // The levels that "auto" stands for in a plan, if "auto" is not the default: all of them are
  // measured, and the fastest is reported (measure/request/fastest.hpp).
  std::vector<std::string> automatic = {};
  std::string summary;  // one line with unit and source, for --help and docs
};

// Factor → value in its canonical spelling ("0.5", "orbit_y:1/8"). Every factor of the suite is
// present.
using Configuration = std::map<std::string, std::string>;

// The work of a configuration, reduced to the levels that make a difference in its scene.
struct PlainWork {
  // Every level that makes no difference in this scene is replaced by a simpler one, and the factor
  // for early ray termination is removed. Configurations with the same levels and the same
  // `ends_below` have the same frames.
  Configuration levels;
  double ends_below = 0;                        // a ray ends below this transmittance; 0: never
  std::map<std::string, std::string> why = {};  // factor → reason why its level is replaced
};

class Suite {
 public:
  Suite() = default;
  Suite(const Suite&) = delete;
  Suite& operator=(const Suite&) = delete;
  virtual ~Suite() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual const std::vector<Factor>& factors() const = 0;
  // Checks a value beyond the rules of its kind. Throws InputError with the expected form.
  virtual void check(const Factor& factor, std::string_view value) const = 0;

  // The generators that data=generate:NAME:… may name; empty if the suite has no data.
  [[nodiscard]] virtual std::vector<scene::GeneratorInfo> generators() const { return {}; }

  // The plans that come with the suite: short names such as "quick", and their YAML texts.
  [[nodiscard]] virtual std::vector<std::string_view> plan_names() const = 0;
  [[nodiscard]] virtual std::string_view plan_text(std::string_view plan) const = 0;

  // The reason why the configuration's data is not available (a missing file); empty if it is.
  [[nodiscard]] virtual std::string missing_data(const Configuration& configuration) const = 0;

  // Makes the work that is to be drawn. Levels "auto" are resolved with the device and written back
  // to `configuration`. The suite keeps the last data set loaded, so that neighbouring
  // configurations of a plan share it.
  [[nodiscard]] virtual Work work(Configuration& configuration, const Device& device) = 0;
  // The equivalent plain work of a configuration whose "auto" levels are resolved. A level may be
  // replaced only if the samples, fragments and counts stay the same. It is not sufficient that the
  // image stays the same.
  [[nodiscard]] virtual PlainWork plain(const Configuration& configuration, const Work&) const {
    return {.levels = configuration};
  }
  // A work for calibrating clocks. It is small enough for a very slow device; calibrate_clock makes
  // it longer on a fast one. Its image has no meaning.
  [[nodiscard]] virtual Work calibration(technique::Work kind) = 0;

  // Sets the receiver of progress while data is loaded (`paced` reduces the number of reports);
  // empty for none.
  void tell_of_loading(OnLoading tell) { on_loading_ = std::move(tell); }

 protected:
  void tell(const Loading& loading) const {
    if (on_loading_) on_loading_(loading);
  }

 private:
  OnLoading on_loading_;
};

// The image to which a scene converges as its sampling is refined. The error against it consists of
// the sampling error and all other errors.
struct Limit {
  core::Image image;
  core::Image uncertainty;  // per pixel in all four channels: distance from the exact limit
};

// A suite with a reference renderer, which makes it possible to judge images.
class SuiteWithTruth : public Suite {
 public:
  // `precision` is Record::precision, which describes the device's path. Throws like Suite::work.
  [[nodiscard]] virtual accuracy::TruthPair truth(
      const Configuration& configuration, const std::map<std::string, double>& precision) = 0;
  // The data that another program needs to draw the same frame: "viewport", "camera" and the scene,
  // as in `frame.json` of `triptych render`.
  [[nodiscard]] virtual nlohmann::json describe(const Configuration& configuration) = 0;
  // Lines that describe the data of a configuration, for `render --describe`. Throws like
  // Suite::work.
  [[nodiscard]] virtual std::vector<std::string> describe_data(const Configuration& /*chosen*/) {
    return {};
  }
  // Two configurations with the same key share their reference image and bound.
  [[nodiscard]] virtual std::string truth_key(const Configuration& configuration,
                                              const std::map<std::string, double>& precision) = 0;

  // The allowed difference between two correct devices for each counter that depends on rounding.
  // Other counters are absent.
  [[nodiscard]] virtual std::map<std::string, double> open_counts(
      const Configuration&, const std::map<std::string, double>&) {
    return {};
  }

  // The content hash of a configuration's data as they are now, in its voxel format, with "auto"
  // resolved. It equals Record::data_hash if the data have not changed since they were measured.
  // Empty if there is no data. Throws like Suite::work.
  [[nodiscard]] virtual std::string data_hash(const Configuration&) { return {}; }

  // Two configurations with the same key share their limit; empty if they have none.
  [[nodiscard]] virtual std::string limit_key(const Configuration&) { return {}; }
  // The limit of a configuration that has a limit_key.
  [[nodiscard]] virtual Limit limit(const Configuration&) { return {}; }
  // The image from a formula, if the scene has one. It differs from the limit by the part that the
  // data's grid and tables cannot represent.
  [[nodiscard]] virtual std::optional<core::Image> closed_form(const Configuration&) {
    return std::nullopt;
  }

  // The expectations of a stress case in addition to the bound on its error.
  [[nodiscard]] virtual std::vector<record::Expectation> expectations(const Configuration&) {
    return {};
  }
};

// The factors of a configuration that decide the image, in canonical spelling: "camera=…,data=…".
// Factors with a silent default that have it are left out.
[[nodiscard]] std::string scene_key(const Suite& suite, const Configuration& configuration);

}  // namespace triptych::measure
