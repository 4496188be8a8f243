// Tests that missing, edited or unknown baseline files are distinguished from a device without
// baselines.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::AllOf;
using testing::HasSubstr;

class BaselinesTest : public JudgeTest {
 protected:
  BaselinesTest() {
    accept_first([](record::Record& record, core::Image&) {
      record.cost = {{"device_code", 700}, {"driver", 300}};
      record.counted_by = "an emulator";
      record.memory = {{"buffers", 4096}};
    });
  }
  // Returns the problem that the gate reports for all baselines of the plan.
  std::string problem() {
    const GateResult result = gate("accepted");
    EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
    const auto findings = with(result, Verdict::cannot_judge);
    EXPECT_EQ(findings.size(), 1U) << text(result);
    if (findings.empty()) return {};
    EXPECT_EQ(findings[0].cause, Cause::no_baselines);
    EXPECT_EQ(findings[0].advice.advice, Advice::restore_baselines);
    return findings[0].detail;
  }
  std::vector<std::string> file_names() const {
    std::vector<std::string> result;
    const Manifest manifest = Baselines(folder_.path() / "baselines", plan).manifest();
    for (const auto& [name, hash] : manifest.files) result.push_back(name);
    return result;
  }
};

TEST_F(BaselinesTest, UnchangedFilesPass) {
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::pass) << text(gate("accepted"));
  // The manifest lists at least 4 files of the plan itself, 2 images, 3 files each with the costs
  // and the times of a device, and 2 files with statistics.
  EXPECT_GE(file_names().size(), 4U + 2 + 3 + 3 + 2);
}

TEST_F(BaselinesTest, EveryMissingFileIsReported) {
  for (const std::string& name : file_names()) {
    const std::string kept = folder_.read(baseline(name));
    std::filesystem::remove(baseline(name));
    EXPECT_THAT(problem(), HasSubstr(name + " is missing"));
    core::write_file(kept, baseline(name));
  }
}

TEST_F(BaselinesTest, EveryEmptiedFileIsReported) {
  for (const std::string& name : file_names()) {
    const std::string kept = folder_.read(baseline(name));
    core::write_file(std::string_view("{}"), baseline(name));
    EXPECT_THAT(problem(), HasSubstr(name + " was changed after it was accepted"));
    core::write_file(kept, baseline(name));
  }
}

TEST_F(BaselinesTest, AFileThatWasNotAcceptedIsReported) {
  core::write_file(std::string_view("{}"), baseline("timings/other.json"));
  EXPECT_THAT(problem(), HasSubstr("timings/other.json does not belong to the baselines"));
}

TEST_F(BaselinesTest, WithoutAManifestNothingIsJudged) {
  std::filesystem::remove(baseline("manifest.json"));
  EXPECT_THAT(problem(), HasSubstr("manifest.json is missing"));
}

TEST_F(BaselinesTest, ABrokenManifestIsReportedWithItsLine) {
  core::write_file(std::string_view("{\n \"files\": {},\n \"files\": {}\n}\n"),
                   baseline("manifest.json"));
  EXPECT_THAT(problem(), HasSubstr("manifest.json:3:"));
  (void)accept_run("accepted", {.drop = true});
  EXPECT_EQ(gate("accepted").exit_code(), ExitCode::pass) << text(gate("accepted"));
}

// A careless merge of two branches can leave a wrong value, even with a corrected checksum.
TEST_F(BaselinesTest, AWrongValueIsAnErrorWithItsLine) {
  rewrite("counters.json", "{\n \"x\": {\n  \"samples\": {\"gl:a\": \"many\"}}}\n");
  try {
    (void)gate("accepted");
    FAIL() << "no exception was thrown";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.place().line, 3);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("counters.json"), HasSubstr("/x/samples/gl:a")));
  }
}

TEST_F(BaselinesTest, ImagesAreStillJudgedWithoutBaselines) {
  std::filesystem::remove(baseline("counters.json"));
  add_run("b", [](record::Record&, core::Image& image) { image.rgba[5] += 0.5F; });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

// Checks the baselines in Triptych's own repository, which a careless merge of two branches could
// damage.
TEST(CommittedBaselines, AreComplete) {
  const std::filesystem::path root = std::filesystem::path(TRIPTYCH_SOURCE_FOLDER) / "baselines";
  int plans = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().filename() != "manifest.json") continue;
    const std::string plan = entry.path().parent_path().lexically_relative(root).generic_string();
    EXPECT_EQ(Baselines(root, plan).problem(), "") << plan;
    ++plans;
  }
  EXPECT_GE(plans, 10);
}

// If a stored error were NaN or infinite, any error would pass.
TEST_F(BaselinesTest, NumbersThatAreNotFiniteAreRejected) {
  for (const char* number : {"NaN", "nan", "1e999", "-1", "null", "\"0.1\""}) {
    rewrite("accuracy.json", fmt::format(R"({{"{}": {{"gl:x": {{"rmse": {}, "arithmetic": 0}}}}}})",
                                         plain_, number));
    const Baselines stored(folder_.path() / "baselines", plan);
    EXPECT_THROW(static_cast<void>(stored.errors(plain_)), core::InputError) << number;
  }
  // A time of 0, or an infinite spread, would also excuse any slowdown.
  const record::Device device = store_.devices("accepted").at(0).device;
  const std::string file = "timings/" + device.key_hash() + ".json";
  const std::string timings = folder_.read(baseline(file));
  for (const std::string name : {"median_ns", "spread"}) {
    const std::regex stored_number('"' + name + R"(": *[^,}]+)");
    for (const char* number : {"NaN", "1e999", "-1", "0", "null"}) {
      rewrite(file,
              std::regex_replace(timings, stored_number, fmt::format(R"("{}": {})", name, number)));
      const Baselines stored(folder_.path() / "baselines", plan);
      EXPECT_THROW(static_cast<void>(stored.timings(device)), core::InputError) << name << number;
    }
  }
  rewrite(file, timings);
  EXPECT_NO_THROW(static_cast<void>(Baselines(folder_.path() / "baselines", plan).timings(device)));
}

}  // namespace
}  // namespace triptych::judge
