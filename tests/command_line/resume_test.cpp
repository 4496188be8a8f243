// Going on with a run: with the same plan, whatever else has its name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

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

TEST_F(Resume, AnotherPlanOfTheSameNameIsRefused) {
  ASSERT_EQ(run("one/p.yaml").code, 0);
  const Result other = run("other/p.yaml --resume");
  EXPECT_EQ(other.code, 3) << other.output;
  EXPECT_THAT(other.output, HasSubstr("step=0.5"));
  EXPECT_THAT(other.output, HasSubstr("another of that name"));
  program.write("one/p.yaml", std::string(tiny_plan) + "step: [0.5, 0.7]\n");
  const Result longer = run("one/p.yaml --resume");
  EXPECT_THAT(longer.output, HasSubstr("2 measured, 0 skipped, 0 failed"));
  EXPECT_GT(longer.output.find("1 of them were there before"), longer.output.find("2 measured"));
  EXPECT_THAT(longer.output, HasSubstr("1 of them were there before\n"));
  EXPECT_EQ(run("one/p.yaml --resume --set step=0.9").code, 3) << "of a plan that has changed";
}

TEST_F(Resume, APartOfThePlanThatTheCommandLineSetsIsItsOwn) {
  ASSERT_EQ(run("one/p.yaml --set step=0.9").code, 0);
  EXPECT_EQ(run("one/p.yaml --resume --set step=0.8").code, 0);
  EXPECT_EQ(run("one/p.yaml --resume").code, 0);
}

// A driver under test may take its machine with it.
TEST_F(Resume, AValidationGoesOn) {
  program.write("until_one_is_told.sh", R"("$@" >out 2>&1 &
for i in $(seq 600); do grep -q 'null:scripted .*: ' out && break; sleep 0.1; done
kill $!; wait $!; cat out
)");
  const auto first_told = [&](const std::string& options) {
    const Result ended =
        program.run("validate --device null:scripted " + options,
                    R"({"base_ns": 20000000, "sleep": true})", "sh until_one_is_told.sh");
    EXPECT_THAT(ended.output, HasSubstr("what was measured is in the store, --resume goes on"));
    const std::string from = ended.output.substr(ended.output.find("camera="));
    return from.substr(0, from.find(": "));
  };
  const std::string first = first_told("");
  EXPECT_NE(first_told("--resume"), first);
  EXPECT_EQ(first_told(""), first);
}

TEST_F(Resume, APlanIsGivenOnce) {
  for (const std::string plans :
       {"one/p.yaml one/p.yaml", "one/p.yaml other/p.yaml --resume", "volume/quick volume/quick"}) {
    const Result result = run(plans);
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("two plans are called"));
  }
}

}  // namespace
}  // namespace triptych::command_line
