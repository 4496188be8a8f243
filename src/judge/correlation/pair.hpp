#pragma once
// The comparison of two devices, configuration by configuration, for the report and for `gate
// --json`.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// The reason why nothing can be concluded from a line. The limits are in LineModel.
enum class LineRefusal : std::uint8_t {
  none,
  too_few_configurations,
  low_correlation,
  slope_out_of_range,
  large_scatter
};
[[nodiscard]] std::string_view name_of(LineRefusal refusal);

// y = intercept + slope·x, both as logarithms, so that a constant factor between two devices is the
// intercept.
struct CorrelationLine {
  std::size_t configurations = 0;
  // NaN if there are too few points for a line.
  double intercept = 0;
  double slope = 0;
  double scale = 0;    // robust standard deviation of the residuals, in ln
  double rho = 0;      // Pearson's r of the logarithms
  double pearson = 0;  // correlation of the values themselves, as in the paper
  LineRefusal refusal = LineRefusal::none;

  [[nodiscard]] bool admitted() const { return refusal == LineRefusal::none; }
  [[nodiscard]] double at(double x) const { return intercept + slope * x; }
};

struct CorrelationPoint {
  std::string configuration;
  double x = 0;          // ln of the signal on device_a
  double y = 0;          // ln of it on device_b
  double residual = 0;   // y − the line at x; NaN without a line
  bool outlier = false;  // a finding names it for one of the two devices; always false for times
};

// Each pair of devices appears once for each signal.
struct CorrelationPair {
  // The device on the x axis: the accepted one if the other is new, otherwise the one with the
  // lesser id. The name is an id if the device is in the run, otherwise the stored id with its
  // driver version.
  std::string device_a;
  std::string device_b;
  std::string signal;  // "cost": instructions per frame; "time": nanoseconds per frame
  // For cost: device_b has no stored costs, so that only the line can reveal a problem.
  bool new_device = false;
  CorrelationLine line = {};
  std::vector<CorrelationPoint> points = {};  // one for each configuration
};

}  // namespace triptych::judge
