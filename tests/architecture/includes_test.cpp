// Tests that rooms (libraries) include only headers from lower floors (layers, see
// cmake/room.cmake), that backends and suites do not depend on each other, and that only the
// backend for an API includes that API's headers.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

const std::vector<std::string> code_endings{".hpp", ".cpp", ".h", ".in"};

// Reads the floors from cmake/room.cmake, which uses the same list to check link dependencies.
std::map<std::string, int> floors() {
  const std::string text = read(source_folder / "cmake/room.cmake");
  static const std::regex pattern(R"(\b([a-z]+)=(\d+)\b)");
  std::map<std::string, int> found;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    found[(*i)[1]] = std::stoi((*i)[2]);
  }
  return found;
}

// Returns the room to which an included header belongs, such as "scene". Returns "backend" for
// backends/…, and "suite" for suites/….
std::optional<std::string> room_of_include(const std::string& include,
                                           const std::map<std::string, int>& known) {
  const std::string first = include.substr(0, include.find('/'));
  if (first == "backends") return "backend";
  if (first == "suites") return "suite";
  if (include.find('/') != std::string::npos && known.contains(first)) return first;
  return std::nullopt;
}

void expect_includes_from_lower_floors(const std::string& folder, const std::string& room) {
  const auto known = floors();
  ASSERT_TRUE(known.contains(room)) << room;
  for (const auto& file : files_below(folder, code_endings)) {
    for (const std::string& include : includes_of(file)) {
      const auto other = room_of_include(include, known);
      const bool own = other == room && (include.starts_with(folder + "/") ||
                                         ("src/" + include).starts_with(folder + "/"));
      if (!other || own) continue;
      EXPECT_LT(known.at(*other), known.at(room)) << file << " includes " << include;
    }
  }
}

TEST(Includes, FloorsAreParsed) {
  EXPECT_GE(floors().size(), 10U);
}

TEST(Includes, RoomsIncludeOnlyLowerFloors) {
  for (const auto& entry : std::filesystem::directory_iterator(source_folder / "src")) {
    const std::string room = entry.path().filename().string();
    expect_includes_from_lower_floors("src/" + room, room);
  }
}

// For each folder of a room, returns the other folders of that room whose headers its files
// include. Files outside of folders are ignored.
std::map<std::string, std::set<std::string>> folders_of(const std::string& room) {
  std::map<std::string, std::set<std::string>> found;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder / "src" / room)) {
    if (!entry.is_directory()) continue;
    const std::string folder = entry.path().filename().string();
    found[folder];
    for (const auto& file : files_below("src/" + room + "/" + folder, code_endings)) {
      for (const std::string& include : includes_of(file)) {
        const std::filesystem::path path = include;
        if (!include.starts_with(room + "/") || path.parent_path() == room) continue;
        const std::string other = (++path.begin())->string();
        if (other != folder) found[folder].insert(other);
      }
    }
  }
  return found;
}

// Repeatedly removes folders that need none of the remaining folders. The folders that cannot be
// removed form a cycle.
std::string cycle_in(std::map<std::string, std::set<std::string>> needed) {
  while (true) {
    const auto independent = std::ranges::find_if(needed, [&](const auto& folder) {
      return std::ranges::none_of(folder.second, [&](const auto& n) { return needed.contains(n); });
    });
    if (independent == needed.end()) break;
    needed.erase(independent);
  }
  std::string cycle;
  for (const auto& [folder, others] : needed) cycle += folder + " ";
  return cycle;
}

TEST(Includes, FoldersOfARoomFormNoCycle) {
  EXPECT_EQ(cycle_in({{"a", {"b"}}, {"b", {"a", "c"}}, {"c", {}}}), "a b ");
  EXPECT_GE(folders_of("judge").size(), 4U);
  EXPECT_TRUE(folders_of("judge").at("gate").contains("baselines"));
  for (const auto& entry : std::filesystem::directory_iterator(source_folder / "src")) {
    const std::string room = entry.path().filename().string();
    EXPECT_EQ(cycle_in(folders_of(room)), "") << "in src/" << room;
  }
}

TEST(Includes, BackendsAndSuitesAreIndependent) {
  for (const std::string kind : {"backend", "suite"}) {
    for (const auto& entry : std::filesystem::directory_iterator(source_folder / (kind + "s"))) {
      if (!entry.is_directory()) continue;
      expect_includes_from_lower_floors(kind + "s/" + entry.path().filename().string(), kind);
    }
  }
}

TEST(Includes, ReferenceDoesNotIncludeTechniques) {
  for (const auto& file : files_below("src/reference", code_endings)) {
    for (const std::string& include : includes_of(file)) {
      EXPECT_FALSE(include.starts_with("technique/")) << file;
    }
  }
}

TEST(Includes, NoApiHeaderOutsideItsBackend) {
  static const std::map<std::string, std::regex> headers{
      {"opencl", std::regex(R"(CL/.*)")},
      {"vulkan", std::regex(R"(vulkan/.*)")},
      {"gl", std::regex(R"((EGL|GL|GLES\w*|glad|KHR)/.*)")},
  };
  for (const std::string& api : apis_of_backends()) {
    EXPECT_TRUE(headers.contains(api)) << "add a pattern for the headers of " << api;
  }
  for (const std::string folder : {"src", "backends", "suites"}) {
    for (const auto& file : files_below(folder, code_endings)) {
      for (const auto& [api, header] : headers) {
        const auto home = source_folder / "backends" / api;
        if (file.string().starts_with(home.string())) continue;
        for (const std::string& include : includes_of(file)) {
          EXPECT_FALSE(std::regex_match(include, header)) << file << " includes " << include;
        }
      }
    }
  }
}

TEST(Files, NoFileContainsAPathOfOneMachine) {
  static const std::regex path(R"((^|[^A-Za-z0-9_.])/(home|work|Users)/)", std::regex::multiline);
  for (const std::string folder : {"src", "backends", "suites", "ci", "docs", "cmake"}) {
    for (const auto& file :
         files_below(folder, {".hpp", ".cpp", ".md", ".cmake", ".txt", ".cl", ".glsl"})) {
      EXPECT_FALSE(std::regex_search(read(file), path)) << file;
    }
  }
}

}  // namespace
}  // namespace triptych::architecture
