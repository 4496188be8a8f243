#include <fcntl.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <set>
#include <thread>

#include "backends/null/device.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace triptych::null_backend {
namespace {

using core::Json;

constexpr std::array<std::string_view, 10> kind_names{
    "crash",         "exit",        "hang",      "device_lost", "api_error",
    "not_supported", "wrong_image", "nan_image", "stale_image", "garbage"};
constexpr std::array<std::string_view, 6> place_names{"list",    "open",  "supports",
                                                      "prepare", "frame", "image"};

[[noreturn]] void refuse(std::string_view key, std::string_view expected) {
  throw core::InputError(fmt::format("null script: '{}': expected {}", key, expected));
}

template <typename Enum, std::size_t n>
Enum level(const Json& value, std::string_view key, const std::array<std::string_view, n>& names) {
  const auto* const found =
      value.is_string() ? std::ranges::find(names, value.get<std::string>()) : names.end();
  if (found == names.end()) refuse(key, fmt::format("one of {}", fmt::join(names, ", ")));
  return static_cast<Enum>(found - names.begin());
}

double number(const Json& value, std::string_view key, double minimum) {
  if (!value.is_number() || value.get<double>() < minimum) {
    refuse(key, fmt::format("a number of at least {}", minimum));
  }
  return value.get<double>();
}

bool flag(const Json& value, std::string_view key) {
  if (!value.is_boolean()) refuse(key, "true or false");
  return value.get<bool>();
}

std::string text(const Json& value, std::string_view key) {
  if (!value.is_string()) refuse(key, "text");
  return value.get<std::string>();
}

bool affects_image(FailureKind kind) {
  return kind == FailureKind::wrong_image || kind == FailureKind::nan_image ||
         kind == FailureKind::stale_image;
}

// The descriptions of all work that this process has prepared.
std::set<std::string>& prepared_work() {
  static std::set<std::string> descriptions;
  return descriptions;
}

// Returns whether the failure happens. A failure with `once` happens only in the process that
// creates the file.
bool is_triggered(const Failure& failure) {
  const bool ready = std::ranges::all_of(failure.after, [](const std::string& glob) {
    return std::ranges::any_of(prepared_work(), [&glob](const std::string& description) {
      return matches(glob, description);
    });
  });
  if (!ready) return false;
  if (failure.once.empty()) return true;
  const int file = ::open(failure.once.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0) return false;
  ::close(file);
  return true;
}

Failure parse_failure(const Json& json) {
  if (!json.is_object() || !json.contains("kind"))
    refuse("failures", "objects that contain a \"kind\"");
  Failure failure;
  failure.kind = level<FailureKind>(json.at("kind"), "kind", kind_names);
  const bool image_only = affects_image(failure.kind);
  if (image_only) failure.at = Place::image;
  for (const auto& [key, value] : json.items()) {
    if (key == "at") {
      failure.at = level<Place>(value, key, place_names);
    } else if (key == "frame") {
      if (!value.is_number_unsigned()) refuse(key, "a non-negative integer");
      failure.frame = value.get<int>();
    } else if (key == "only") {
      failure.only = text(value, key);
    } else if (key == "once") {
      failure.once = text(value, key);
    } else if (key == "after") {
      if (!value.is_array()) refuse(key, "an array of globs");
      for (const Json& each : value) failure.after.push_back(text(each, key));
    } else if (key != "kind") {
      refuse(key,
             "one of the keys of an object in 'failures': kind, at, frame, only, once or after");
    }
  }
  if (image_only && failure.at != Place::image)
    refuse("at", "\"image\", because this kind of failure affects the image");
  return failure;
}

std::vector<double> parse_factors(const std::string& key, const Json& value) {
  if (!value.is_array() || value.empty())
    refuse(key, "a non-empty list of factors by which times are multiplied");
  std::vector<double> factors;
  for (const Json& each : value) factors.push_back(number(each, key, 0));
  return factors;
}

std::vector<std::pair<std::string, double>> parse_globs(const std::string& key, const Json& value,
                                                        std::string_view expected) {
  if (!value.is_object()) refuse(key, expected);
  std::vector<std::pair<std::string, double>> numbers;
  for (const auto& [glob, each] : value.items()) numbers.emplace_back(glob, number(each, key, 0));
  return numbers;
}

// Returns false if no numeric key has this name.
bool parse_number(const std::string& key, const Json& value, Script& script) {
  const std::array<std::pair<std::string_view, double Script::*>, 7> numbers{{
      {"base_ns", &Script::base_ns},
      {"ns_per_sample", &Script::ns_per_sample},
      {"warm_up_factor", &Script::warm_up_factor},
      {"noise", &Script::noise},
      {"outlier_share", &Script::outlier_share},
      {"outlier_factor", &Script::outlier_factor},
      {"filter_weight_error", &Script::filter_weight_error},
  }};
  for (const auto& [name, member] : numbers) {
    if (key != name) continue;
    script.*member = number(value, key, 0);
    return true;
  }
  return false;
}

void parse_key(const std::string& key, const Json& value, Script& script) {
  if (parse_number(key, value, script)) return;
  if (key == "seed") {
    if (!value.is_number_unsigned()) refuse(key, "a non-negative integer");
    script.seed = value.get<std::uint64_t>();
  } else if (key == "devices") {
    script.devices = parse_factors(key, value);
  } else if (key == "prepare_factors") {
    script.prepare_factors = parse_factors(key, value);
  } else if (key == "driver_version") {
    script.driver_version = text(value, key);
  } else if (key == "device_over_wall") {
    script.device_over_wall.reset();
    if (!value.is_null()) script.device_over_wall = number(value, key, 0);
  } else if (key == "counts") {
    script.counts = flag(value, key);
  } else if (key == "extra_samples") {
    if (!value.is_number_unsigned()) refuse(key, "a non-negative integer");
    script.extra_samples = value.get<std::uint64_t>();
  } else if (key == "sleep") {
    script.sleep = flag(value, key);
  } else if (key == "images") {
    if (!value.is_object()) refuse(key, "an object that maps globs to EXR files");
    for (const auto& [glob, file] : value.items()) {
      script.images.emplace_back(glob, text(file, key));
    }
  } else if (key == "factors") {
    script.factors = parse_globs(
        key, value, "an object that maps globs to factors by which times are multiplied");
  } else if (key == "leaks") {
    script.leaks = parse_globs(key, value, "an object that maps globs to sizes in bytes");
  } else if (key == "caches") {
    script.caches = parse_globs(key, value, "an object that maps globs to sizes in bytes");
  } else if (key == "failures") {
    if (!value.is_array()) refuse(key, "a list");
    for (const Json& each : value) script.failures.push_back(parse_failure(each));
  } else {
    refuse(key, "one of the keys listed in backends/null/backend.hpp");
  }
}

[[noreturn]] void hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

void trigger(FailureKind kind) {
  switch (kind) {
    case FailureKind::crash:
      std::abort();
    case FailureKind::exit:
      std::_Exit(0);
    case FailureKind::hang:
      hang();
    case FailureKind::device_lost:
      throw core::DeviceLost("null_frame", "NULL_DEVICE_LOST", "scripted");
    case FailureKind::api_error:
      throw core::ApiError("null_frame", "NULL_ERROR", "scripted");
    case FailureKind::not_supported:
      throw core::NotSupported("the null script declares this call unsupported");
    case FailureKind::garbage:
      static_cast<void>(::write(4, "garbage", 7));  // 4: Process::child_answer_fd
      break;
    case FailureKind::wrong_image:
    case FailureKind::nan_image:
    case FailureKind::stale_image:
      break;  // image_failure() handles the failures that affect the image
  }
}

}  // namespace

