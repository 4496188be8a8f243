#pragma once
// Describes how accurately a driver counts a pipeline statistic. To find out, Triptych draws scenes
// whose correct counts are known (measure/protocol/statistics_calibration.hpp).

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

enum class Worth : std::uint8_t {
  exact,          // correct in every scene
  counts,         // always equal to a different quantity, Triptych's counter `counter`
  proportional,   // always `low` times the correct count
  inflated,       // between `low` and `high` times the correct count
  differs,        // wrong in at least one scene
  unsteady,       // changes when the same frame is drawn again
  absent,         // never reported
  unknown,        // a scene could not be drawn
  not_calibrated  // no calibration scene was drawn for the statistic
};
[[nodiscard]] std::string_view name_of(Worth worth);
[[nodiscard]] Worth worth(std::string_view name);  // throws InputError

struct StatisticWorth {
  Worth worth = Worth::exact;
  double low = 1;   // smallest ratio of the reported count to the correct count
  double high = 1;  // largest ratio of the reported count to the correct count
  std::string counter = {};
  std::string detail = {};  // names of the affected scenes
  bool operator==(const StatisticWorth&) const = default;

  [[nodiscard]] bool is_exact() const { return worth == Worth::exact; }
  // Returns whether the count changes when the same frame is drawn again. Such a statistic is never
  // compared.
  [[nodiscard]] bool is_unsteady() const { return worth == Worth::unsteady; }
};

void to_json(nlohmann::json& json, const StatisticWorth& worth);
// Reads an object, or a string that is the name of a Worth. Throws InputError.
void from_json(const nlohmann::json& json, StatisticWorth& worth);

}  // namespace triptych::record
