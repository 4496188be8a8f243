#include "measure/plant.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <optional>
#include <utility>

#include "core/error.hpp"

namespace triptych::measure {
namespace {

using technique::Fault;

constexpr std::array<std::pair<std::string_view, Fault>, 5> faults{{
    {"half_voxel_shift", Fault::half_voxel_shift},
    {"flipped_axis", Fault::flipped_axis},
    {"extra_sample", Fault::extra_sample},
    {"uncorrected_opacity", Fault::uncorrected_opacity},
    {"coarse_filter", Fault::coarse_filter},
}};
constexpr std::array<std::string_view, 3> mishaps{"crash", "hang", "device_lost"};
constexpr std::string_view slowdown = "slowdown:";

std::optional<Fault> fault_named(std::string_view name) {
  for (const auto& [each, fault] : faults) {
    if (each == name) return fault;
  }
  return std::nullopt;
}

// Every stride-th row twice is 1/stride more work. Empty when `text` is no percentage in (0, 100].
std::optional<int> stride_of(std::string_view text) {
  double percent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  constexpr double least_percent = 0.01;
  if (!(percent >= least_percent && percent <= 100)) return std::nullopt;
  return static_cast<int>(std::lround(100 / percent));
}

bool is_mishap(std::string_view fault) {
  for (const std::string_view each : mishaps) {
    if (each == fault) return true;
  }
  return false;
}

[[noreturn]] void crash() {
  std::signal(SIGSEGV, SIG_DFL);  // a sanitizer's handler would turn the signal into an exit code
  std::raise(SIGSEGV);
  std::abort();
}

[[noreturn]] void hang() {
  for (;;) ::pause();
}

}  // namespace

void check_plant(std::string_view fault) {
  if (fault_named(fault) || is_mishap(fault)) return;
  if (fault.starts_with(slowdown) && stride_of(fault.substr(slowdown.size()))) return;
  std::vector<std::string_view> names;
  for (const auto& [name, unused] : faults) names.push_back(name);
  names.insert(names.end(), mishaps.begin(), mishaps.end());
  throw core::InputError(
      fmt::format("unknown fault '{}'; there are: {}, slowdown:PERCENT (0.01 to 100)", fault,
                  fmt::join(names, ", ")));
}

void apply_plant(std::string_view fault, Work& work) {
  check_plant(fault);
  if (fault == "crash") crash();
  if (fault == "hang") hang();
  if (fault == "device_lost") throw core::DeviceLost("plant", "device_lost");
  auto* volume = std::get_if<VolumeWork>(&work.scene);
  if (volume == nullptr) {
    throw core::NotSupported(
        fmt::format("technique {} has no fault '{}' to plant", work.technique, fault));
  }
  if (const auto planted = fault_named(fault)) {
    volume->options.fault = *planted;
  } else {
    volume->options.extra_work_stride = *stride_of(fault.substr(slowdown.size()));
  }
}

}  // namespace triptych::measure
