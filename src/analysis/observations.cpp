#include "analysis/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "estimation/statistics.hpp"
#include "record/has_picture.hpp"

namespace triptych::analysis {

using estimation::median;
namespace {

std::string identity(const Source& source) {
  const auto processor = source.run.system.find("processor");
  return source.device.key() +
         (processor == source.run.system.end() ? std::string() : '|' + processor->second);
}

// Device levels: the id alone where it means one driver on one processor.
class DeviceLevels {
 public:
  explicit DeviceLevels(std::span<const Source* const> sources) {
    for (const Source* source : sources)
      identities_[source->record.device].insert(identity(*source));
  }
  [[nodiscard]] std::string of(const Source& source) const {
    if (identities_.at(source.record.device).size() == 1) return source.record.device;
    return source.record.device + '@' + hash_of(identity(source));
  }
  void note(std::vector<std::string>& notes) const {
    for (const auto& [id, identities] : identities_) {
      if (identities.size() == 1) continue;
      for (const std::string& each : identities) {
        notes.push_back(fmt::format("{}@{} is {}", id, hash_of(each), each));
      }
    }
  }

 private:
  static std::string hash_of(const std::string& text) {
    return core::content_hash(text).substr(0, 8);
  }
  std::map<std::string, std::set<std::string>> identities_;
};

// Why a record is no observation; empty when it is one.
std::string unfit(const record::Record& record) {
  if (record.outcome != record::Outcome::measured) {
    return fmt::format("{} on {}", record::name_of(record.outcome), record.device);
  }
  if (!record.planted.empty()) return "with a planted fault";
  if (!record::has_picture(record)) return "of a technique that makes no picture";
  // A logarithm is taken of it.
  if (!(median(record.wall_ns) > 0)) return fmt::format("without a time on {}", record.device);
  return {};
}

bool has_device_time(const record::Record& record) {
  return record.device_clock_trusted && median(record.device_ns) > 0;
}

std::string place_of(const Source& source) {
  return source.run.id + " in " + source.file;
}

bool older(const Source& a, const Source& b) {
  return std::tie(a.run.started_at, a.run.id) < std::tie(b.run.started_at, b.run.id);
}

// The latest source of every configuration on every device, in a stable order.
std::vector<const Source*> latest(std::span<const Source* const> sources,
                                  const DeviceLevels& devices, Dataset& dataset) {
  std::map<std::pair<std::string, std::string>, const Source*> taken;
  for (const Source* source : sources) {
    const auto key = std::pair(devices.of(*source), source->record.configuration);
    const auto [at, fresh] = taken.emplace(key, source);
    if (fresh) continue;
    const Source* dropped = source;
    if (older(*at->second, *source)) std::swap(at->second, dropped);
    dataset.duplicates.push_back(
        {key.first, key.second, place_of(*at->second), place_of(*dropped)});
  }
  std::vector<const Source*> result;
  for (const auto& [key, source] : taken) result.push_back(source);
  return result;
}

bool names(const std::string& configuration, const std::string& factor) {
  return configuration.starts_with(factor + '=') ||
         configuration.find(',' + factor + '=') != std::string::npos;
}

// Factors that differ between records although no configuration names them.
std::set<std::string> chosen_by_devices(std::span<const Source* const> sources) {
  std::map<std::string, std::set<std::string>> unnamed;
  std::set<std::string> named;
  for (const Source* source : sources) {
    for (const auto& [factor, value] : source->record.factors) {
      if (names(source->record.configuration, factor)) {
        named.insert(factor);
      } else {
        unnamed[factor].insert(value);
      }
    }
  }
  std::set<std::string> result;
  for (const auto& [factor, values] : unnamed) {
    if (values.size() > 1 && !named.contains(factor)) result.insert(factor);
  }
  return result;
}

std::string choose_clock(std::span<const Source* const> sources, ClockChoice choice,
                         std::vector<std::string>& notes) {
  if (choice != ClockChoice::automatic) return choice == ClockChoice::wall ? "wall" : "device";
  std::map<std::string, std::size_t> without;
  for (const Source* source : sources) {
    if (!has_device_time(source->record)) ++without[source->record.device];
  }
  if (without.empty()) return "device";
  for (const auto& [device, count] : without) {
    notes.push_back(fmt::format(
        "wall-clock time for all: {} records of {} have no trusted device time", count, device));
  }
  return "wall";
}

Dataset dataset_of(const std::string& suite, std::span<const Source* const> sources,
                   ClockChoice choice) {
  Dataset dataset{.suite = suite};
  std::map<std::string, std::size_t> aside;
  std::vector<const Source*> fit;
  for (const Source* source : sources) {
    const std::string reason = unfit(source->record);
    if (reason.empty()) {
      fit.push_back(source);
    } else {
      ++aside[reason];
    }
  }
  const DeviceLevels devices(fit);
  devices.note(dataset.notes);
  fit = latest(fit, devices, dataset);
  dataset.clock = choose_clock(fit, choice, dataset.notes);
  if (dataset.clock == "device") {
    const std::size_t dropped =
        std::erase_if(fit, [](const Source* source) { return !has_device_time(source->record); });
    if (dropped > 0) aside["without a trusted device time"] = dropped;
  }
  const std::set<std::string> no_factors = chosen_by_devices(fit);
  for (const Source* source : fit) {
    Observation each{.factors = source->record.factors,
                     .wall_ms = median(source->record.wall_ns) / 1e6};
    std::erase_if(each.factors, [&](const auto& item) { return no_factors.contains(item.first); });
    each.factors["device"] = devices.of(*source);
    if (has_device_time(source->record)) each.device_ms = median(source->record.device_ns) / 1e6;
    each.ms = dataset.clock == "device" ? *each.device_ms : each.wall_ms;
    dataset.observations.push_back(std::move(each));
  }
  for (const auto& [reason, count] : aside) {
    dataset.notes.push_back(fmt::format("{} records {} are left aside", count, reason));
  }
  return dataset;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// The run of digits at `at`, without leading zeros.
std::string_view number_at(std::string_view text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return text.substr(begin, at - begin);
}

}  // namespace

ClockChoice clock_choice(std::string_view name) {
  if (name == "auto") return ClockChoice::automatic;
  if (name == "device") return ClockChoice::device;
  if (name == "wall") return ClockChoice::wall;
  throw core::InputError(fmt::format("clock '{}': expected auto, device or wall", name));
}

std::vector<Dataset> join(std::span<const Source> sources, ClockChoice choice) {
  std::map<std::string, std::vector<const Source*>> by_suite;
  for (const Source& source : sources) by_suite[source.record.suite].push_back(&source);
  std::vector<Dataset> datasets;
  for (const auto& [suite, of_suite] : by_suite) {
    datasets.push_back(dataset_of(suite, of_suite, choice));
  }
  return datasets;
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::optional<double> number_a = number(a);
  const std::optional<double> number_b = number(b);
  if (number_a && number_b && *number_a != *number_b) return *number_a < *number_b;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view x = number_at(a, i);
      const std::string_view y = number_at(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;  // "1" and "01" are not the same text
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

View view_of(std::string_view camera) {
  const std::size_t colon = camera.find(':');
  if (colon == std::string_view::npos) return {std::string(camera), {}};
  return {std::string(camera.substr(0, colon)), std::string(camera.substr(colon + 1))};
}

}  // namespace triptych::analysis
