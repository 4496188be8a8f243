// Tests inputs that are not valid plans, and their error messages.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "core/file.hpp"
#include "plan_fixture.hpp"

namespace triptych::measure {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST_F(PlanTest, UnknownFactorNamesTheNearest) {
  EXPECT_THAT(refusal("suite: fake\ndata: cube\nstepp: 1\n"),
              AllOf(StartsWith(at(3, 1)), HasSubstr("'stepp'"), HasSubstr("did you mean 'step'")));
  EXPECT_THAT(refusal("suite: fake\ncompletely_else: 1\n"),
              HasSubstr("expected one of: technique, data"));
}

TEST_F(PlanTest, FactorTwice) {
  EXPECT_THAT(refusal("suite: fake\nstep: 1\nert: 0\nstep: 2\n"),
              AllOf(StartsWith(at(4, 1)), HasSubstr("twice"), HasSubstr("line 2")));
}

TEST_F(PlanTest, WrongType) {
  EXPECT_THAT(refusal("suite: fake\nstep: [0.5, fast]\n"),
              AllOf(StartsWith(at(2, 13)), HasSubstr("expected a number, found 'fast'")));
  for (const char* bad : {".nan", ".inf", "inf", "nan", "1e999", "0.5x", "0x1", "+-1", "true"}) {
    EXPECT_THAT(refusal("suite: fake\nstep: " + std::string(bad) + "\n"),
                AllOf(StartsWith(at(2, 7)), HasSubstr("expected a number")))
        << bad;
  }
}

TEST_F(PlanTest, RangeOfViewsWithoutACount) {
  for (const char* bad : {"0", "-3", "2.5", "x", "", "1000000"}) {
    EXPECT_THAT(refusal("suite: fake\ncamera: ['orbit_y:*/" + std::string(bad) + "']\n"),
                AllOf(StartsWith(at(2, 10)), HasSubstr("expected a whole number from 1 to 10000")))
        << bad;
  }
  EXPECT_THAT(refusal("suite: fake\ncamera: ['orbit_y:1/3', 'orbit_y:*/3']\n"),
              AllOf(StartsWith(at(2, 25)), HasSubstr("orbit_y:1/3 appears twice")));
}

TEST_F(PlanTest, OutOfRange) {
  EXPECT_THAT(refusal("suite: fake\nstep: 100\n"),
              AllOf(StartsWith(at(2, 7)), HasSubstr("out of range"), HasSubstr("0.01 to 16")));
  EXPECT_THAT(refusal("suite: fake\nstep: -1\n"), HasSubstr("out of range"));
}

TEST_F(PlanTest, UnknownLevel) {
  EXPECT_THAT(
      refusal("suite: fake\nskip:\n  - none\n  - brick\n"),
      AllOf(StartsWith(at(4, 5)), HasSubstr("'brick'"), HasSubstr("did you mean 'bricks'")));
}

TEST_F(PlanTest, ValueThatTheSuiteRejects) {
  EXPECT_THAT(refusal("suite: fake\ndata: [cube, nonsense]\n"),
              AllOf(StartsWith(at(2, 14)), HasSubstr("'data': expected a file")));
}

TEST_F(PlanTest, EmptyListAndMissingValue) {
  EXPECT_THAT(refusal("suite: fake\nstep: []\n"), AllOf(StartsWith(at(2, 7)), HasSubstr("empty")));
  EXPECT_THAT(refusal("suite: fake\nstep:\n"), HasSubstr("'step' has no value"));
  EXPECT_THAT(refusal("suite: fake\nstep: [1, ~]\n"), HasSubstr("'step' has no value"));
  EXPECT_THAT(refusal("suite: fake\ndata: ''\n"), HasSubstr("not be empty"));
}

TEST_F(PlanTest, DuplicateValueAlsoInAnotherSpelling) {
  EXPECT_THAT(refusal("suite: fake\nstep: [0.5, 1, .5]\n"),
              AllOf(StartsWith(at(2, 16)), HasSubstr("twice"), HasSubstr("first as 0.5")));
  EXPECT_THAT(refusal("suite: fake\ndata: [cube, cube]\n"), StartsWith(at(2, 14)));
}

TEST_F(PlanTest, NestedListsAndMappings) {
  EXPECT_THAT(refusal("suite: fake\nstep: [[1]]\n"),
              AllOf(StartsWith(at(2, 8)), HasSubstr("list within a list")));
  EXPECT_THAT(refusal("suite: fake\nstep: {a: 1}\n"),
              AllOf(StartsWith(at(2, 7)), HasSubstr("mapping")));
}

TEST_F(PlanTest, InvalidUtf8) {
  for (const char* const value : {"a\xff", "\xc0\xaf", "\xed\xa0\x80", "\"a\\x00b\"", "\"a\\tb\"",
                                  "\"a\\x7f\"", "\"\\x1b[2J\""}) {
    EXPECT_THAT(refusal(std::string("suite: fake\ndata: [ball, ") + value + "]\n"),
                AllOf(StartsWith(at(2, 14)), HasSubstr("UTF-8 without")));
  }
  EXPECT_THAT(load("suite: fake\ndata: [größe, 体積, \U0001F9CA]\n").configurations, SizeIs(3));
}

TEST_F(PlanTest, ValueThatWouldBreakALine) {
  EXPECT_THAT(refusal("suite: fake\ndata: [\"a\\nb\"]\n"), HasSubstr("without line breaks"));
}

TEST_F(PlanTest, Suite) {
  EXPECT_THAT(refusal("data: cube\n"), HasSubstr("'suite:' is missing"));
  EXPECT_THAT(refusal("data: cube\nsuite: fakee\n"),
              AllOf(StartsWith(at(2, 8)), HasSubstr("unknown suite 'fakee'")));
  EXPECT_THAT(refusal("suite: [fake]\n"), StartsWith(at(1, 8)));
}

TEST_F(PlanTest, FilesThatAreNotPlans) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("empty"));
  EXPECT_THAT(refusal("- suite\n"), StartsWith(at(1, 1)));
  EXPECT_THAT(refusal("suite: fake\n---\nsuite: fake\n"), HasSubstr("second YAML document"));
  EXPECT_THAT(refusal("suite: fake\nstep: [0.5\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal("suite: fake\nname: x\n"), HasSubstr("unknown factor 'name'"));
}

// If a document begins with one of these tokens, yaml-cpp would return empty documents forever.
TEST_F(PlanTest, TokensThatCannotBeginADocument) {
  EXPECT_THAT(refusal(",\n"), AllOf(StartsWith(at(1, 1)), HasSubstr("not valid YAML")));
  EXPECT_THAT(refusal("&R, x\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal("!x y, z\n"), StartsWith(at(1, 1)));
  EXPECT_THAT(refusal("!x ,\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal("]"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal("{suite: fake} ,\n"), HasSubstr("not valid YAML"));
}

TEST_F(PlanTest, PipesAndEndlessFilesAreRejected) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT([&] { static_cast<void>(load_plan(file_.string(), {}, find_)); },
              ThrowsMessage<core::InputError>(HasSubstr("is a pipe or a device")));
  std::filesystem::remove(file_);
  EXPECT_THAT([&] { static_cast<void>(load_plan("/dev/zero", {}, find_)); },
              ThrowsMessage<core::InputError>(HasSubstr("is a pipe or a device")));
  EXPECT_THAT(refusal("suite: fake\n#" + std::string(core::most_text_bytes, 'x')),
              HasSubstr("is too large"));
}

TEST_F(PlanTest, ErrorsInASuitesOwnPlanNameIt) {
  try {
    static_cast<void>(load_plan("fake/broken", {}, find_));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.place().file, "fake/broken");
    EXPECT_GT(error.place().line, 0);
  }
}

TEST_F(PlanTest, UnknownPlansAndFiles) {
  EXPECT_THROW(static_cast<void>(load_plan("fake/quik", {}, find_)), core::InputError);
  EXPECT_THROW(static_cast<void>(load_plan("other/quick", {}, find_)), core::InputError);
  EXPECT_THROW(static_cast<void>(load_plan("no_such.yaml", {}, find_)), core::InputError);
  EXPECT_THROW(static_cast<void>(load_plan(::testing::TempDir(), {}, find_)), core::InputError);
  EXPECT_THROW(static_cast<void>(load_plan("", {}, find_)), core::InputError);
}

TEST_F(PlanTest, TooManyCombinations) {
  std::string list = "[1";
  for (int i = 2; i <= 101; ++i) list += ", " + std::to_string(i);
  list += "]\n";
  // 101³ combinations are more than a plan may have.
  const std::string yaml = "suite: fake\ndata: " + list + "camera: " + list + "viewport: " + list;
  EXPECT_THAT(refusal(yaml), AllOf(StartsWith(at(3, 1)), HasSubstr("1000000 combinations")));
}

}  // namespace
}  // namespace triptych::measure
