// Tests the jobs in ci/examples. Their shell steps are run in the same way as their CI systems run
// them: in a folder with a replacement for apt-get, and on a scripted device. If a package is given
// and a minimal Debian system can be created, the steps are also run in that system.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <vector>

#include "correct_image.hpp"
#include "program.hpp"

namespace triptych::command_line {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const fs::path examples = fs::path(TRIPTYCH_SOURCE_FOLDER) / "ci/examples";

struct Job {
  std::vector<std::string> steps;    // run in order until one of them fails
  std::vector<std::string> at_last;  // run even if a step failed
  std::string kept;                  // the folder in which the CI system keeps artifacts
  std::vector<std::string> reports;  // files and globs that the CI system reads
};

Job github() {
  Job job;
  for (const YAML::Node& step : YAML::LoadFile(examples / "github.yml")["jobs"]["gate"]["steps"]) {
    const bool always = step["if"] && step["if"].as<std::string>().starts_with("${{ !cancelled()");
    if (step["run"]) (always ? job.at_last : job.steps).push_back(step["run"].as<std::string>());
    if (!always || !step["with"] || !job.kept.empty()) continue;
    job.kept = step["with"]["path"].as<std::string>();
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
          .reports = {kept["reports"]["junit"].as<std::string>(),
                      kept["reports"]["codequality"].as<std::string>()}};
}

// Returns a shell script that runs these steps: each of GitHub's steps in a separate shell, but all
// of GitLab's steps in the same shell. Then the script runs the final steps, prints the summary as
// GitHub does, and exits with the code of the first step that failed.
std::string script_of(const Job& job) {
  std::vector<std::string> shells = job.steps;
  if (!job.reports.empty()) shells = {fmt::format("{}", fmt::join(job.steps, "\n"))};
  std::string script =
      "export GITHUB_STEP_SUMMARY=$PWD/summary GITHUB_ENV=$PWD/environment\n"
      "touch summary environment\ncode=0\n";
  for (const std::string& shell : shells) {
    script += fmt::format(
        "cat > step <<'END_OF_STEP'\n{}\nEND_OF_STEP\n[ $code -ne 0 ] || "
        "(set -a; . ./environment; exec sh -e step) || code=$?\n",
        shell);
  }
  for (const std::string& step : job.at_last) script += fmt::format("(set -e\n{}\n)\n", step);
  return script + "cat summary\nexit $code\n";
}

// Replaces the program triptych. Whatever devices the job requires, the replacement uses a scripted
// device and one small scene, and `accept` drops the stored values of all other configurations.
constexpr const char* stand_in = R"(#!/bin/bash
[ "$1" = gate ] || exec {0} "$@" --drop
arguments=()
for each in "$@"; do
  case $each in opencl:* | vulkan:* | gl:*) each='null:*' ;; esac
  arguments+=("$each")
done
exec {0} "${{arguments[@]}}" volume/quick {1}
)";

// Replaces `git clone URL FOLDER`. The replacement creates a checkout whose ci/package creates a
// package.
constexpr const char* stand_in_git = R"(#!/bin/sh
[ "$1" = clone ] || exit 0
mkdir -p "$3/ci"
printf '#!/bin/sh\nmkdir -p "$1"\ntouch "$1/triptych.deb"\necho built >> builds\n' > "$3/ci/package"
chmod +x "$3/ci/package"
)";

// A repository that contains only the job, on a machine with a scripted driver.
class Examples : public testing::TestWithParam<Job (*)()> {
 protected:
  void SetUp() override {
    const std::string images =
        fmt::format(R"("images": {{"*": "{}"}})", correct_image(program).string());
    right_ = fmt::format("{{{}}}", images);
    right_with_more_work_ = fmt::format(R"({{{}, "extra_samples": 5}})", images);
    fs::create_directory(program.folder() / "bin");
    fs::create_directories(program.folder() / "mesa/share/vulkan/icd.d");
    program.write("mesa/share/vulkan/icd.d/lvp_icd.json", "{}");
    make("triptych", fmt::format(stand_in, TRIPTYCH_PROGRAM, tiny));
    make("apt-get", "#!/bin/sh\n");
    make("git", stand_in_git);
  }

  [[nodiscard]] Result run(const std::string& device, const std::string& accept = {}) const {
    const bool on_github = GetParam() == &github;
    program.write("job", script_of(GetParam()()));
    return test::run_command(
        fmt::format("cd '{}' && env PATH=\"$PWD/bin:$PATH\" TRIPTYCH_DATA= "
                    "TRIPTYCH_NULL_SCRIPT='{}' ACCEPT='{}' "
                    "TRIPTYCH_GIT=address TRIPTYCH_COMMIT=main {} sh job",
                    program.folder().string(), device, accept,
                    on_github ? "GITHUB_ACTIONS=true" : "GITLAB_CI=true"));
  }
  [[nodiscard]] Result pass() const { return run(right_); }
  [[nodiscard]] Result accept() const { return run(right_, "they are right"); }
  // The driver draws the correct image, but takes more samples for it.
  [[nodiscard]] Result more_work(const std::string& accept = {}) const {
    return run(right_with_more_work_, accept);
  }

  // Returns the line with this 1-based number from a file in the program's folder.
  [[nodiscard]] std::string line(const std::string& file, int number) const {
    std::istringstream text(program.read(file));
    std::string found;
    for (int i = 0; i < number; ++i) std::getline(text, found);
    return found;
  }

  Program program;

 private:
  void make(const std::string& name, const std::string& text) const {
    program.write("bin/" + name, text);
    fs::permissions(program.folder() / "bin" / name, fs::perms::owner_all);
  }

