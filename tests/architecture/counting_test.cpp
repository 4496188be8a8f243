// Tests that device code that counts has the same control flow as device code that is timed:
// TRI_COUNT may only affect counting.

#include <gtest/gtest.h>

#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

const std::vector<std::string> device_code{".cl",   ".glsl", ".comp", ".vert",
                                           ".frag", ".geom", ".tesc", ".tese"};

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream text(read(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    lines.push_back(line.substr(0, line.find("//")));
  return lines;
}

// Returns whether a line contains a statement that begins or leaves a loop, or leaves a function.
bool changes_control_flow(const std::string& line) {
  static const std::regex word(R"(\b(return|break|continue|discard|for|while|do|goto)\b)");
  return std::regex_search(line, word);
}

// Returns whether a line uses TRI_COUNT in one of the allowed ways.
bool is_allowed_use(const std::string& line) {
  static const std::regex block(R"(^\s*#if TRI_COUNT\s*$)");
  static const std::regex statement(
      R"(^\s*if \(TRI_COUNT == 1( && [^|]*)?\) (count_\w+(\+\+| = 1u| \+= [^;]*);|\{.*)\s*$)");
  return std::regex_match(line, block) ||
         (std::regex_match(line, statement) && !changes_control_flow(line));
}

TEST(Counting, TriCountAffectsOnlyCounting) {
  static const std::regex name(R"(\bTRI_COUNT\b)");
  std::size_t uses = 0;
  for (const std::string folder : {"backends", "src/technique"}) {
    for (const auto& file : files_below(folder, device_code)) {
      bool counts = false;
      for (const std::string& line : lines_of(file)) {
        if (std::regex_search(line, name)) {
          EXPECT_TRUE(is_allowed_use(line)) << file << ": " << line;
          counts = line.starts_with("#if");
          ++uses;
        } else if (line.starts_with("#endif")) {
          counts = false;
        } else if (counts) {
          EXPECT_FALSE(changes_control_flow(line) || line.starts_with("#el"))
              << file << ": " << line;
        }
      }
    }
  }
  EXPECT_GT(uses, 20U);
}

}  // namespace
}  // namespace triptych::architecture
