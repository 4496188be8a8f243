#include "measure/protocol/injected_fault.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/glob.hpp"
#include "measure/system/crash_trace.hpp"
#include "record/factor_list.hpp"

namespace triptych::measure {
namespace {

using technique::Fault;
using technique::ParticleFault;

constexpr std::array<std::pair<std::string_view, Fault>, 5> volume_faults{{
    {"half_voxel_shift", Fault::half_voxel_shift},
    {"flipped_axis", Fault::flipped_axis},
    {"extra_sample", Fault::extra_sample},
    {"uncorrected_opacity", Fault::uncorrected_opacity},
    {"coarse_filter", Fault::coarse_filter},
}};
constexpr std::array<std::pair<std::string_view, ParticleFault>, 8> particle_faults{{
    {"small_sprite", ParticleFault::small_sprite},
    {"unresolved_ties", ParticleFault::unresolved_ties},
    {"reversed_depth", ParticleFault::reversed_depth},
    {"wrong_sense", ParticleFault::wrong_sense},
    {"culled_visible", ParticleFault::culled_visible},
    {"lost_at_border", ParticleFault::lost_at_border},
    {"missing_barrier", ParticleFault::missing_barrier},
    {"small_box", ParticleFault::small_box},
}};
constexpr std::array<std::string_view, 3> immediate_faults{"crash", "hang", "device_lost"};
constexpr std::string_view slowdown = "slowdown:";
constexpr std::string_view lost_counter = "lost_counter";

template <typename Faults>
auto find_named(const Faults& faults, std::string_view name) {
  const auto found = std::ranges::find(faults, name, &Faults::value_type::first);
  return found == faults.end() ? std::nullopt : std::optional(found->second);
}

// Converts a percentage of extra work to a stride: if one in every `stride` units of work is done
// twice, the extra work is 1/stride of the work. Returns nullopt if `text` is not a percentage from
// 0.01 to 100.
std::optional<int> stride_of(std::string_view text) {
  double percent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  constexpr double least_percent = 0.01;
  if (!(percent >= least_percent && percent <= 100)) return std::nullopt;
  return static_cast<int>(std::lround(100 / percent));
}

bool is_immediate_fault(std::string_view fault) {
  for (const std::string_view each : immediate_faults) {
    if (each == fault) return true;
  }
  return false;
}

// Returns whether a configuration has all levels of a list such as "technique=raycast,step=2".
bool has_levels(const std::string& configuration, const std::string& levels) {
  const auto required = record::parse_factor_list(levels);
  const auto actual = record::parse_factor_list(configuration);
  return !required.empty() && std::ranges::all_of(required, [&](const auto& level) {
    const auto found = actual.find(level.first);
    return found != actual.end() && found->second == level.second;
  });
}

[[noreturn]] void crash() {
  // Replaces a sanitizer's handler, which would exit with a code instead of ending the process with
  // a signal.
  install_stack_trace_handlers();
  std::raise(SIGSEGV);
  std::abort();
}

[[noreturn]] void hang() {
  for (;;) ::pause();
}

}  // namespace

std::vector<InjectedFault> parse_faults(std::span<const std::string> faults) {
  std::vector<InjectedFault> parsed;
  for (const std::string& each : faults) {
    const auto at = each.find('@');
    parsed.push_back({.fault = each.substr(0, at),
                      .only = at == std::string::npos ? std::string{} : each.substr(at + 1)});
  }
  return parsed;
}

std::vector<std::string> faults_for(std::span<const InjectedFault> all,
                                    const std::string& configuration, const std::string& device) {
  std::vector<std::string> faults;
  for (const InjectedFault& fault : all) {
    const auto matches = [&fault](const std::string& text) {
      return core::glob_matches(fault.only, text);
    };
    if (fault.only.empty() || matches(configuration) || matches(device) ||
        has_levels(configuration, fault.only)) {
      faults.push_back(fault.fault);
    }
  }
  return faults;
}

std::string fault_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, unused] : volume_faults) names.push_back(name);
  for (const auto& [name, unused] : particle_faults) names.push_back(name);
  names.insert(names.end(), immediate_faults.begin(), immediate_faults.end());
  names.push_back(lost_counter);
  return fmt::format("{}, slowdown:PERCENT (0.01 to 100)", fmt::join(names, ", "));
}

void check_fault(std::string_view fault) {
  if (find_named(volume_faults, fault) || find_named(particle_faults, fault) ||
      is_immediate_fault(fault))
    return;
  if (fault == lost_counter) return;
  if (fault.starts_with(slowdown) && stride_of(fault.substr(slowdown.size()))) return;
  throw core::InputError(
      fmt::format("unknown fault '{}'; expected one of: {}", fault, fault_names()));
}

void inject(std::string_view fault, Work& work) {
  check_fault(fault);
  if (fault == lost_counter) return;
  if (fault == "crash") crash();
  if (fault == "hang") hang();
  if (fault == "device_lost") throw core::DeviceLost("injected", "device_lost");
  const auto inject_into = [&](auto& options, const auto& faults) {
    if (const auto injected = find_named(faults, fault)) {
      options.fault = *injected;
    } else if (fault.starts_with(slowdown)) {
      options.extra_work_stride = *stride_of(fault.substr(slowdown.size()));
    } else {
      throw core::NotSupported(fmt::format("technique {} does not support the injected fault '{}'",
                                           work.technique, fault));
    }
  };
  if (auto* volume = std::get_if<VolumeWork>(&work.scene)) {
    inject_into(volume->options, volume_faults);
  } else {
    inject_into(std::get<ParticleWork>(work.scene).options, particle_faults);
  }
}

void inject(std::string_view fault, record::Record& record) {
  if (fault == lost_counter && !record.counters.empty()) {
    record.counters.erase(record.counters.begin());
  }
}

}  // namespace triptych::measure
