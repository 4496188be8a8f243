// Tests the tables that `triptych export` writes from stores.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Export : public testing::Test {
 protected:
  void SetUp() override {
    const Result result =
        program.run(std::string("run volume/quick --store s.sqlite --set step=1,2 ") + tiny);
    ASSERT_EQ(result.code, 0) << result.output;
  }

  Program program;
};

TEST_F(Export, WritesTablesAndReportsTheirRows) {
  EXPECT_THAT(
      program.run("export s.sqlite --out tables").output,
      AllOf(HasSubstr("of the plan volume/quick"), HasSubstr("tables/records.csv: 2 rows")));
  const Result result = program.run("export s.sqlite --out tables --json 2>/dev/null | cat");
  const auto rows = nlohmann::json::parse(result.output).at("rows");
  EXPECT_EQ(rows.at("records"), 2);
  EXPECT_EQ(rows.at("runs"), 1);
  EXPECT_EQ(rows.at("devices"), 1);
  for (const auto& [table, count] : rows.items()) {
    const std::string text = program.read("tables/" + table + ".csv");
    EXPECT_EQ(std::ranges::count(text, '\n'), count.get<int>() + 1) << table;
  }
  EXPECT_THAT(program.read("tables/records.csv"), HasSubstr(",factor_step,"));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// The tables alone are enough to plot run time against error. A correct image has no error with
// respect to its reference image, which uses the same step size. With respect to the limit image,
// to which images converge for small steps, it has an error that decreases with the step size.
TEST_F(Export, ContainsEveryErrorOfEveryImage) {
  const std::string right = R"({"images": {"*": ")" + correct_image(program).string() + R"("}})";
  ASSERT_EQ(program
                .run(std::string("run volume/quick --store e.sqlite ") + tiny +
                         " --set quadrature=midpoint",
                     right)
                .code,
            0);
  const Result result = program.run("export e.sqlite --errors --out tables");
  ASSERT_EQ(result.code, 0) << result.output;
  const std::vector<std::string> rows = lines_of(program.read("tables/errors.csv"));
  ASSERT_GE(rows.size(), 5U) << program.read("tables/errors.csv") << result.output;
  EXPECT_EQ(rows[0], "record,against,metric,error");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string start =
        "1,reference," + std::array<std::string, 4>{"rms", "covered", "p99.9", "max"}.at(i) + ",";
    ASSERT_TRUE(rows[i + 1].starts_with(start)) << rows[i + 1];
  }
  const auto dictionary = nlohmann::json::parse(program.read("tables/dictionary.json"));
  EXPECT_EQ(dictionary["tables"]["errors"]["columns"][3]["unit"], "full scale");
  EXPECT_EQ(dictionary["tables"]["energy"]["columns"][2]["unit"], "microjoules");
  EXPECT_THAT(program.read("tables/records.csv"),
              HasSubstr(",volume.quick.raycast.gaussian_blob_16."));
}

TEST_F(Export, IsReproducible) {
  ASSERT_EQ(program.run("export s.sqlite --out a").code, 0);
  ASSERT_EQ(program.run("export s.sqlite --out b").code, 0);
  for (const char* file : {"records.csv", "samples.csv", "dictionary.json"}) {
    EXPECT_EQ(program.read(std::string("a/") + file), program.read(std::string("b/") + file));
  }
}

TEST_F(Export, AcceptsAPlanLikeOtherCommands) {
  program.write("p.yaml", tiny_plan);
  ASSERT_EQ(program.run("run ./p.yaml --device 'null:*' --untimed --store s.sqlite").code, 0);
  const Result result = program.run("export s.sqlite --out tables --plan ./p.yaml");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("tables/runs.csv: 1 rows"));
}

TEST_F(Export, ReportsErrors) {
  EXPECT_THAT(program.run("export none.sqlite --out t").output, HasSubstr("none.sqlite"));
  EXPECT_EQ(program.run("export none.sqlite --out t").code, 2);
  const Result of_no_plan = program.run("export s.sqlite --out t --plan volume/speed");
  EXPECT_EQ(of_no_plan.code, 2);
  EXPECT_THAT(of_no_plan.output, HasSubstr("the stores contain these plans: volume/quick"));
  const Result twice = program.run("export s.sqlite s.sqlite --out t");
  EXPECT_EQ(twice.code, 3);
  EXPECT_THAT(twice.output, HasSubstr("export only one of these stores"));
  EXPECT_EQ(program.run("export s.sqlite --out s.sqlite").code, 3);
  program.write("no_store", "text");
  EXPECT_EQ(program.run("export no_store --out t").code, 3);
  EXPECT_EQ(program.run("export s.sqlite").code, 3);
}

}  // namespace
}  // namespace triptych::command_line
