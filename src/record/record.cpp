#include "record/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace triptych::record {
namespace {

// Escapes a part of a key, so that the key stays on one line and "; " occurs only as the separator
// of its parts.
std::string one_line(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (c == '\r') {
      result += "\\r";
    } else {
      if (c == '\\' || c == ';') result += '\\';
      result += c;
    }
  }
  return result;
}

// Returns the letters, digits and dots of the text, with letters in lower case. Every sequence of
// other characters becomes one '-', except at the beginning and at the end.
std::string slug(std::string_view text, std::size_t longest) {
  std::string result;
  for (const char c : text) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool kept = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
    if (kept) {
      result += upper ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!result.empty() && result.back() != '-') {
      result += '-';
    }
    if (result.size() == longest) break;
  }
  while (!result.empty() && (result.back() == '-' || result.back() == '.')) result.pop_back();
  return result;
}

// Converts text for use in a test id. Test ids consist of [a-z0-9_.:-], because tools that process
// CTest and JUnit output split or quote other characters.
std::string test_id_part(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z') {
      result += static_cast<char>(c - 'A' + 'a');
    } else {
      const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == ':' ||
                        c == '-' || c == '_';
      result += kept ? c : '_';
    }
  }
  return result;
}

// Returns a quantile of n sorted values, by linear interpolation between the two values next to the
// index share·(n − 1).
double quantile_of_sorted(const std::vector<double>& sorted, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = place - static_cast<double>(below);
  // A weight of 0 is a special case, because 0·∞ is NaN.
  return weight == 0 ? sorted[below] : (1 - weight) * sorted[below] + weight * sorted[above];
}

std::vector<double> sorted_numbers(std::vector<double> samples) {
  std::erase_if(samples, [](double sample) { return std::isnan(sample); });
  std::ranges::sort(samples);
  return samples;
}

}  // namespace

std::string Device::key() const {
  std::string key = fmt::format("{}; driver {}; API {}", one_line(id), one_line(driver_version),
                                one_line(api_version));
  // The key of a CPU device contains its CPU features, which determine the generated code. The key
  // of a GPU contains its name, which distinguishes GPUs with the same driver.
  if (!cpu_features.empty()) {
    key += "; CPU " + one_line(cpu_features);
  } else if (!name.empty()) {
    key += "; GPU " + one_line(name);
  }
  for (const auto& [variable, value] : environment) {
    key += fmt::format("; {}={}", one_line(variable), one_line(value));
  }
  return key;
}

std::string Device::key_hash() const {
  return fmt::format("{}-{}", slug(id, 48), core::content_hash(key()).substr(0, 16));
}

std::string Device::statistics_key() const {
  const std::string identity = one_line(id) + "; " + one_line(driver_version);
  return fmt::format("{}-{}-{}", slug(id, 48), slug(driver_version, 48),
                     core::content_hash(identity).substr(0, 8));
}

std::optional<std::uint64_t> Record::instructions() const {
  std::uint64_t sum = 0;
  for (const char* part : {"device_code", "driver"}) {
    const auto found = cost.find(part);
    if (found != cost.end()) sum += found->second;
  }
  return sum > 0 ? std::optional(sum) : std::nullopt;
}

std::optional<std::uint64_t> Record::fetched_bytes() const {
  constexpr std::uint64_t line = 64;
  const auto misses = cost.find("misses");
  return misses == cost.end() ? std::nullopt : std::optional(misses->second * line);
}

const std::vector<double>& Record::time_ns() const {
  return clock() == "device" ? device_ns : wall_ns;
}

std::string_view Record::clock() const {
  return device_clock_trusted && !device_ns.empty() ? "device" : "wall";
}

std::string Record::test_prefix() const {
  const std::size_t slash = plan.find_last_of('/');
  const std::string_view last = slash == std::string::npos
                                    ? std::string_view(plan)
                                    : std::string_view(plan).substr(slash + 1);
  return fmt::format("{}.{}.", test_id_part(suite), test_id_part(last));
}

std::string Record::test_id(std::string_view check) const {
  return fmt::format("{}{}.{}", test_prefix(), test_id_part(check), test_id_part(device));
}

std::string plan_argument(const std::string& plan) {
  return is_plan_file(plan) ? fmt::format("FOLDER/{}.yaml", plan) : plan;
}

bool is_plan_file(const std::string& plan) {
  return plan.find('/') == std::string::npos;
}

std::optional<Summary> summarise(const std::vector<double>& samples) {
  const std::vector<double> sorted = sorted_numbers(samples);
  if (sorted.empty()) return std::nullopt;
  return Summary{sorted.front(), quantile_of_sorted(sorted, 0.25), quantile_of_sorted(sorted, 0.5),
                 quantile_of_sorted(sorted, 0.75), sorted.back()};
}

double percentile(std::vector<double> samples, double share) {
  const std::vector<double> sorted = sorted_numbers(std::move(samples));
  return sorted.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : quantile_of_sorted(sorted, share);
}

}  // namespace triptych::record
