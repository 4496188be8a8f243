// Tests that a command printed on the summary screen (at the end of a gate) reproduces the
// fault when it is pasted unchanged.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>
#include <string>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct Printed {
  std::string environment;  // the variables that precede the program's name
  std::string arguments;
};

// Returns the first command on the screen, with its lines joined as a shell joins them.
Printed printed_command(const std::string& screen) {
  constexpr std::string_view program = "triptych ";
  static const std::regex line_with_command("\n    (\\w+=\\S+ (\\\\\n +)?)*triptych ");
  std::smatch found;
  if (!std::regex_search(screen, found, line_with_command)) return {};
  const auto begin = static_cast<std::size_t>(found.position()) + 1;
  const std::string lines = screen.substr(begin, screen.find("\n\n", begin) - begin);
  const std::string text = std::regex_replace(lines, std::regex("\\\\\n +"), "");
  const std::size_t name = text.find(program);
  return {text.substr(0, name), text.substr(name + program.size())};
}

std::string first_lines(const std::string& screen) {
  std::size_t end = screen.find("Triptych   ");
  for (int line = 0; line < 3 && end != std::string::npos; ++line) end = screen.find('\n', end + 1);
  return screen.substr(0, end);
}

Printed without(Printed command, const std::string& part) {
  const std::size_t at = command.arguments.find(part);
  if (at != std::string::npos) command.arguments.erase(at, part.size());
  return command;
}

class Paste : public testing::Test {
 protected:
  [[nodiscard]] std::string script(const std::string& failures) const {
    return fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": 1e5{}}})", image_file.string(),
                       failures);
  }

  [[nodiscard]] Result paste(const Printed& command, const std::string& device = "{}") const {
    return program.run(command.arguments, device, "env " + command.environment);
  }

  Program program;
  std::filesystem::path image_file = correct_image(program);
};

TEST_F(Paste, TheCommandForAWrongImageReproducesIt) {
  const std::string broken = script(R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  const std::string measure = fmt::format("run volume/quick {} --store s.sqlite", tiny);
  ASSERT_EQ(program.run(measure, broken).code, 0);
  const Result judged = program.run(
      fmt::format("gate volume/quick {} --store s.sqlite --baselines none --out out", tiny));
  ASSERT_EQ(judged.code, 1) << judged.output;
  const Printed command = printed_command(judged.output);
  ASSERT_FALSE(command.arguments.empty()) << judged.output;
  const Result pasted = paste(command, broken);
  EXPECT_EQ(pasted.code, 1) << command.arguments << pasted.output;
  EXPECT_THAT(pasted.output, HasSubstr("pixels exceed the error bound of the reference image"));
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "repro/difference.png"));
  const Result repaired = paste(command, script(""));
  EXPECT_EQ(repaired.code, 0) << repaired.output;
  EXPECT_THAT(repaired.output, HasSubstr("within the error bound of the reference image"));
}

struct Injected {
  const char* fault;
  const char* expected;    // text that must appear in the first lines of the summary screen
  int code;                // exit code of the pasted command
  const char* shows;       // text that the pasted command must print
  const char* extra = "";  // text that the command must contain
};

class PasteInjected : public Paste, public testing::WithParamInterface<Injected> {};

TEST_P(PasteInjected, TheCommandReproducesOnlyTheFault) {
  const Injected& injected = GetParam();
  const std::string measure = fmt::format("run volume/quick {} --limit 2", tiny);
  const std::string right = script("");
  ASSERT_EQ(program.run(measure + " --store a.sqlite", right).code, 0);
  ASSERT_EQ(program.run("accept volume/quick --store a.sqlite --baselines b --reason new").code, 0);
  static_cast<void>(
      program.run(fmt::format("{} --store s.sqlite --inject {}", measure, injected.fault), right));
  const Result judged =
      program.run(fmt::format("gate volume/quick {} --store s.sqlite --baselines b", tiny));
  EXPECT_EQ(judged.code, 1) << judged.output;
  EXPECT_THAT(first_lines(judged.output),
              AllOf(HasSubstr(injected.expected), HasSubstr("null:scripted")));
  const std::string fault = fmt::format("--inject {}", injected.fault);
  const Printed command = printed_command(judged.output);
  ASSERT_THAT(command.arguments, AllOf(HasSubstr(fault), HasSubstr(injected.extra)))
      << judged.output;
  const Result pasted = paste(command, right);
  EXPECT_EQ(pasted.code, injected.code) << command.arguments << pasted.output;
  EXPECT_THAT(pasted.output, HasSubstr(injected.shows));
  const Result repaired = paste(without(command, fault), right);
  EXPECT_EQ(repaired.code, 0) << repaired.output;
}

