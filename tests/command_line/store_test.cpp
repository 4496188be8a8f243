// Where a run's records go: into the file that was named, or the run says that it cannot.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace triptych::command_line {
namespace {

using ::testing::HasSubstr;

const std::string one = std::string("run volume/quick ") + tiny + " --set step=1";

TEST(StoreName, OneWithoutCharactersIsRefusedBeforeAnythingIsMeasured) {
  const Program program;
  const Result result = program.run(one + " --store ''");
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("a store needs the name of a file"));
  EXPECT_EQ(program.run("gate volume/quick --store ''").code, 3);
}

// SQLite would take each for a store that ends with the process.
TEST(StoreName, OneThatMeansMemoryToSqliteIsAFile) {
  for (const std::string name : {":memory:", "file:x?mode=memory"}) {
    const Program program;
    const Result result = program.run(one + " --store '" + name + "'");
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_EQ(program.read(name).substr(0, 13), "SQLite format") << name;
  }
}

}  // namespace
}  // namespace triptych::command_line
