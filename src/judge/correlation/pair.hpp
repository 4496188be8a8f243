#pragma once
// Two devices, point by point: what the report draws and `gate --json` gives.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::judge {

// Why nothing can be concluded from a line; LineModel has the limits.
enum class LineRefusal : std::uint8_t {
  none,
  too_few_configurations,
  low_correlation,
  slope_out_of_range,
  large_scatter
};
[[nodiscard]] std::string_view name_of(LineRefusal refusal);

// y = intercept + slope·x of logarithms, so that a factor between two devices is the intercept.
struct CorrelationLine {
  std::size_t configurations = 0;
  // NaN where there are too few points for a line.
  double intercept = 0;
  double slope = 0;
  double scale = 0;    // robust standard deviation of the residuals, in ln
  double rho = 0;      // Pearson's r of the logarithms
  double pearson = 0;  // of the values themselves, as the paper has it
  LineRefusal refusal = LineRefusal::none;

  [[nodiscard]] bool admitted() const { return refusal == LineRefusal::none; }
  [[nodiscard]] double at(double x) const { return intercept + slope * x; }
};

struct CorrelationPoint {
  std::string configuration;
  double x = 0;          // ln of the signal on device_a
  double y = 0;          // ln of it on device_b
  double residual = 0;   // y − the line at x; NaN without a line
  bool outlier = false;  // a finding names it on one of the two devices; never so of times
};

// Each pair of devices once per signal.
struct CorrelationPair {
  // Along x: the accepted one where the other is new, else the lesser id. An id where the device is
  // in the run, else the stored id with its driver version.
  std::string device_a;
  std::string device_b;
  std::string signal;       // "cost": instructions per frame; "time": nanoseconds per frame
  bool new_device = false;  // of cost: device_b has none stored, so that only the line can tell
  CorrelationLine line = {};
  std::vector<CorrelationPoint> points = {};  // by configuration
};

}  // namespace triptych::judge