INSTANTIATE_TEST_SUITE_P(Faults, PasteInjected,
                         testing::Values(Injected{"crash", "killed by SIGSEGV", 3, "SIGSEGV"},
                                         Injected{"hang", "hung: no answer within 2 s", 3,
                                                  "no answer within 2 s", "--limit 2"},
                                         Injected{"device_lost", "lost: ", 3, "device_lost"},
                                         Injected{"lost_counter", " is missing; ", 1,
                                                  " is missing; ", "gate volume/quick"}),
                         [](const auto& each) { return std::string(each.param.fault); });

// These tests use a real device, because scripted devices compute nothing.
class PasteOnDevice : public Paste {
 protected:
  static constexpr const char* device = "opencl:pocl";

  // Returns the command that the gate's summary screen prints for a plan with this fault and these
  // checks. If the device is missing, nothing is measured and the result is empty.
  Printed command_about(const std::string& fault, const std::string& checks,
                        const std::string& expected) {
    std::filesystem::create_directory(program.folder() / "my plans");
    program.write("my plans/small.yaml",
                  fmt::format("{}checks: [{}]\nstep: [1, 2]\n", tiny_plan, checks));
    const std::string measure = fmt::format("run 'my plans/small.yaml' --device {}", device);
    const Result accepted = program.run(measure + " --store a.sqlite");
    if (accepted.output.find(" 2 measured") == std::string::npos) return {};
    EXPECT_EQ(
        program.run("accept 'my plans/small.yaml' --store a.sqlite --baselines b --reason new")
            .code,
        0);
    EXPECT_EQ(program.run(fmt::format("{} --store s.sqlite --inject {}", measure, fault)).code, 0);
    const Result judged = program.run("gate 'my plans/small.yaml' --store s.sqlite --baselines b");
    EXPECT_EQ(judged.code, 1) << judged.output;
    EXPECT_THAT(first_lines(judged.output), AllOf(HasSubstr(expected), HasSubstr(device)));
    return printed_command(judged.output);
  }
  void expect_code(const Printed& command, int code) const {
    const Result pasted = paste(command);
    EXPECT_EQ(pasted.code, code) << command.arguments << '\n' << pasted.output;
  }
};

TEST_F(PasteOnDevice, TheCommandForASlowerKernelReproducesIt) {
  const Printed command = command_about("slowdown:5", "cost", "instructions ");
  if (command.arguments.empty() && !HasFailure())
    GTEST_SKIP() << device << " cannot count on this machine";
  EXPECT_THAT(command.arguments,
              AllOf(HasSubstr("gate 'my plans/small.yaml' "), HasSubstr("--set step=1 ")));
  expect_code(command, 1);
  expect_code(without(command, "--inject slowdown:5"), 0);
}

TEST_F(PasteOnDevice, TheCommandForAShiftedImageReproducesIt) {
  const Printed command = command_about("half_voxel_shift", "image", "exceed the error bound");
  if (command.arguments.empty() && !HasFailure()) GTEST_SKIP() << "no device " << device;
  EXPECT_THAT(command.arguments, HasSubstr("render volume "));
  expect_code(command, 1);
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "repro/difference.png"));
  expect_code(without(command, "--inject half_voxel_shift"), 0);
}

}  // namespace
}  // namespace triptych::command_line
