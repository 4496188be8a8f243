#include "reduction/simpler_levels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace triptych::reduction {
namespace {

// A level that ends with the side lengths of an image or a volume. "generate:mandelbulb:96" has the
// name "generate:mandelbulb:" and the sides {96}, and "256x128" has the name "" and the sides {256,
// 128}.
struct SizedLevel {
  std::string name;
  std::vector<int> sides;
};

std::optional<SizedLevel> parse_sized_level(const std::string& level) {
  const std::size_t colon = level.rfind(':');
  const std::size_t begin = colon == std::string::npos ? 0 : colon + 1;
  SizedLevel sized{level.substr(0, begin), {}};
  const char* at = level.data() + begin;
  const char* const end = level.data() + level.size();
  for (;;) {
    int side = 0;
    const auto [rest, error] = std::from_chars(at, end, side);
    if (error != std::errc{} || side < 1) return std::nullopt;
    sized.sides.push_back(side);
    if (rest == end) return sized;
    if (*rest != 'x') return std::nullopt;
    at = rest + 1;
  }
}

std::string text_of(const SizedLevel& sized) {
  const bool equal =
      std::ranges::all_of(sized.sides, [&](int side) { return side == sized.sides.front(); });
  return sized.name + (equal ? fmt::to_string(sized.sides.front())
                             : fmt::format("{}", fmt::join(sized.sides, "x")));
}

// Returns 1, 2, 3, 4, 6, 8, 12, …, and then sizes that approach `size` from below in ever smaller
// steps. If all sizes above a threshold fail, this sequence lets the search come close to the
// threshold in few steps.
std::vector<int> smaller_sizes(int size) {
  std::set<int> sizes;
  for (int each = 1; each < size; each *= 2) {
    sizes.insert(each);
    if (each > 1 && each + each / 2 < size) sizes.insert(each + each / 2);
    if (each > size / 2) break;
  }
  for (int step = size / 8; step >= 1; step /= 2) sizes.insert(size - step);
  if (size > 1) sizes.insert(size - 1);
  return {sizes.begin(), sizes.end()};
}

std::vector<std::string> smaller_levels(const SizedLevel& sized, std::size_t dimensions) {
  std::vector<std::string> levels;
  const int longest = *std::ranges::max_element(sized.sides);
  for (const int size : smaller_sizes(longest)) {
    SizedLevel shrunk = sized;
    for (int& side : shrunk.sides) side = std::min(side, size);
    levels.push_back(text_of(shrunk));
  }
  SizedLevel each = sized;
  if (each.sides.size() == 1) each.sides.resize(dimensions, each.sides.front());
  for (std::size_t i = 0; i < each.sides.size() && each.sides.size() > 1; ++i) {
    for (const int size : smaller_sizes(each.sides[i])) {
      SizedLevel changed = each;
      changed.sides[i] = size;
      levels.push_back(text_of(changed));
    }
  }
  return levels;
}

}  // namespace

std::vector<std::string> simpler_levels(const measure::Factor& factor, const std::string& level) {
  std::vector<std::string> levels;
  if (factor.kind == measure::FactorKind::choice) {
    levels.assign(factor.levels.begin(), std::ranges::find(factor.levels, level));
    return levels;
  }
  if (factor.kind == measure::FactorKind::number) {
    if (level == "0") return levels;
    if (factor.minimum == 0) levels.emplace_back("0");
    if (level != factor.default_value && factor.default_value != "0")
      levels.push_back(factor.default_value);
    return levels;
  }
  const bool is_data = factor.name == "data";
  if (is_data || factor.name == "viewport") {
    constexpr std::size_t axes = 3;
    if (const auto sized = parse_sized_level(level))
      return smaller_levels(*sized, is_data ? axes : 2);
  }
  if (level != factor.default_value) levels.push_back(factor.default_value);
  return levels;
}

}  // namespace triptych::reduction
