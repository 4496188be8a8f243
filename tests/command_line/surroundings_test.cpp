// Tests that verdicts do not depend on the locale or the clock of the machine.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;

class Surroundings : public testing::Test {
 protected:
  // Measures and accepts the plan with the usual locale and time.
  void SetUp() override {
    const std::string given = " --device null:scripted --store s.sqlite";
    program.write("p.yaml",
                  std::string(tiny_plan) + "step: [0.5, 1]\nchecks: [counters, memory]\n");
    ASSERT_EQ(program.run("run p.yaml" + given).code, 0);
    ASSERT_EQ(program.run("accept p.yaml --reason x --store s.sqlite --baselines b").code, 0);
  }
  [[nodiscard]] Result judge_again(const std::string& wrapper,
                                   const std::string& script = "{}") const {
    return program.run(
        "gate p.yaml --measure --device null:scripted --store other.sqlite --baselines b", script,
        wrapper);
  }

  Program program;
};

// German writes 0,5 for 0.5, and in Turkish the capital of i is not I.
TEST_F(Surroundings, TheLocaleHasNoEffect) {
  const std::string usual = program.run("list p.yaml").output;
  for (const std::string locale : {"de_DE", "tr_TR"}) {
    const std::string folder = program.folder().string();
    const std::string made = folder + "/" + locale + ".UTF-8";
    if (test::run_command("localedef -i " + locale + " -f UTF-8 '" + made + "'").code > 1) {
      GTEST_SKIP() << "locales cannot be created on this machine";
    }
    const std::string wrapper = "env LOCPATH='" + folder + "' LC_ALL=" + locale + ".UTF-8";
    EXPECT_EQ(program.run("list p.yaml", "{}", wrapper).output, usual) << locale;
    const Result judged = judge_again(wrapper);
    EXPECT_EQ(judged.code, 0) << locale << judged.output;
  }
}

// The latest run is the one that was added last, whatever its date is. A waiver that had expired
// when the run began stays expired.
TEST_F(Surroundings, AClockThatWasSetBackHasNoEffect) {
  if (test::run_command("faketime -f -400d true").code != 0) {
    GTEST_SKIP() << "faketime is not installed";
  }
  const std::string crash = R"({"failures": [{"kind": "crash", "at": "frame"}]})";
  ASSERT_EQ(judge_again("").code, 0);
  Result judged = judge_again("faketime -f -400d", crash);
  EXPECT_EQ(judged.code, 1) << judged.output;
  judged = judge_again("faketime -f -400d");
  EXPECT_EQ(judged.code, 0) << judged.output;

  ASSERT_EQ(judge_again("", crash).code, 1);
  const auto gate_with_waiver = [&](const std::string& expiry) {
    const std::string day = test::run_command("date -u +%F -d " + expiry).output.substr(0, 10);
    program.write("b/waivers.json", R"([{"device": "null:*", "test": "*", "reason": "x", )"
                                    R"("expiry": ")" +
                                        day + "\"}]");
    return program.run("gate p.yaml --store other.sqlite --baselines b", "{}", "faketime -f -30d");
  };
  judged = gate_with_waiver("yesterday");
  EXPECT_EQ(judged.code, 1) << judged.output;
  // This waiver applies, but then nothing is left to judge.
  judged = gate_with_waiver("'2 days'");
  EXPECT_EQ(judged.code, 2) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("2 waived"));
}

}  // namespace
}  // namespace triptych::command_line
