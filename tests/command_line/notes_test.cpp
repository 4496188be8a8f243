// Tests that guesses about data, such as elements derived from atom names, are printed once, no
// matter how many configurations and devices use the data.

#include <gtest/gtest.h>

#include <algorithm>

#include "program.hpp"

namespace triptych::command_line {
namespace {

int count_of(std::string_view part, std::string_view text) {
  int count = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(Notes, ArePrintedOnce) {
  const Program program;
  program.write("ligand.gro",
                "made\n    1\n    1LIG     SI    1   0.100   0.100   0.100\n   1.0 1.0 1.0\n");
  // The worker process of the device draws several configurations, and a second process computes
  // the reference images. Both processes read the file and guess the element.
  const Result result = program.run(
      "gate particles/quick --measure --check image --device null:scripted --set data=ligand.gro "
      "--set technique=point --set viewport=16,32 --store s.sqlite --baselines b 2>&1");
  EXPECT_EQ(count_of("guessed from the atom names: Si 1", result.output), 1) << result.output;
}

}  // namespace
}  // namespace triptych::command_line
