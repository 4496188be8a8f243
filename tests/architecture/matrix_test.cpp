// Tests that every backend implements every technique, or states the reason why it does not.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "source_tree.hpp"
#include "technique/catalogue.hpp"

namespace triptych::architecture {
namespace {

const std::vector<std::string> apis = apis_of_backends();

// Reads the lines "technique: reason" from a backend's unsupported.txt, in which # begins a
// comment.
std::map<std::string, std::string> unsupported(const std::string& api) {
  std::map<std::string, std::string> reasons;
  std::istringstream text(read(source_folder / "backends" / api / "unsupported.txt"));
  for (std::string line; std::getline(text, line);) {
    const auto colon = line.find(':');
    if (line.empty() || line[0] == '#') continue;
    EXPECT_NE(colon, std::string::npos) << api << ": expected 'technique: reason', got " << line;
    if (colon != std::string::npos) reasons[line.substr(0, colon)] = line.substr(colon + 1);
  }
  return reasons;
}

bool implemented(const std::string& api, const std::string& technique) {
  const auto files = files_below("backends/" + api, {".cpp"});
  return std::ranges::any_of(files, [&](const auto& file) { return file.stem() == technique; });
}

TEST(Matrix, TheCatalogueIsNotEmpty) {
  EXPECT_GE(technique::catalogue().size(), 3U);
  EXPECT_GE(apis.size(), 3U);
}

TEST(Matrix, EveryApiOfTheCatalogueHasABackend) {
  for (const technique::Technique& each : technique::catalogue()) {
    for (const std::string& api : each.apis) {
      EXPECT_EQ(std::ranges::count(apis, api), 1) << each.id << " names the API " << api;
    }
  }
}

TEST(Matrix, EveryCellIsImplementedOrExplained) {
  for (const std::string& api : apis) {
    const auto reasons = unsupported(api);
    for (const technique::Technique& each : technique::catalogue()) {
      const bool is_implemented = implemented(api, each.id);
      const bool explained = reasons.contains(each.id) && reasons.at(each.id).size() > 10;
      EXPECT_NE(is_implemented, explained)
          << api << "/" << each.id
          << (is_implemented ? " is implemented but listed as unsupported"
                             : " is missing without a reason");
      EXPECT_EQ(is_implemented, std::ranges::count(each.apis, api) == 1)
          << api << "/" << each.id << " differs from its catalogue line";
    }
  }
}

// Returns the concatenated contents of all plans of the suite that include this check.
std::string judged_plans(const std::string& suite, const std::string& check) {
  const std::filesystem::path plans = source_folder / "suites" / suite / "plans";
  std::string all;
  for (const auto& file : std::filesystem::directory_iterator(plans)) {
    const std::string text = read(file.path());
    const std::regex checks("checks: \\[[^\\]]*" + check);
    const bool by_default = check == "image" && text.find("checks:") == std::string::npos;
    if (by_default || std::regex_search(text, checks)) all += text;
  }
  return all;
}

// The gate would never check a technique that none of its plans draws.
TEST(Matrix, EveryTechniqueIsInAGatePlan) {
  for (const technique::Technique& each : technique::catalogue()) {
    for (const char* check : {"image", "cost", "code"}) {
      const std::regex named("(^|[^a-z_])" + each.id + "($|[^a-z_])");
      EXPECT_TRUE(std::regex_search(judged_plans(each.suite, check), named))
          << "no plan of suites/" << each.suite << "/plans with the check " << check << " has "
          << each.id;
    }
  }
}

TEST(Matrix, UnsupportedListsOnlyExistingTechniques) {
  for (const std::string& api : apis) {
    for (const auto& [technique, reason] : unsupported(api)) {
      EXPECT_NO_THROW(static_cast<void>(technique::technique(technique))) << api;
    }
  }
}

// Returns all technique ids that occur in comparisons in the source code `text`.
std::set<std::string> compared_ids(const std::string& text) {
  static const std::regex comparison(R"re(technique(?:\.id|"\))?\s*[=!]=\s*"([a-z_]+)")re");
  std::set<std::string> ids;
  for (std::sregex_iterator at(text.begin(), text.end(), comparison), end; at != end; ++at) {
    const std::string id = (*at)[1];
    if (std::ranges::count(technique::catalogue(), id, &technique::Technique::id) > 0) {
      ids.insert(id);
    }
  }
  return ids;
}

// Shared code must not contain special cases for techniques, because nobody would remember to
// update them when a technique is added. Differences between techniques must be columns of the
// catalogue.
TEST(Matrix, SharedCodeComparesNoTechniqueIds) {
  EXPECT_EQ(compared_ids("if (work.technique == \"point\" && at(\"technique\") != \"raycast\" && "
                         "technique.id == \"mesh\" && api == \"gl\")"),
            (std::set<std::string>{"mesh", "point", "raycast"}));
  // Records contain only the name of a technique, so has_image.hpp may compare ids.
  // has_image_test checks that it agrees with the catalogue.
  static const std::set<std::string> tested_against_the_catalogue{"has_image.hpp"};
  for (const std::string folder : {"src", "backends", "suites"}) {
    for (const auto& file : files_below(folder, {".hpp", ".cpp"})) {
      if (tested_against_the_catalogue.contains(file.filename().string())) continue;
      const auto ids = compared_ids(read(file));
      EXPECT_THAT(ids, testing::IsEmpty()) << file;
    }
  }
}

}  // namespace
}  // namespace triptych::architecture
