// A command that the last screen prints, pasted as it stands, shows the fault again.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "core/json.hpp"
#include "program.hpp"
#include "right_picture.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

// From "triptych " to the end of the screen's block, its lines joined as a shell does; without the
// program's name.
std::string printed_command(const std::string& screen) {
  const std::size_t begin = screen.find("triptych render");
  if (begin == std::string::npos) return {};
  const std::size_t end = screen.find("\n\n", begin);
  std::string command = screen.substr(begin, end - begin);
  for (std::size_t at = 0; (at = command.find("\\\n", at)) != std::string::npos;) {
    command.erase(at, 2);
  }
  return command.substr(std::string_view("triptych ").size());
}

class Paste : public testing::Test {
 protected:
  [[nodiscard]] std::string script(const std::string& failures) const {
    return fmt::format(R"({{"images": {{"*": "{}"}}, "base_ns": 1e5{}}})", picture.string(),
                       failures);
  }

  Program program;
  std::filesystem::path picture = right_picture(program);
};

TEST_F(Paste, TheCommandOfAWrongPictureShowsIt) {
  const std::string broken = script(R"(, "failures": [{"kind": "wrong_image", "at": "image"}])");
  const std::string measure = fmt::format("run volume/quick {} --store s.sqlite", tiny);
  ASSERT_EQ(program.run(measure, broken).code, 0);
  const Result judged = program.run(
      fmt::format("gate volume/quick {} --store s.sqlite --baselines none --out out", tiny));
  ASSERT_EQ(judged.code, 1) << judged.output;
  const std::string command = printed_command(judged.output);
  ASSERT_FALSE(command.empty()) << judged.output;
  const Result pasted = program.run(command, broken);
  EXPECT_EQ(pasted.code, 1) << command << pasted.output;
  EXPECT_THAT(pasted.output, HasSubstr("pixels are over the bound against the truth"));
  EXPECT_TRUE(std::filesystem::exists(program.folder() / "repro/difference.png"));
  const Result mended = program.run(command, script(""));
  EXPECT_EQ(mended.code, 0) << mended.output;
  EXPECT_THAT(mended.output, HasSubstr("within the bound of the truth"));
}

struct Injected {
  const char* fault;
  const char* says;   // the last screen
  int code;           // of the pasted command
  const char* shows;  // what it prints
};

class PasteInjected : public Paste, public testing::WithParamInterface<Injected> {
 protected:
  // 0 where nothing was drawn.
  [[nodiscard]] std::size_t counters_in_frame() const {
    if (!std::filesystem::exists(program.folder() / "repro/frame.json")) return 0;
    return core::Json::parse(program.read("repro/frame.json")).at("counters").size();
  }
};

TEST_P(PasteInjected, TheCommandShowsTheFaultAndNothingWithoutIt) {
  const Injected& injected = GetParam();
  const std::string measure = fmt::format("run volume/quick {} --limit 2", tiny);
  const std::string right = script("");
  ASSERT_EQ(program.run(measure + " --store a.sqlite", right).code, 0);
  ASSERT_EQ(program.run("accept volume/quick --store a.sqlite --baselines b --reason new").code, 0);
  static_cast<void>(
      program.run(fmt::format("{} --store s.sqlite --plant {}", measure, injected.fault), right));
  const Result judged =
      program.run(fmt::format("gate volume/quick {} --store s.sqlite --baselines b", tiny));
  EXPECT_EQ(judged.code, 1) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr(injected.says));
  std::string command = printed_command(judged.output);
  ASSERT_THAT(command, HasSubstr(fmt::format("--plant {}", injected.fault))) << judged.output;
  const Result pasted = program.run(command, right);
  EXPECT_EQ(pasted.code, injected.code) << command << pasted.output;
  EXPECT_THAT(pasted.output, HasSubstr(injected.shows));
  const std::size_t counters = counters_in_frame();
  const std::string plant = fmt::format("--plant {}", injected.fault);
  command.erase(command.find(plant), plant.size());
  const Result mended = program.run(command, right);
  EXPECT_EQ(mended.code, 0) << mended.output;
  EXPECT_LT(counters, counters_in_frame());
}

INSTANTIATE_TEST_SUITE_P(
    Faults, PasteInjected,
    testing::Values(Injected{"crash", "crashed: killed by SIGSEGV", 3, "SIGSEGV"},
                    Injected{"device_lost", "lost: ", 3, "device_lost"},
                    Injected{"lost_counter", " is missing, stored ", 0, "repro/image.exr"}),
    [](const auto& each) { return std::string(each.param.fault); });

}  // namespace
}  // namespace triptych::command_line
