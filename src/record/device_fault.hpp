#pragma once
// Faults that occur while a device is opened, calibrated or closed. They do not belong to any
// configuration.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace triptych::record {

enum class DeviceFaultKind : std::uint8_t {
  clock_reads_zero,      // the device's timer reads 0 for work that takes time
  clock_rate_wrong,      // the tick period of the device's timer differs from the reported period
  clock_not_written,     // the driver never wrote a time stamp
  statistics_all_zero,   // all pipeline statistics are 0, although the frame drew something
  statistics_crash,      // the driver crashes when it reads pipeline statistics
  statistics_not_ready,  // pipeline statistics never become available
  teardown_crash,        // the worker process crashes while it closes the device
  teardown_hang,         // the worker hangs while it closes the device
  memory_grows           // the driver does not free its memory (measure/run/memory_growth.hpp)
};
[[nodiscard]] std::string_view name_of(DeviceFaultKind kind);
[[nodiscard]] DeviceFaultKind device_fault_kind(std::string_view name);  // throws InputError

struct DeviceFault {
  DeviceFaultKind kind = DeviceFaultKind::clock_reads_zero;
  std::string subject = {};      // what is affected, such as a kind of work or a statistic
  std::string detail = {};       // the message of the driver, the library or the exception
  std::string last_output = {};  // the worker's last output
  bool operator==(const DeviceFault&) const = default;
};

void to_json(nlohmann::json& json, const DeviceFault& fault);
void from_json(const nlohmann::json& json, DeviceFault& fault);

}  // namespace triptych::record
