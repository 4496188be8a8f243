// Tests limits on the memory of workers, and full disks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "correct_image.hpp"
#include "program.hpp"
#include "tree.hpp"

namespace triptych::command_line {
namespace {

using testing::HasSubstr;

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;  // AddressSanitizer itself exceeds every limit
#else
constexpr bool sanitized = false;
#endif

const std::string any_size =
    "run volume/quick --device null:scripted --set technique=raycast --set transfer_function=haze "
    "--set camera=orbit_y:1/8 --set step=1 --store s.sqlite ";
const std::string small = any_size + "--set viewport=16 ";

TEST(Memory, DataBeyondTheLimitFailOnlyTheirConfiguration) {
  if (sanitized) GTEST_SKIP() << "built with a sanitizer";
  const Program program;
  const std::string data = "--set data=generate:gaussian_blob:16,generate:gaussian_blob:500 ";
  const Result result = program.run(small + data + "--memory 300M");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(
      result.output,
      HasSubstr("ran out of host memory while using the data set generate:gaussian_blob:500; "
                "the worker may allocate at most 300 MiB"));
  EXPECT_THAT(result.output, HasSubstr("1 measured, 0 skipped, 1 failed"));
}

// The voxels are stored in a file of 526 MiB and drawn in parts of 16 MiB. Therefore a process
// whose data must not exceed 391 MiB (ulimit -d 400000) can draw them.
TEST(Memory, IsNotUsedByVoxelsInAFile) {
  if (sanitized) GTEST_SKIP() << "built with a sanitizer";
  const Program program;
  const std::string pocl = "opencl:pocl";
  if (program.run("devices").output.find(pocl) == std::string::npos) {
    GTEST_SKIP() << pocl << " is not available";
  }
  const Result result = program.run(
      "render volume --device " + pocl +
          " --set data=generate:sparse_field:820 --set budget=16 --set viewport=16 --truth --out o",
      "{}", "sh -c 'ulimit -d 400000; exec \"$@\"' sh");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("within the error bound of the reference image"));
}

TEST(Memory, ASizeIsANumberOfBytes) {
  const Program program;
  for (const char* size : {"12x", "-1G", "1M", "99999999999G"}) {
    const Result result =
        program.run(small + "--set data=generate:gaussian_blob:16 --memory " + size);
    EXPECT_EQ(result.code, 3) << size << result.output;
    EXPECT_THAT(result.output, HasSubstr("--memory"));
  }
}

// Returns a command that limits the size of every file to this many blocks of 512 bytes.
std::string files_up_to(int blocks) {
  return "sh -c 'trap \"\" XFSZ; ulimit -f " + std::to_string(blocks) + "; exec \"$@\"' sh";
}

TEST(FullDisk, ARunReportsItAndCanBeResumed) {
  const std::string run = small + "--set data=generate:gaussian_blob:16 ";
  for (const int blocks : {1, 100, 250, 350}) {
    const Program program;
    const Result result = program.run(run, "{}", files_up_to(blocks));
    if (result.code != 0) {
      EXPECT_EQ(result.code, 3) << result.output;
      EXPECT_THAT(result.output, HasSubstr("triptych: s.sqlite: "));
    }
    const Result resumed = program.run(run + "--resume");
    EXPECT_EQ(resumed.code, 0) << resumed.output;
    EXPECT_EQ(program.run("report --store s.sqlite --out r.html").code, 0);
  }
}

TEST(FullDisk, AReportThatDoesNotFitKeepsTheOldFile) {
  const Program program;
  ASSERT_EQ(program.run(any_size + "--set viewport=256 --set data=generate:gaussian_blob:16").code,
            0);
  program.write("r.html", "old");
  const Result result = program.run("report --store s.sqlite --out r.html", "{}", files_up_to(66));
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("r.html: cannot write"));
  EXPECT_EQ(program.read("r.html"), "old");
}

// The store already contains the reference image, so the page is the first file that does not fit.
TEST(FullDisk, AGateWhoseFilesDoNotFitDoesNotPass) {
  const Program program;
  const std::string gate = "gate volume/quick --store s.sqlite --baselines b";
  ASSERT_EQ(program.run(any_size + "--set viewport=256 --set data=generate:gaussian_blob:16").code,
            0);
  ASSERT_EQ(program.run("accept volume/quick --reason x --store s.sqlite --baselines b").code, 0);
  ASSERT_EQ(program.run(gate).code, 1);  // fails, because the image is black
  const Result result = program.run(gate + " --out out", "{}", files_up_to(66));
  EXPECT_EQ(result.code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("triptych: out/report.html: cannot write"));
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "out/report.html"));
}

TEST(FullDisk, AnAcceptThatDoesNotFitChangesNothing) {
  const Program program;
  if (test::run_command("unshare -rm true").code != 0) {
    GTEST_SKIP() << "mounting a small disk is not permitted on this machine";
  }
  const std::string accept = "accept volume/quick --reason x --store s.sqlite --baselines ";
  ASSERT_EQ(program.run(small + "--set data=generate:gaussian_blob:16").code, 0);
  ASSERT_EQ(program.run(accept + "kept").code, 0);
  std::filesystem::create_directory(program.folder() / "small");
  const auto before = tree(program.folder() / "kept/volume/quick");
  // The existing files use about 30 KiB of the disk, so not all of the new files fit.
  for (const char* size : {"36k", "48k"}) {
    const Result result =
        program.run(accept + "small/b", "{}",
                    std::string("unshare -rm sh -c 'mount -t tmpfs -o size=") + size +
                        " none small && cp -r kept small/b && \"$@\"; code=$?; rm -rf left; "
                        "cp -r small/b left; exit $code' sh");
    EXPECT_EQ(result.code, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("No space left on device"));
    EXPECT_TRUE(tree(program.folder() / "left/volume/quick") == before);
  }
}

}  // namespace
}  // namespace triptych::command_line
