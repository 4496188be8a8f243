#include "core/quoting.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

TEST(ShellQuoted, LeavesAloneWhatNeedsNoQuotes) {
  EXPECT_EQ(shell_quoted("data=generate:mandelbulb:96"), "data=generate:mandelbulb:96");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("a b"), "'a b'");
  EXPECT_EQ(shell_quoted("it's"), R"('it'\''s')");
  EXPECT_EQ(shell_quoted("vulkan:*"), "'vulkan:*'");
  EXPECT_EQ(shell_quoted("a\x1b'\n"), R"($'a\033\'\012')");
}

// What the shell makes of it is the word again.
TEST(ShellQuoted, IsReadBackByAShell) {
  for (const std::string& word :
       {std::string("ev$(touch x)`id`"), std::string("a;b|c&d>e<f"), std::string("it's \"both\""),
        std::string("\x1b[31mred\x7f"), std::string("line\nend"), std::string("~"),
        std::string("#x"), std::string("µ–😀\\"), std::string("no utf-8 \xff'\\"),
        std::string(20000, '\'')}) {
    const std::array words{std::string("printf"), std::string("%s"), word};
    const test::TemporaryFolder folder;
    const auto script = folder.write("script", shell_command(words));
    EXPECT_EQ(test::run_command("bash " + script.string()).output, word);
  }
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[31m\n\t"), "\\x1b[31m\\n\\x09");
  EXPECT_EQ(printable("µ\xff\u0085"), "µ\uFFFD\uFFFD");
}

TEST(Printable, CutsByCharacters) {
  EXPECT_EQ(printable("µµµ", 3), "µµµ");
  EXPECT_EQ(printable("µµµµ", 3), "µµ…");
  EXPECT_EQ(printable(std::string(1'000'000, 'x'), 80).size(), 79 + std::string("…").size());
  EXPECT_EQ(printable("ab", 1), "…");
}

}  // namespace
}  // namespace triptych::core
