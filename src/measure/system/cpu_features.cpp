#include "measure/system/cpu_features.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace triptych::measure {
namespace {

// Returns whether a CPU flag affects the code that LLVM generates. Only the flags for vector and
// bit-manipulation instructions of x86 and ARM do.
bool changes_code(std::string_view flag) {
  static constexpr std::string_view prefixes[] = {"avx", "sse4", "fma", "f16c",
                                                  "bmi", "amx",  "sve", "asimd"};
  return std::ranges::any_of(prefixes, [&](std::string_view p) { return flag.starts_with(p); });
}

}  // namespace

std::string cpu_features() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with("flags") && !line.starts_with("Features")) continue;
    std::istringstream words(line.substr(line.find(':') + 1));
    std::set<std::string> kept;
    for (std::string word; words >> word;) {
      if (changes_code(word)) kept.insert(word);
    }
    std::string text;
    for (const std::string& word : kept) text += (text.empty() ? "" : " ") + word;
    return text;
  }
  return {};
}

std::map<std::string, std::string> set_variables(std::span<const std::string_view> names) {
  std::map<std::string, std::string> set;
  for (const std::string_view name : names) {
    const std::string text(name);
    if (const char* value = std::getenv(text.c_str())) set.emplace(text, value);
  }
  return set;
}

}  // namespace triptych::measure
