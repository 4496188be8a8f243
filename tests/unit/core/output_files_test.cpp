#include "core/output_files.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/temporary_folder.hpp"

namespace triptych::core {
namespace {

TEST(OutputFiles, MustDifferFromInputFiles) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "a").string();
  const std::string same = (folder.path() / "." / "a").string();
  EXPECT_NO_THROW(refuse_overwriting({{"--store", file}}, {{"--out", file + "b"}, {"--json", ""}}));
  EXPECT_THROW(refuse_overwriting({{"--store", file}}, {{"--out", same}}), InputError);
  EXPECT_THROW(refuse_overwriting({}, {{"--out", file}, {"--json", same}}), InputError);
  write_file("there", file);
  EXPECT_THROW(refuse_overwriting({{"--store", file}}, {{"--out", same}}), InputError);
  EXPECT_NO_THROW(refuse_overwriting({}, {{"--out", "/dev/null"}, {"--json", "/dev/null"}}));
}

TEST(OutputFiles, CreateTheirFolder) {
  const TemporaryFolder folder;
  write_text(folder.path() / "b/c/d", "text");
  EXPECT_EQ(read_text(folder.path() / "b/c/d"), "text");
  EXPECT_THROW(require_writable(folder.path() / "b/c/d/e"), IoError);
}

}  // namespace
}  // namespace triptych::core
