// Each row of docs/attacks.md names the tests that cover an attack. All of these tests must exist
// and be part of the build.

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

// The source file of a test, such as "gate_test", and the test cases that a row names in it. If a
// row names no cases, it refers to all cases in the file.
struct NamedTest {
  std::string file;
  std::vector<std::string> cases;
};

// Returns the tests that a table cell names.
std::vector<NamedTest> tests_of(const std::string& cell) {
  static const std::regex word(R"(`([a-z0-9_]+)`|([A-Z][A-Za-z0-9]+))");
  std::vector<NamedTest> tests;
  for (std::sregex_iterator at(cell.begin(), cell.end(), word), end; at != end; ++at) {
    if ((*at)[1].matched) {
      tests.push_back({(*at)[1], {}});
    } else if (!tests.empty()) {
      tests.back().cases.push_back((*at)[2]);
    }
  }
  return tests;
}

// Returns the last cell of each table row, without the header row.
std::vector<std::string> rows_of(const std::string& page) {
  std::vector<std::string> rows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|") || line.starts_with("|-") || line.starts_with("| Attack")) continue;
    const std::string_view cells(line.data(), line.rfind('|'));
    rows.emplace_back(cells.substr(cells.rfind('|') + 1));
  }
  return rows;
}

class Sources {
 public:
  // Returns the contents of all sources with this name that the CMakeLists.txt in the same folder
  // lists. For example, both the judge and the command line have a gate_test.
  [[nodiscard]] std::optional<std::string> text(const std::string& name) const {
    std::optional<std::string> all;
    for (const auto& file : files_) {
      if (file.stem() != name) continue;
      const std::string list = read(file.parent_path() / "CMakeLists.txt");
      if (list.find(file.filename().string()) != std::string::npos) {
        all = all.value_or("") + read(file);
      }
    }
    return all;
  }

 private:
  std::vector<std::filesystem::path> files_ = files_below("tests", {"_test.cpp", ".py"});
};

bool has_case(const std::string& source, const std::string& name) {
  return std::regex_search(source, std::regex(R"(\bTEST(_[FP])?\(\w+,\s*)" + name + R"(\))"));
}

TEST(Attacks, EveryRowNamesTestsThatExist) {
  const Sources sources;
  std::size_t rows = 0;
  for (const std::string& cell : rows_of(read(source_folder / "docs/attacks.md"))) {
    ++rows;
    const std::vector<NamedTest> tests = tests_of(cell);
    EXPECT_FALSE(tests.empty()) << "no test in:" << cell;
    for (const NamedTest& test : tests) {
      const auto source = sources.text(test.file);
      EXPECT_TRUE(source) << test.file
                          << " is not a source file of any test program; named in:" << cell;
      for (const std::string& each : test.cases) {
        EXPECT_TRUE(source && has_case(*source, each)) << test.file << " has no case " << each;
      }
    }
  }
  EXPECT_GT(rows, 40U);
}

TEST(Attacks, TheTableParserFindsMistakes) {
  const std::vector<std::string> rows = rows_of(
      "| Attack | Guard | Test |\n|---|---|---|\n| a | b | `x_test` One, Two; `y_test` |\n");
  ASSERT_EQ(rows.size(), 1U);
  const std::vector<NamedTest> tests = tests_of(rows[0]);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].cases, (std::vector<std::string>{"One", "Two"}));
  EXPECT_TRUE(tests[1].cases.empty());
  EXPECT_FALSE(Sources().text("no_such_test"));
  EXPECT_TRUE(has_case("TEST_F(X, One) {", "One"));
  EXPECT_FALSE(has_case("TEST_F(X, OneMore) {", "One"));
}

}  // namespace
}  // namespace triptych::architecture
