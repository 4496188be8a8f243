#pragma once
// How exactly a driver counts a pipeline statistic, as scenes with a known answer showed
// (measure/protocol/statistics_calibration.hpp).

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

enum class Worth : std::uint8_t {
  exact,          // the true number in every scene
  counts,         // always the counter `counter` of Triptych, which is another quantity
  proportional,   // always "low" times the true number
  inflated,       // "low" to "high" times the true number
  differs,        // another number in some scene
  unsteady,       // another number for the same frame when drawn again
  absent,         // never reported
  unknown,        // a scene could not be drawn
  not_calibrated  // no scene was drawn for it
};
[[nodiscard]] std::string_view name_of(Worth worth);
[[nodiscard]] Worth worth(std::string_view name);  // throws InputError

struct StatisticWorth {
  Worth worth = Worth::exact;
  double low = 1;   // reported over true, at least
  double high = 1;  // at most
  std::string counter = {};
  std::string detail = {};  // in which scenes, for people
  bool operator==(const StatisticWorth&) const = default;

  [[nodiscard]] bool is_exact() const { return worth == Worth::exact; }
  // The number changes when the same frame is drawn again, so it is never compared.
  [[nodiscard]] bool is_unsteady() const { return worth == Worth::unsteady; }
};

void to_json(nlohmann::json& json, const StatisticWorth& worth);
// Also reads the bare name of a worth. Throws InputError.
void from_json(const nlohmann::json& json, StatisticWorth& worth);

}  // namespace triptych::record
