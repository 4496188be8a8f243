#include "report/finding_groups.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <tuple>

namespace triptych::report {
namespace {

bool stands_alone(const judge::Finding& finding) {
  using judge::Verdict;
  return finding.configuration.empty() || finding.verdict == Verdict::regression ||
         finding.verdict == Verdict::waived || finding.verdict == Verdict::cannot_judge;
}

}  // namespace

std::string FindingGroup::subject() const {
  return configurations == 1 ? first->configuration
                             : fmt::format("{} configurations", configurations);
}

std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings) {
  std::vector<FindingGroup> groups;
  std::map<std::tuple<judge::Verdict, std::string_view, std::string_view>, std::size_t> places;
  for (const judge::Finding& finding : findings) {
    if (stands_alone(finding)) {
      groups.push_back({&finding});
      continue;
    }
    const auto [place, added] =
        places.try_emplace({finding.verdict, finding.test, finding.message}, groups.size());
    if (added) {
      groups.push_back({&finding});
    } else {
      ++groups[place->second].configurations;
    }
  }
  return groups;
}

}  // namespace triptych::report
