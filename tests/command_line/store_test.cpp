// Tests that a run either stores its records in the file that the user names, or reports that it
// cannot store them.

#include "record/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

const std::string one = std::string("run volume/quick ") + tiny + " --set step=1";

TEST(StoreName, AnEmptyNameIsRejectedBeforeMeasuring) {
  const Program program;
  const Result result = program.run(one + " --store ''");
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("the name of the store is empty"));
  EXPECT_EQ(program.run("gate volume/quick --store ''").code, 3);
}

// SQLite would interpret each of these names as an in-memory database.
TEST(StoreName, SqliteMemoryNamesAreFiles) {
  for (const std::string name : {":memory:", "file:x?mode=memory"}) {
    const Program program;
    const Result result = program.run(one + " --store '" + name + "'");
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_EQ(program.read(name).substr(0, 13), "SQLite format") << name;
  }
}

TEST(EmptyStore, CannotBeMergedAlone) {
  const Program program;
  { const record::Store empty(program.folder() / "empty.sqlite", record::Store::Mode::append); }
  const Result none = program.run("merge empty.sqlite --out m.sqlite");
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.output,
            "triptych: there is nothing to merge, because no store contains a run: empty.sqlite\n");
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "m.sqlite"));
  ASSERT_EQ(program.run(one + " --store s.sqlite").code, 0);
  EXPECT_EQ(program.run("merge empty.sqlite s.sqlite --out m.sqlite").code, 0);
}

}  // namespace
}  // namespace triptych::command_line
