#pragma once
// The costs or times of two devices, configuration by configuration, for the report and for the
// JSON output of `gate`.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// The reason why the line that was fitted to the costs of two devices cannot be used to judge one
// of them. The thresholds are in LineModel.
enum class LineRefusal : std::uint8_t {
  none,
  too_few_configurations,
  low_correlation,
  slope_out_of_range,
  large_scatter
};
[[nodiscard]] std::string_view name_of(LineRefusal refusal);

// The line y = intercept + slope·x that is fitted to the costs or times of two devices. Both x and
// y are logarithms, so the intercept represents a constant factor between the devices.
struct CorrelationLine {
  std::size_t configurations = 0;
  // All following numbers are NaN if there are too few points for a line.
  double intercept = 0;
  double slope = 0;
  double scale = 0;    // robust standard deviation of the residuals, in ln
  double rho = 0;      // Pearson's r of the logarithms
  double pearson = 0;  // Pearson's r of the values themselves, as in the paper (docs/paper.md)
  LineRefusal refusal = LineRefusal::none;

  [[nodiscard]] bool admitted() const { return refusal == LineRefusal::none; }
  [[nodiscard]] double at(double x) const { return intercept + slope * x; }
};

struct CorrelationPoint {
  std::string configuration;
  double x = 0;          // ln of the cost or time on device_a
  double y = 0;          // ln of the cost or time on device_b
  double residual = 0;   // y minus the value of the line at x; NaN if there is no line
  bool outlier = false;  // whether a finding names this configuration; always false for times
};

// Two devices. Each pair of devices occurs once for costs and once for times.
struct CorrelationPair {
  // The device on the x axis. If one device is accepted and the other is new, it is the accepted
  // device, otherwise the device whose id comes first. Both names are device ids, followed by the
  // driver version for a device that is not in the run.
  std::string device_a;
  std::string device_b;
  std::string signal;  // "cost": instructions per frame; "time": nanoseconds per frame
  // For costs: whether device_a has stored costs and device_b has none, so that only the line can
  // reveal a problem of device_b.
  bool new_device = false;
  CorrelationLine line = {};
  std::vector<CorrelationPoint> points = {};  // one for each configuration
};

}  // namespace triptych::judge
