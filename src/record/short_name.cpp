#include "record/short_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/glob.hpp"
#include "core/hash.hpp"
#include "record/factor_list.hpp"
#include "record/record.hpp"

namespace triptych::record {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// Returns a short hash that distinguishes values that differ only in characters that a name cannot
// contain.
std::string hash_of(std::string_view value) {
  constexpr std::size_t digits = 4;
  return "_" + core::content_hash(value).substr(0, digits);
}

std::string spelled(std::string_view value) {
  std::string text;
  for (const char c : value) text += is_plain(c) ? c : '_';
  if (value.starts_with('-')) text.front() = 'm';
  constexpr std::string_view separators = ".:/-+";
  const bool usual = std::ranges::all_of(
      value, [&](char c) { return is_plain(c) || separators.find(c) != std::string_view::npos; });
  return usual ? text : text + hash_of(value);
}

// Returns the form in which a level of the factor `data` appears in a short name, for example
// "mandelbulb_96" for "generate:mandelbulb:96", "bonsai" for "bonsai.nrrd", and "x_64x64x64_u8" for
// "x.raw:64x64x64:u8". The folder of a file is replaced by a hash.
std::string spelled_data(std::string_view value) {
  for (const std::string_view scheme : {"generate:", "stress:", "analytic:"}) {
    if (value.starts_with(scheme)) return spelled(value.substr(scheme.size()));
  }
  const std::size_t colon = std::min(value.find(':'), value.size());
  const std::string_view file = value.substr(0, colon);
  const std::size_t slash = file.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? file : file.substr(slash + 1);
  const std::size_t ending = name.find('.', 1);
  std::string text =
      spelled(std::string(name.substr(0, ending)) + std::string(value.substr(colon)));
  if (slash != std::string_view::npos) text += hash_of(file);
  return text;
}

constexpr std::array<std::string_view, 4> by_value{"technique", "data", "transfer_function",
                                                   "camera"};

std::string spelled_level(const std::string& factor, const std::string& level) {
  if (factor == "step") return "s" + spelled(level);
  if (factor == "viewport") return "v" + spelled(level);
  return factor + "_" + spelled(level);
}

}  // namespace

std::string short_name(std::string_view configuration) {
  std::map<std::string, std::string> levels = parse_factor_list(configuration);
  std::string name;
  const auto add = [&](const std::string& part) { name += (name.empty() ? "" : ".") + part; };
  for (const std::string_view factor : by_value) {
    const auto found = levels.find(std::string(factor));
    if (found == levels.end()) continue;
    add(factor == "data" ? spelled_data(found->second) : spelled(found->second));
    levels.erase(found);
  }
  for (const auto& [factor, level] : levels) add(spelled_level(factor, level));
  return name;
}

std::string short_name(std::string_view suite, std::string_view plan,
                       std::string_view configuration) {
  const std::size_t slash = plan.rfind('/');
  if (slash != std::string_view::npos) plan.remove_prefix(slash + 1);
  return fmt::format("{}.{}.{}", spelled(suite), spelled(plan), short_name(configuration));
}

std::string short_name(const Record& record) {
  return short_name(record.suite, record.plan, record.configuration);
}

bool names_configuration(const std::string& glob, std::string_view suite, std::string_view plan,
                         std::string_view configuration) {
  return core::glob_matches(glob, configuration) ||
         core::glob_matches(glob, short_name(suite, plan, configuration)) ||
         core::glob_matches(glob, short_name(configuration));
}

}  // namespace triptych::record
