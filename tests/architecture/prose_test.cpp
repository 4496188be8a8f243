// Tests that no code parses messages that are written for people.

#include <gtest/gtest.h>

#include "source_tree.hpp"

namespace triptych::architecture {
namespace {

// Matches code that searches a message, or compares a message with a string literal. The test does
// not search src/core, because the code there only quotes messages.
const std::regex reads_prose(
    R"(\b(detail|last_words|last_output|message|what\(\)|text_of\([^()]*\)|headline\([^()]*\)|advice\([^()]*\)))"
    R"(\s*(\.\s*(find|rfind|starts_with|ends_with|contains|substr|compare)\b|[=!]=\s*"[^"]))");

TEST(Prose, IsRecognised) {
  for (const char* bad :
       {"record.reason.detail.starts_with(\"bad\")", "if (error.what().find(x))",
        "finding.message.substr(0, 3)", "detail == \"hung\"", "text_of(finding).find(\";\")"}) {
    EXPECT_TRUE(std::regex_search(bad, reads_prose)) << bad;
  }
  for (const char* good :
       {"detail.empty()", "text += detail", "message.json.find(key)", "a.detail == b.detail"}) {
    EXPECT_FALSE(std::regex_search(good, reads_prose)) << good;
  }
}

TEST(Prose, IsNeverParsed) {
  for (const std::string folder : {"src/record", "src/judge", "src/measure", "src/report",
                                   "src/reduction", "src/comparison", "src/app"}) {
    for (const auto& file : files_below(folder, {".hpp", ".cpp"})) {
      const std::string text = read(file);
      std::smatch found;
      EXPECT_FALSE(std::regex_search(text, found, reads_prose)) << file << ": " << found.str();
    }
  }
}

}  // namespace
}  // namespace triptych::architecture
