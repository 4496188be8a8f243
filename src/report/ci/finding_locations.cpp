#include "report/ci/finding_locations.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::report {
namespace {

namespace fs = std::filesystem;
using judge::Check;
using judge::Layout;

// Returns the file of a plan's baselines that contains the values of the check. Returns "" if the
// file depends on the device and the device is not known.
std::string baselines_file(Check check, const record::Device* device) {
  switch (check) {
    case Check::image:
      return Layout::images;
    case Check::memory:
      return Layout::memory;
    case Check::accuracy:
      return Layout::errors;
    case Check::stress:
      return Layout::scores;
    case Check::cost:
    case Check::correlation:
      return device == nullptr ? "" : Layout::cost(*device);
    case Check::code:
      return device == nullptr ? "" : Layout::code(*device);
    case Check::statistics:
      return device == nullptr ? "" : Layout::statistics(*device);
    case Check::timing:
      return device == nullptr ? "" : Layout::timings(*device);
    default:
      return Layout::counters;
  }
}

// Returns the number of the first line that contains the key, or 0 if no line does.
std::size_t line_of(const std::string& text, const std::string& key) {
  if (key.empty()) return 0;
  const std::size_t at = text.find(core::json_text(core::Json(key)));
  if (at == std::string::npos) return 0;
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace

FindingLocations::FindingLocations(Sources sources) : sources_(std::move(sources)) {}

std::string FindingLocations::in_repository(const fs::path& file) const {
  std::error_code error;  // a path that cannot be resolved is not in the repository
  const fs::path found = fs::weakly_canonical(file, error);
  if (error) return {};
  const fs::path root = fs::weakly_canonical(sources_.repository, error);
  if (error || sources_.repository.empty()) return {};
  const std::string relative = found.lexically_relative(root).generic_string();
  return relative.empty() || relative == "." || relative.starts_with("..") ? std::string()
                                                                           : relative;
}

const std::string& FindingLocations::text_of(const fs::path& file) const {
  const auto [entry, is_new] = texts_.try_emplace(file);
  if (is_new && fs::is_regular_file(file)) {
    try {
      entry->second = core::read_text(file);
    } catch (const core::Error&) {
      entry->second.clear();  // the gate reports baselines that cannot be read
    }
  }
  return entry->second;
}

SourceLocation FindingLocations::of(const judge::Finding& finding,
                                    const judge::GateResult& result) const {
  const auto device = sources_.devices.find(finding.device);
  const fs::path folder = sources_.baselines / result.plan;
  const std::string baselines_name =
      baselines_file(finding.check, device == sources_.devices.end() ? nullptr : &device->second);
  for (const std::string& name : std::vector<std::string>{baselines_name, Layout::counters}) {
    if (name.empty()) continue;
    const std::string file = in_repository(folder / name);
    if (file.empty()) continue;
    const std::size_t line = line_of(text_of(folder / name), finding.configuration);
    if (line > 0) return {file, line};
  }
  for (const fs::path& whole : {folder / Layout::manifest, fs::path(result.argument)}) {
    std::error_code unreadable;  // for example, the name is too long for a file
    const std::string file =
        fs::is_regular_file(whole, unreadable) ? in_repository(whole) : std::string();
    if (!file.empty()) return {file, 1};
  }
  return {sources_.job, 1};
}

}  // namespace triptych::report
