// A command that the last screen prints, pasted as it stands, shows the fault again.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

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

}  // namespace
}  // namespace triptych::command_line
