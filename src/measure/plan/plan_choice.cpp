#include "measure/plan/plan_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "record/factor_list.hpp"
#include "record/short_name.hpp"

namespace triptych::measure {

Overrides PlanChoice::overrides() const {
  Overrides overrides;
  for (const std::string& each : set) {
    const auto equals = each.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == each.size()) {
      throw core::InputError(fmt::format("--set {}: expected factor=value or factor=a,b", each));
    }
    std::vector<std::string> values;
    for (std::size_t begin = equals + 1; begin <= each.size();) {
      const std::size_t end = std::min(each.find(',', begin), each.size());
      values.push_back(record::unescaped(std::string_view(each).substr(begin, end - begin)));
      begin = end + 1;
    }
    overrides.emplace_back(each.substr(0, equals), std::move(values));
  }
  return overrides;
}

Shard PlanChoice::part() const {
  if (shard.empty()) return {};
  Shard part;
  const char* const end = shard.data() + shard.size();
  const auto [slash, index_error] = std::from_chars(shard.data(), end, part.index);
  if (index_error == std::errc{} && slash != end && *slash == '/') {
    const auto [rest, count_error] = std::from_chars(slash + 1, end, part.count);
    if (count_error == std::errc{} && rest == end && part.index >= 1 && part.index <= part.count) {
      return part;
    }
  }
  throw core::InputError(fmt::format("--shard {}: expected i/n with 1 <= i <= n", shard));
}

namespace {

// Reads a list of configurations from a file, which may be the output of `triptych list`. Each line
// begins with the name or the key of a configuration, and text after two spaces is ignored. Lines
// that begin with '#' are comments.
std::set<std::string> read_cases(const std::string& file) {
  std::set<std::string> cases;
  std::istringstream lines(core::read_text(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    line.resize(std::min(line.find("  "), line.size()));
    while (line.ends_with(' ')) line.pop_back();
    if (!line.empty() && !line.starts_with('#')) cases.insert(std::move(line));
  }
  if (cases.empty()) {
    throw core::InputError(fmt::format("--caselist {}: the file lists no configurations", file));
  }
  return cases;
}

std::size_t parse_fraction(const std::string& text) {
  std::size_t parts = 0;
  const char* const end = text.data() + text.size();
  if (text.starts_with("1/")) {
    const auto [rest, error] = std::from_chars(text.data() + 2, end, parts);
    if (error == std::errc{} && rest == end && parts >= 1) return parts;
  }
  throw core::InputError(fmt::format("--fraction {}: expected 1/n with n >= 1", text));
}

// A configuration with its key.
struct Named {
  std::string key;
  Configuration configuration;
};

// Keeps the configurations whose keys have the smallest hashes, in the order of the plan. Their
// number is 1/`parts` of all configurations, rounded up.
void keep_fraction(std::size_t parts, std::vector<Named>& all) {
  const std::size_t kept = (all.size() + parts - 1) / parts;
  if (kept == all.size()) return;
  std::vector<std::string> hashes;
  for (const Named& each : all) hashes.push_back(core::content_hash(each.key));
  std::vector<std::string> sorted = hashes;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(kept));
  const std::string& first_out = sorted[kept];
  std::vector<Named> chosen;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (hashes[i] < first_out) chosen.push_back(std::move(all[i]));
  }
  all = std::move(chosen);
}

}  // namespace

std::string PlanChoice::selection_text() const {
  std::string text;
  const auto add = [&](std::string_view option, const std::string& value) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " ", option, value);
  };
  for (const std::string& each : filter) add("--filter", each);
  if (!caselist.empty()) add("--caselist", caselist);
  if (!fraction.empty()) add("--fraction", fraction);
  return text;
}

Plan PlanChoice::load(const std::string& plan, const FindSuite& find_suite) const {
  Plan loaded = load_plan(plan, overrides(), find_suite, part());
  if (!selects()) return loaded;
  const std::set<std::string> cases =
      caselist.empty() ? std::set<std::string>() : read_cases(caselist);
  const Suite& suite = find_suite(loaded.suite);
  std::vector<Named> kept;
  for (Configuration& each : loaded.configurations) {
    std::string key = configuration_key(suite, each);
    const auto matches = [&](const std::string& glob) {
      return record::names_configuration(glob, loaded.suite, loaded.name, key);
    };
    const bool listed = cases.empty() || cases.contains(key) ||
                        cases.contains(record::short_name(key)) ||
                        cases.contains(record::short_name(loaded.suite, loaded.name, key));
    if (listed && (filter.empty() || std::ranges::any_of(filter, matches))) {
      kept.push_back({std::move(key), std::move(each)});
    }
  }
  if (!fraction.empty()) keep_fraction(parse_fraction(fraction), kept);
  loaded.configurations.clear();
  for (Named& each : kept) loaded.configurations.push_back(std::move(each.configuration));
  return loaded;
}

}  // namespace triptych::measure
