#include "measure/plan/plan_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "record/factor_list.hpp"

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

Plan PlanChoice::load(const std::string& plan, const FindSuite& find_suite) const {
  return load_plan(plan, overrides(), find_suite, part());
}

}  // namespace triptych::measure
