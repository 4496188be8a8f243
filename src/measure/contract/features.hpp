#pragma once
// Probes of features that visualization programs use but that Triptych's scenes do not need. Each
// probe is one small computation or draw with a known result.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace triptych::measure {

enum class FeatureVerdict : std::uint8_t { right, wrong, skipped };

struct ProbedFeature {
  FeatureVerdict verdict = FeatureVerdict::right;
  std::string size = {};    // the largest size that was used, such as "100000 draws"
  std::string detail = {};  // the error, or the reason for the skip
};

// Returns the verdict on a probe that produced `expected` values, of which `right` are correct.
// `size` describes the size of the probe, such as "100000 draws".
[[nodiscard]] ProbedFeature judged_feature(std::uint64_t right, std::uint64_t expected,
                                           std::string size);

// Returns how many of the values are correct, that is, equal to expected(i) for their index i.
template <class Value, class Expected>
[[nodiscard]] std::uint64_t count_right(const std::vector<Value>& values,
                                        const Expected& expected) {
  std::uint64_t right = 0;
  for (std::size_t i = 0; i < values.size(); ++i) right += values[i] == expected(i) ? 1U : 0U;
  return right;
}

struct FeatureProbe {
  std::string name;
  // Throws NotSupported with the reason if the device lacks the feature, and ApiError if a call
  // fails.
  std::function<ProbedFeature()> run;
};

// A device that can probe features implements this interface in addition to measure::Device.
class FeatureProber {
 public:
  FeatureProber() = default;
  FeatureProber(const FeatureProber&) = delete;
  FeatureProber& operator=(const FeatureProber&) = delete;
  virtual ~FeatureProber() = default;

  // Returns the API's probes. They must not be run after the device is destroyed.
  [[nodiscard]] virtual std::vector<FeatureProbe> feature_probes() = 0;
};

}  // namespace triptych::measure
