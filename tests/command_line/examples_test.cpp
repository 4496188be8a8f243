// The jobs in ci/examples. Their shell steps are run as their CI systems run them: in a folder with
// a replacement for apt-get and on a scripted device, and also in a minimal Debian system, if one
// can be made and a package is given.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "program.hpp"
#include "right_picture.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const fs::path examples = fs::path(TRIPTYCH_SOURCE_FOLDER) / "ci/examples";

struct Job {
  std::vector<std::string> steps;    // run until the first that fails
  std::vector<std::string> at_last;  // run whatever failed
  std::string kept;                  // the folder of the artifacts
  std::string junit;                 // a glob
};

Job github() {
  Job job;
  for (const YAML::Node& step : YAML::LoadFile(examples / "github.yml")["jobs"]["gate"]["steps"]) {
    const bool always = step["if"] && step["if"].as<std::string>() == "${{ !cancelled() }}";
    if (step["run"]) (always ? job.at_last : job.steps).push_back(step["run"].as<std::string>());
    if (!always || !step["with"]) continue;
    if (step["with"]["path"]) job.kept = step["with"]["path"].as<std::string>();
    if (step["with"]["report_paths"]) job.junit = step["with"]["report_paths"].as<std::string>();
  }
  return job;
}

Job gitlab() {
  const YAML::Node job = YAML::LoadFile(examples / "gitlab.yml")["triptych"];
  const YAML::Node kept = job["artifacts"];
  return {.steps = job["script"].as<std::vector<std::string>>(),
          .at_last = job["after_script"].as<std::vector<std::string>>(),
          .kept = kept["when"].as<std::string>() == "always"
                      ? kept["paths"].as<std::vector<std::string>>().at(0)
                      : "",
          .junit = kept["reports"]["junit"].as<std::string>()};
}

// A shell script with these steps. It then runs the last steps, shows the summary as GitHub does,
// and exits with the code of the first step that failed.
std::string script_of(const Job& job) {
  std::string script = "export GITHUB_STEP_SUMMARY=$PWD/summary\ntouch summary\ncode=0\n";
  for (const std::string& step : job.steps) {
    script += fmt::format("[ $code -ne 0 ] || (set -e\n{}\n) || code=$?\n", step);
  }
  for (const std::string& step : job.at_last) script += fmt::format("(set -e\n{}\n)\n", step);
  return script + "cat summary\nexit $code\n";
}

// Replaces the program: it uses a scripted device and one small scene, whatever devices the job
// requires.
constexpr const char* stand_in = R"(#!/bin/bash
arguments=()
for each in "$@"; do
  case $each in opencl:* | vulkan:* | gl:*) each='null:*' ;; esac
  arguments+=("$each")
done
exec {} "${{arguments[@]}}" volume/quick {}
)";

class Examples : public testing::TestWithParam<Job (*)()> {
 protected:
  void SetUp() override {
    const std::string right =
        fmt::format(R"({{"images": {{"*": "{}"}}}})", right_picture(program).string());
    for (const std::string& command :
         {fmt::format("run volume/quick {} --store a.sqlite", tiny),
          std::string("accept volume/quick --store a.sqlite --reason new --baselines baselines")}) {
      ASSERT_EQ(program.run(command, right).code, 0);
    }
    right_ = right;
    fs::create_directory(program.folder() / "bin");
    make("triptych", fmt::format(stand_in, TRIPTYCH_PROGRAM, tiny));
    make("apt-get", "#!/bin/sh\n");
  }

  [[nodiscard]] Result run(const Job& job, const std::string& device) const {
    program.write("job", script_of(job));
    return test::run_command(fmt::format(
        "cd '{}' && PATH=\"$PWD/bin:$PATH\" TRIPTYCH_DATA= TRIPTYCH_NULL_SCRIPT='{}' sh job",
        program.folder().string(), device));
  }
  [[nodiscard]] Result pass(const Job& job) const { return run(job, right_); }

  Program program;

 private:
  void make(const std::string& name, const std::string& text) const {
    program.write("bin/" + name, text);
    fs::permissions(program.folder() / "bin" / name, fs::perms::owner_all);
  }

  std::string right_;
};

TEST_P(Examples, ArePassedByAGoodDriverAndKeepEverything) {
  const Job job = GetParam()();
  const Result done = pass(job);
  EXPECT_EQ(done.code, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("## "));
  for (const char* file : {"report.html", "gate.sqlite", "summary.md", "volume-quick.xml"}) {
    EXPECT_TRUE(fs::exists(program.folder() / job.kept / file)) << file;
  }
  EXPECT_EQ(job.junit, "out/*.xml");
}

TEST_P(Examples, AreRedForAWrongPictureAndSayIt) {
  const Result done = run(GetParam()(), "{}");
  EXPECT_EQ(done.code, 1) << done.output;
  EXPECT_THAT(done.output.substr(done.output.find("## ")),
              AllOf(HasSubstr("pixels exceed the error bound"), HasSubstr("image")));
}

// Takes about ten minutes, so it runs only if a package for the release is given.
TEST_P(Examples, RunInABareSystem) {
  const char* const package = std::getenv("TRIPTYCH_PACKAGE");
  const char* const release = std::getenv("TRIPTYCH_RELEASE");
  if (package == nullptr || release == nullptr) {
    GTEST_SKIP() << "TRIPTYCH_PACKAGE and TRIPTYCH_RELEASE name no package and its release";
  }
  if (::geteuid() != 0) GTEST_SKIP() << "needs root, to make a bare system";
  Job job = GetParam()();
  if (job.steps.size() > 1) job.steps.erase(job.steps.begin());  // ci/fresh has installed it
  job.steps.back() += " --inject 'slowdown:5@*technique=raycast,*' volume/cost";
  program.write("job", script_of(job));
  const Result done = test::run_command(
      fmt::format("'{}/ci/fresh' --deb '{}' {} \"$(cat '{}/job')\"", TRIPTYCH_SOURCE_FOLDER,
                  package, release, program.folder().string()));
  EXPECT_EQ(done.code, 1) << done.output;
  EXPECT_THAT(done.output, HasSubstr("**regression** cost"));
}

INSTANTIATE_TEST_SUITE_P(Jobs, Examples, testing::Values(&github, &gitlab),
                         [](const auto& each) { return each.index == 0 ? "github" : "gitlab"; });

}  // namespace
}  // namespace triptych::command_line