Script parse_script(std::string_view json) {
  const Json parsed = Json::parse(json, nullptr, false);
  if (!parsed.is_object()) throw core::InputError("null script: expected a JSON object");
  Script script;
  for (const auto& [key, value] : parsed.items()) parse_key(key, value, script);
  return script;
}

namespace {

std::string describe(const std::string& technique, const measure::VolumeWork& work) {
  const scene::VolumeScene& scene = work.scene;
  const technique::RaycastOptions& options = work.options;
  return fmt::format(
      "technique={},data={},step={},ert={},sampler={},skip={},shading={},width={},height={},"
      "eye={:.4g}/{:.4g}/{:.4g},fault={},extra_work_stride={}",
      technique, scene.grid ? scene.grid->name : "", scene.step_voxels, options.ert,
      technique::name_of(options.sampler), technique::name_of(options.skip),
      scene.shading.enabled ? 1 : 0, scene.width, scene.height, scene.camera.eye.x,
      scene.camera.eye.y, scene.camera.eye.z, static_cast<int>(options.fault),
      options.extra_work_stride);
}

std::string describe(const std::string& technique, const measure::ParticleWork& work) {
  const scene::ParticleScene& scene = work.scene;
  const technique::ParticleOptions& options = work.options;
  return fmt::format(
      "technique={},data={},culling={},ray={},transfer={},conservative_depth={},corners={},"
      "radius_scale={},width={},height={},eye={:.4g}/{:.4g}/{:.4g},fault={},extra_work_stride={}",
      technique, scene.particles ? scene.particles->name : "", technique::name_of(options.culling),
      technique::name_of(options.ray), technique::name_of(options.transfer),
      options.conservative_depth ? 1 : 0, options.corners, scene.radius_scale, scene.width,
      scene.height, scene.camera.eye.x, scene.camera.eye.y, scene.camera.eye.z,
      static_cast<int>(options.fault), options.extra_work_stride);
}

}  // namespace

std::string describe(const measure::Work& work) {
  return std::visit([&](const auto& scene) { return describe(work.technique, scene); }, work.scene);
}

bool matches(const std::string& glob, const std::string& subject) {
  return fnmatch(glob.c_str(), subject.c_str(), 0) == 0;
}

void trigger_failure(const Script& script, Place at, const std::string& subject, int number) {
  for (const Failure& failure : script.failures) {
    if (failure.at != at || !matches(failure.only, subject)) continue;
    const bool counted = at == Place::frame || at == Place::prepare;
    if (counted && failure.frame && *failure.frame != number) continue;
    if (!affects_image(failure.kind) && is_triggered(failure)) trigger(failure.kind);
    return;
  }
}

std::optional<FailureKind> image_failure(const Script& script, const std::string& subject) {
  for (const Failure& failure : script.failures) {
    if (!affects_image(failure.kind) || !matches(failure.only, subject)) continue;
    return is_triggered(failure) ? std::optional(failure.kind) : std::nullopt;
  }
  return std::nullopt;
}

void record_prepared(const std::string& description) {
  prepared_work().insert(description);
}

void log_call(const Script& script, std::string call) {
  if (script.log) script.log->push_back(std::move(call));
}

}  // namespace triptych::null_backend
