// Tests that a run can be resumed only with the same plan, even if another plan has the same name.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "findings.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class Resume : public testing::Test {
 protected:
  Resume() {
    for (const char* folder : {"one", "other"}) {
      std::filesystem::create_directory(program.folder() / folder);
    }
    program.write("one/p.yaml", std::string(tiny_plan) + "step: [0.5]\n");
    program.write("other/p.yaml", std::string(tiny_plan) + "step: [0.7]\n");
  }
  [[nodiscard]] Result run(const std::string& arguments) const {
    return program.run("run " + arguments + " --device 'null:*' --store s.sqlite");
  }
  Program program;
};

TEST_F(Resume, AnotherPlanWithTheSameNameIsRejected) {
  ASSERT_EQ(run("one/p.yaml").code, 0);
  const Result other = run("other/p.yaml --resume");
  EXPECT_EQ(other.code, 3) << other.output;
  EXPECT_THAT(other.output, HasSubstr("step=0.5"));
  EXPECT_THAT(other.output, HasSubstr("a different plan has the same name"));
  program.write("one/p.yaml", std::string(tiny_plan) + "step: [0.5, 0.7]\n");
  const Result longer = run("one/p.yaml --resume");
  EXPECT_THAT(longer.output, HasSubstr("2 measured, 0 skipped, 0 failed"));
  EXPECT_GT(longer.output.find("1 of these results were already in the store"),
            longer.output.find("2 measured"));
  EXPECT_THAT(longer.output, HasSubstr("1 of these results were already in the store\n"));
  EXPECT_EQ(run("one/p.yaml --resume --set step=0.9").code, 3) << "the plan has changed";
}

TEST_F(Resume, PartsOfAPlanAreResumedSeparately) {
  ASSERT_EQ(run("one/p.yaml --set step=0.9").code, 0);
  EXPECT_EQ(run("one/p.yaml --resume --set step=0.8").code, 0);
  EXPECT_EQ(run("one/p.yaml --resume").code, 0);
}

// Starts a validation and interrupts it as soon as it has reported one configuration. Starting the
// program empties the output file, so the output of an earlier validation does not count.
Result validate_one(const Program& program, const std::string& options) {
  program.write("until_one_is_told.sh", R"(rm -f out; "$@" >out 2>&1 &
for i in $(seq 600); do grep -qs 'null:scripted .*: ' out && break; sleep 0.1; done
kill -INT $!; wait $!; code=$?; cat out; exit $code
)");
  return program.run("validate --verbose --device null:scripted " + options,
                     R"({"base_ns": 20000000, "sleep": true})", "bash until_one_is_told.sh");
}

// A driver under test may crash the machine, so a validation can be resumed.
TEST_F(Resume, AValidationCanBeResumed) {
  const auto first_words = [&](const std::string& options) {
    const Result ended = validate_one(program, options);
    EXPECT_THAT(ended.output,
                HasSubstr("the records so far are in the store; use --resume to continue"));
    const std::string from = ended.output.substr(ended.output.find("null:scripted "));
    return from.substr(0, from.find(": "));
  };
  const std::string first = first_words("");
  EXPECT_NE(first_words("--resume"), first);
  EXPECT_EQ(first_words(""), first);
}

// The part that was measured is judged, and the missing part does not count as a pass.
TEST_F(Resume, AnInterruptedValidationEndsWithTheSummaryScreen) {
  const Result ended = validate_one(program, "--junit j.xml --json j.json");
  EXPECT_EQ(ended.code, 1) << ended.output;  // the measured image is wrong
  EXPECT_THAT(ended.output, HasSubstr("Triptych   1 device"));
  EXPECT_THAT(ended.output, HasSubstr("exit 1: "));
  EXPECT_THAT(ended.output, HasSubstr("validation/report.html"));
  EXPECT_THAT(program.read("j.xml"), HasSubstr("volume/quick.image"));
  EXPECT_THAT(program.read("j.xml"), HasSubstr("particles/accuracy.image"));
  const std::string json = program.read("j.json");
  const auto missing = findings_of(json, "missing");
  ASSERT_THAT(missing, SizeIs(1));
  const double wanted = missing[0].at("numbers").at("wanted");
  const double lacking = missing[0].at("numbers").at("missing");
  EXPECT_EQ(missing[0].at("verdict"), "cannot_judge");
  EXPECT_EQ(missing[0].at("device"), "null:scripted");
  EXPECT_EQ(missing[0].at("names").size(), lacking);
  // At least one configuration was measured. Because the interrupt came soon afterwards, at most
  // six were measured.
  EXPECT_GE(lacking, wanted - 6);
  EXPECT_LT(lacking, wanted);
  // The screen and the log must contain the same numbers.
  const std::string numbers = fmt::format("{} of {} planned", lacking, wanted);
  EXPECT_THAT(ended.output, HasSubstr(numbers));
  EXPECT_THAT(program.read("validation/gate.log"), HasSubstr(numbers));
  // `triptych run --resume` would finish only one of the plans, and judge none of them.
  const std::string command = "triptych validate --device null:scripted --resume --out validation";
  EXPECT_EQ(missing[0].at("advice").at("command"), command);
  EXPECT_EQ(findings_of(json, "no_run").at(0).at("advice").at("command"), command);
  EXPECT_THAT(findings_of(json, "no_run"), SizeIs(5));
  EXPECT_THAT(findings_of(json, "no_run", "particles/accuracy"), SizeIs(1));
}

TEST_F(Resume, AnInterruptedValidationDoesNotJudgeAnEarlierOne) {
  std::filesystem::create_directory(program.folder() / "validation");
  ASSERT_EQ(program
                .run("run particles/quick --untimed --set technique=point --device 'null:*' "
                     "--store validation/validation.sqlite")
                .code,
            0);
  static_cast<void>(validate_one(program, "--json j.json"));
  EXPECT_THAT(findings_of(program.read("j.json"), "no_run", "particles/quick"), SizeIs(1));
  EXPECT_THAT(program.read("j.json"), ::testing::Not(HasSubstr("technique=point")));
}

TEST_F(Resume, APlanMustNotBeNamedTwice) {
  for (const std::string plans :
       {"one/p.yaml one/p.yaml", "one/p.yaml other/p.yaml --resume", "volume/quick volume/quick"}) {
    const Result result = run(plans);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("two plans are named"));
  }
}

}  // namespace
}  // namespace triptych::command_line
