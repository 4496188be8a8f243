#include "record/device_fault.hpp"

#include "record/names.hpp"

namespace triptych::record {
namespace {

constexpr Names<DeviceFaultKind, 9> kind_names{{
    {DeviceFaultKind::clock_reads_zero, "clock_reads_zero"},
    {DeviceFaultKind::clock_rate_wrong, "clock_rate_wrong"},
    {DeviceFaultKind::clock_not_written, "clock_not_written"},
    {DeviceFaultKind::statistics_all_zero, "statistics_all_zero"},
    {DeviceFaultKind::statistics_crash, "statistics_crash"},
    {DeviceFaultKind::statistics_not_ready, "statistics_not_ready"},
    {DeviceFaultKind::teardown_crash, "teardown_crash"},
    {DeviceFaultKind::teardown_hang, "teardown_hang"},
    {DeviceFaultKind::memory_grows, "memory_grows"},
}};

}  // namespace

std::string_view name_of(DeviceFaultKind kind) {
  return name_in(kind_names, kind);
}

DeviceFaultKind device_fault_kind(std::string_view name) {
  return value_named(kind_names, "kind of device fault", name);
}

}  // namespace triptych::record
