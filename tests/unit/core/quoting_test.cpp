#include "core/quoting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

TEST(ShellQuoted, LeavesPlainWordsUnchanged) {
  EXPECT_EQ(shell_quoted("data=generate:mandelbulb:96"), "data=generate:mandelbulb:96");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("a b"), "'a b'");
  EXPECT_EQ(shell_quoted("it's"), R"('it'\''s')");
  EXPECT_EQ(shell_quoted("vulkan:*"), "'vulkan:*'");
  EXPECT_EQ(shell_quoted("=ls"), "'=ls'");  // zsh would replace it with the path of a program
  EXPECT_EQ(shell_quoted("a\x1b'\n"), "\"$(printf 'a\\033\\047')\"'\n'");
}

// Words that a shell could execute, split or truncate.
const std::vector<std::string> hostile_words{"ev$(touch x)`id`",
                                             "a;b|c&d>e<f",
                                             "it's \"both\"",
                                             "\x1b[31mred\x7f",
                                             "line\nend",
                                             "ends\n\n",
                                             "\n",
                                             "'\n$(touch x)\n'",
                                             "~",
                                             "#x",
                                             "=ls",
                                             "!!",
                                             "\x1b!!",
                                             "\x1b%s%d%%",
                                             "\x1b\\0101",
                                             "\x1b'$(touch x)'",
                                             "$'\\x41'",
                                             "{a,b}*?[c]",
                                             "-n",
                                             "µ–😀\\",
                                             "\u202Egnp.exe",
                                             "no utf-8 \xff'\\",
                                             std::string(20000, '\'')};

// Returns the installed shells, into which people may paste commands.
std::vector<std::string> shells() {
  std::vector<std::string> found;
  for (const std::string& shell :
       {std::string("dash"), std::string("bash"), std::string("zsh -f"), std::string("busybox sh"),
        std::string("ksh"), std::string("sh")}) {
    if (test::run_command(shell + " -c :").code == 0) found.push_back(shell);
  }
  return found;
}

std::string read_back(const std::string& shell, const std::string& command) {
  const test::TemporaryFolder folder;
  const auto script = folder.write("script", command);
  const test::Result result =
      test::run_command("cd '" + folder.path().string() + "' && " + shell + " " + script.string());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x")) << shell << ": " << command;
  return result.output;
}

TEST(ShellQuoted, EveryShellReadsTheWordAndRunsNothing) {
  for (const std::string& shell : shells()) {
    for (const std::string& word : hostile_words) {
      const std::array words{std::string("printf"), std::string("%s"), word};
      EXPECT_EQ(read_back(shell, shell_command(words)), word) << shell;
    }
  }
}

// Quoted words must not contain characters that a terminal hides, except line breaks at their end.
TEST(ShellQuoted, ContainsNoHiddenCharacters) {
  for (const std::string& word : hostile_words) {
    if (word.ends_with('\n')) continue;
    EXPECT_TRUE(is_line(shell_quoted(word))) << word;
  }
}

TEST(ShellEnvironment, IsReadByEveryShellWhateverTheNames) {
  for (const std::string& shell : shells()) {
    for (const std::string& hostile : hostile_words) {
      if (hostile.find('=') != std::string::npos || hostile.size() > 1000) continue;
      // `env` recognizes each entry NAME=VALUE by its '=', so it mistakes no entry for the name of
      // a program.
      const std::string name = "V" + hostile;
      const std::array words{std::string("printenv"), name};
      EXPECT_EQ(
          read_back(shell, shell_environment({{"A", "1"}, {name, hostile}}) + shell_command(words)),
          hostile + "\n")
          << shell;
    }
  }
}

TEST(ShellEnvironment, IsPlainForPlainNames) {
  EXPECT_EQ(shell_environment({}), "");
  EXPECT_EQ(shell_environment({{"A", "1"}, {"B_2", "x y"}}), "A=1 B_2='x y' ");
  EXPECT_EQ(shell_environment({{"A", "1"}, {"B;id", "2"}}), "env A=1 'B;id=2' ");
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("\x1b[31m\n\t"), "\\x1b[31m\\n\\x09");
  EXPECT_EQ(printable("µ\xff\u0085"), "µ\uFFFD\\u{0085}");
}

// These characters can make a name look like another name: some change the direction of text, and
// some are invisible.
TEST(Printable, EscapesDirectionMarks) {
  EXPECT_EQ(printable("\u202Egnp.exe\u2069\u200F"), "\\u{202e}gnp.exe\\u{2069}\\u{200f}");
  EXPECT_EQ(printable("a\u200Bb\uFEFF\U000E0041"), "a\\u{200b}b\\u{feff}\\u{e0041}");
  // This character joins letters, so it is kept.
  EXPECT_EQ(printable("\u0645\u200C\u0627"), "\u0645\u200C\u0627");
}

TEST(Printable, KeepsLineEnds) {
  EXPECT_EQ(printable_lines("a\n\tb\x1b\r\u202E\n"), "a\n\tb\\x1b\\x0d\\u{202e}\n");
}

TEST(Printable, CutsByCharacters) {
  EXPECT_EQ(printable("µµµ", 3), "µµµ");
  EXPECT_EQ(printable("µµµµ", 3), "µµ…");
  EXPECT_EQ(printable(std::string(1'000'000, 'x'), 80).size(), 79 + std::string("…").size());
  EXPECT_EQ(printable("ab", 1), "…");
}

}  // namespace
}  // namespace triptych::core