  std::string right_;
  std::string right_with_more_work_;
};

TEST_P(Examples, PassFailAndPassAgainInANewRepository) {
  // The baselines that come with Triptych do not contain the scripted device.
  EXPECT_EQ(pass().code, 2);
  EXPECT_EQ(accept().code, 2);
  ASSERT_TRUE(fs::exists(program.folder() / "baselines/volume/quick/manifest.json"));
  const Result green = pass();
  EXPECT_EQ(green.code, 0) << green.output;
  EXPECT_THAT(green.output, HasSubstr("## PASS"));
  const Result red = run("{}");
  EXPECT_EQ(red.code, 1) << red.output;
  EXPECT_THAT(red.output.substr(red.output.find("## ")),
              AllOf(HasSubstr("pixels exceed the error bound"), HasSubstr("image")));
  const Result repaired = pass();
  EXPECT_EQ(repaired.code, 0) << repaired.output;
  EXPECT_EQ(program.read("builds"), "built\n")
      << "the package must be built once and then be reused";
}

// Tests an intended change: the job fails and names the line of the stored value, the change is
// accepted, and from then on the job passes.
TEST_P(Examples, AcceptAnIntendedChange) {
  ASSERT_EQ(accept().code, 2);
  ASSERT_EQ(pass().code, 0);
  const Result red = more_work();
  ASSERT_EQ(red.code, 1) << red.output;
  const std::string file = "baselines/volume/quick/counters.json";
  std::smatch place;
  if (GetParam() == &github) {
    ASSERT_TRUE(std::regex_search(red.output, place,
                                  std::regex("\n::error file=" + file + ",line=([0-9]+)")));
  } else {
    const std::string quality = program.read("out/codequality.json");
    const std::regex at("\"begin\": ([0-9]+)[^\"]*\"path\": \"" + file + "\"");
    ASSERT_TRUE(std::regex_search(quality, place, at)) << quality;
  }
  EXPECT_THAT(line(file, std::stoi(place[1])), HasSubstr("data=generate:gaussian_blob:16"));
  EXPECT_EQ(more_work("the new sampler needs them").code, 1) << "the job that accepts judges first";
  const Result green = more_work();
  EXPECT_EQ(green.code, 0) << green.output;
  EXPECT_EQ(pass().code, 1) << "fewer samples than accepted are now the change";
}

TEST_P(Examples, KeepAllArtifactsAndAnnotate) {
  ASSERT_EQ(accept().code, 2);
  const Result red = run("{}");
  const Job job = GetParam()();
  for (const char* file : {"report.html", "gate.sqlite", "summary.md", "volume-quick.xml"}) {
    EXPECT_TRUE(fs::exists(program.folder() / job.kept / file)) << file;
  }
  if (GetParam() == &github) {
    EXPECT_THAT(red.output, HasSubstr("\n::error file=baselines/volume/quick/counters.json,line="));
    return;
  }
  EXPECT_EQ(job.reports, (std::vector<std::string>{"out/*.xml", "out/codequality.json"}));
  EXPECT_THAT(program.read("out/codequality.json"), HasSubstr("\"severity\": \"major\""));
}

// All later steps must use the user's own driver.
TEST_P(Examples, UseADriverFromTheRepository) {
  program.write("bin/triptych",
                "#!/bin/sh\necho \"driver: $VK_DRIVER_FILES in $LD_LIBRARY_PATH\"\nmkdir -p out\n"
                "touch out/summary.md\n");
  const std::string mesa = (program.folder() / "mesa").string();
  EXPECT_THAT(pass().output, HasSubstr("driver: " + mesa + "/share/vulkan/icd.d/lvp_icd.json in " +
                                       mesa + "/lib/x86_64-linux-gnu\n"));
}

// If the driver under test is missing, a pass of the distribution's driver would mislead.
TEST_P(Examples, FailWithoutTheDriverUnderTest) {
  fs::remove_all(program.folder() / "mesa");
  EXPECT_EQ(pass().code, 3);
  EXPECT_FALSE(fs::exists(program.folder() / "out/gate.sqlite"));
}

// If the repository has lost its baselines, a comparison with others would mislead.
TEST_P(Examples, DoNotUseTheBaselinesThatComeWithTriptych) {
  program.write("bin/triptych",
                "#!/bin/sh\necho \"arguments: $*\"\nmkdir -p out\ntouch out/summary.md\n");
  EXPECT_THAT(pass().output, testing::ContainsRegex("arguments: gate .*--baselines baselines "));
}

// This takes about ten minutes, so it runs only if a package for the release is given.
TEST_P(Examples, RunInAMinimalSystem) {
  const char* const package = std::getenv("TRIPTYCH_PACKAGE");
  const char* const release = std::getenv("TRIPTYCH_RELEASE");
  if (package == nullptr || release == nullptr) {
    GTEST_SKIP() << "TRIPTYCH_PACKAGE and TRIPTYCH_RELEASE are not set";
  }
  if (::geteuid() != 0) GTEST_SKIP() << "needs root to create a minimal system";
  Job job = GetParam()();
  // ci/fresh installs the package, so the steps that would install it are removed.
  std::erase_if(job.steps, [](const std::string& step) {
    return step.find("triptych gate") == std::string::npos;
  });
  const std::string gate = "triptych gate --measure";
  std::string& step = job.steps.back();
  step.replace(step.find(gate), gate.size(),
               gate + " --inject 'slowdown:5@*technique=raycast,*' volume/cost");
  // The system has only the baselines that come with the package.
  const std::string own = " --without cost --baselines baselines";
  step.replace(step.find(own), own.size(), "");
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
