#pragma once
// How exactly a driver counts a pipeline statistic, determined with scenes whose numbers are known
// (measure/protocol/statistics_calibration.hpp).

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

enum class Worth : std::uint8_t {
  exact,          // the true number in every scene
  counts,         // always the value of Triptych's counter `counter`, which is another quantity
  proportional,   // always "low" times the true number
  inflated,       // between "low" and "high" times the true number
  differs,        // not the true number in some scene
  unsteady,       // not the same number when the same frame is drawn again
  absent,         // never reported
  unknown,        // a scene could not be drawn
  not_calibrated  // no scene was drawn for it
};
[[nodiscard]] std::string_view name_of(Worth worth);
[[nodiscard]] Worth worth(std::string_view name);  // throws InputError

struct StatisticWorth {
  Worth worth = Worth::exact;
  double low = 1;   // reported number over true number: the least
  double high = 1;  // and the greatest
  std::string counter = {};
  std::string detail = {};  // in which scenes, for people
  bool operator==(const StatisticWorth&) const = default;

  [[nodiscard]] bool is_exact() const { return worth == Worth::exact; }
  // The number differs when the same frame is drawn again, so it is never compared.
  [[nodiscard]] bool is_unsteady() const { return worth == Worth::unsteady; }
};

void to_json(nlohmann::json& json, const StatisticWorth& worth);
// Also reads a bare name of a Worth. Throws InputError.
void from_json(const nlohmann::json& json, StatisticWorth& worth);

}  // namespace triptych::record
