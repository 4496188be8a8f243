#pragma once
// The interface between plans and a suite. A suite defines its factors and converts a configuration
// to work that a device can draw.

#include <cstdint>
#include <filesystem>
#include <functional>
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
  std::vector<std::string> levels;  // for a number: words that may be used instead
  double minimum = 0;               // for a number
  double maximum = 0;
  std::string default_value;     // the default value; "auto": the device chooses the level
  bool determines_image = true;  // true: determines the image; false: only how it is computed
  // True for a factor that was added to the suite after scene keys had been stored. To keep those
  // keys valid, a scene key contains such a factor only if it does not have its default value.
  bool silent_default = false;
  // The levels that "auto" stands for in a plan. All of these levels are measured, and the fastest
  // is reported (measure/request/fastest.hpp). Must be empty if the default value is "auto", with
  // which the device chooses the level.
  std::vector<std::string> automatic = {};
  std::string summary;  // one line with unit and source, for --help and docs
};

// A map from each factor of the suite to its value in canonical spelling ("0.5", "orbit_y:1/8").
using Configuration = std::map<std::string, std::string>;

// A configuration, reduced to the levels that affect the work in its scene.
struct PlainWork {
  // The levels of all factors except early ray termination. Every level that has no effect in this
  // scene is replaced by a simpler level. Configurations with equal `levels` and equal `ends_below`
  // have identical frames.
  Configuration levels;
  double ends_below = 0;  // a ray ends if its transmittance falls below this value; 0: never
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
  // Applies the suite's own rules to a value that already satisfies the rules of its FactorKind.
  // Throws an InputError that states the expected form.
  virtual void check(const Factor& factor, std::string_view value) const = 0;

  // Returns the generators that can be used as NAME in data=generate:NAME:…. Returns an empty list
  // if the suite has no data.
  [[nodiscard]] virtual std::vector<scene::GeneratorInfo> generators() const { return {}; }

  // Return the plans that come with the suite: their short names, such as "quick", and their YAML.
  [[nodiscard]] virtual std::vector<std::string_view> plan_names() const = 0;
  [[nodiscard]] virtual std::string_view plan_text(std::string_view plan) const = 0;

  // Returns the reason why the configuration's data is unavailable, such as a missing file. Returns
  // an empty string if the data is available.
  [[nodiscard]] virtual std::string missing_data(const Configuration& configuration) const = 0;

  // Creates the work to be drawn. Replaces "auto" levels in `configuration` by the levels that suit
  // the device. The suite keeps the most recently loaded data set, so that consecutive
  // configurations of a plan can share it.
  [[nodiscard]] virtual Work work(Configuration& configuration, const Device& device) = 0;
  // Returns the plain work of a configuration (see PlainWork). All "auto" levels of the
  // configuration have been replaced. An implementation may replace a level only if all samples,
  // fragments and counts stay the same. It is not sufficient that the image stays the same.
  [[nodiscard]] virtual PlainWork plain(const Configuration& configuration, const Work&) const {
    return {.levels = configuration};
  }
  // Returns a work for calibrating clocks. It is small enough for a very slow device; on a fast
  // device, calibrate_clock() enlarges it. Its image has no meaning.
  [[nodiscard]] virtual Work calibration(technique::Work kind) = 0;

  // Sets the function that receives progress reports while data is loaded. An empty function
  // disables the reports. throttled() reduces their number.
  void set_on_loading(OnLoading on_loading) { on_loading_ = std::move(on_loading); }

 protected:
  void report_loading(const Loading& loading) const {
    if (on_loading_) on_loading_(loading);
  }

 private:
  OnLoading on_loading_;
};

// The progress of rendering a reference image or a limit image on the host, which takes minutes for
// a large image.
struct Rendering {
  enum class Image : std::uint8_t { reference, limit };
  Image image = Image::reference;
  std::string viewport;  // the level of the factor `viewport`
  double share = 0;      // completed fraction of the image, in [0, 1]
};
using OnRendering = std::function<void(const Rendering&)>;

// The limit image of a scene, to which its images converge as the sampling is refined. The
// difference between an image and the limit image contains the sampling error and all other errors.
struct Limit {
  core::Image image;
  // The largest possible difference between `image` and the exact limit image, for each pixel and
  // in each of the four channels.
  core::Image uncertainty;
};

// A suite with a reference renderer, which makes it possible to judge images.
class SuiteWithTruth : public Suite {
 public:
  // Returns the reference image and its bound, which is the largest difference from the reference
  // image that a correct device can produce in each pixel. `precision` is Record::precision: the
  // properties of the device that determine the bound. Throws the same exceptions as Suite::work().
  [[nodiscard]] virtual accuracy::TruthPair truth(
      const Configuration& configuration, const std::map<std::string, double>& precision) = 0;
  // Returns the description that another program needs to draw the same frame: "viewport", "camera"
  // and the scene. `triptych render` writes it to the file `frame.json`.
  [[nodiscard]] virtual nlohmann::json describe(const Configuration& configuration) = 0;
  // Returns lines that describe the data of a configuration, for `render --describe`. Throws the
  // same exceptions as Suite::work().
  [[nodiscard]] virtual std::vector<std::string> describe_data(const Configuration& /*chosen*/) {
    return {};
  }
  // Returns a key. Configurations with the same key share their reference image and its bound.
  [[nodiscard]] virtual std::string truth_key(const Configuration& configuration,
                                              const std::map<std::string, double>& precision) = 0;

  // Returns the difference that is allowed between two correct devices, for each counter that
  // depends on rounding. All other counters are absent.
  [[nodiscard]] virtual std::map<std::string, double> open_counts(
      const Configuration&, const std::map<std::string, double>&) {
    return {};
  }

  // Returns the content hash of a configuration's data, as currently stored and in the
  // configuration's voxel format, with "auto" resolved. It equals Record::data_hash if the data
  // have not changed since the measurement. Empty if there is no data. Throws the same exceptions
  // as Suite::work().
  [[nodiscard]] virtual std::string data_hash(const Configuration&) { return {}; }

  // Returns a key. Configurations with the same key share their limit image (see Limit). The key is
  // empty if there is no limit image.
  [[nodiscard]] virtual std::string limit_key(const Configuration&) { return {}; }
  // Returns the limit image of a configuration. Its limit_key() must not be empty.
  [[nodiscard]] virtual Limit limit(const Configuration&) { return {}; }
  // Returns the image that results from the closed-form solution, if the scene has one. It differs
  // from the limit image (see Limit) by the errors of the voxel grid and of the lookup tables,
  // whose resolution is finite.
  [[nodiscard]] virtual std::optional<core::Image> closed_form(const Configuration&) {
    return std::nullopt;
  }

  // Returns the conditions that a stress case must satisfy in addition to its error bound.
  [[nodiscard]] virtual std::vector<record::Expectation> expectations(const Configuration&) {
    return {};
  }

  // Sets the function that receives progress reports while a reference image or a limit image is
  // rendered: with share 0 at the beginning and 1 at the end. An empty function disables them.
  void set_on_rendering(OnRendering on_rendering) { on_rendering_ = std::move(on_rendering); }

 protected:
  void report_rendering(const Rendering& rendering) const {
    if (on_rendering_) on_rendering_(rendering);
  }

 private:
  OnRendering on_rendering_;
};

// Returns the factors of a configuration that determine the image, in canonical spelling:
// "camera=…,data=…". A factor with `silent_default` is left out if it has its default value.
[[nodiscard]] std::string scene_key(const Suite& suite, const Configuration& configuration);

}  // namespace triptych::measure
