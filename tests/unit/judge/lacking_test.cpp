// Tests that a driver version may lack a feature that another version for the same device has.

#include <filesystem>

#include "core/json.hpp"
#include "core/json_file.hpp"
#include "fixture.hpp"

namespace triptych::judge {
namespace {

class LackingTest : public JudgeTest {
 protected:
  static constexpr const char* lavapipe = "vulkan:lavapipe";

  LackingTest() {
    driver_versions_[lavapipe] = "25";
    accept_first();
  }

  // Adds a run with this driver version, which skips one configuration for this cause.
  void add_run_with_skip(const std::string& run, const std::string& version, record::Cause cause) {
    driver_versions_[lavapipe] = version;
    add_run(run, [&](record::Record& record, core::Image&) {
      if (record.device != lavapipe || record.configuration != bricks_) return;
      record.outcome = record::Outcome::skipped;
      record.reason.cause = cause;
    });
  }
  [[nodiscard]] Verdict verdict_of_skip(const std::string& run) const {
    return with(gate(run), Cause::ended).at(0).verdict;
  }
  [[nodiscard]] bool has_lacking_file() const {
    return std::filesystem::exists(baseline("lacking.json"));
  }
  [[nodiscard]] core::Json stored(const std::string& name) const {
    return core::JsonFile::read(baseline(name))->value();
  }
};

// Counters are stored per device. A driver version that was accepted without the feature need not
// report them, but a version that was accepted with the feature must.
TEST_F(LackingTest, IsNotedForTheDriverVersion) {
  add_run_with_skip("22", "22", record::Cause::not_supported);
  EXPECT_EQ(verdict_of_skip("22"), Verdict::cannot_judge);
  const core::Json counters = stored("counters.json");
  (void)accept_run("22");
  EXPECT_EQ(stored("counters.json"), counters);
  EXPECT_EQ(stored("lacking.json").size(), 1U);
  add_run_with_skip("22 again", "22", record::Cause::not_supported);
  EXPECT_EQ(verdict_of_skip("22 again"), Verdict::skipped);
  add_run_with_skip("25", "25", record::Cause::not_supported);
  EXPECT_EQ(verdict_of_skip("25"), Verdict::cannot_judge);
  // Version 22 is now accepted with the feature, so no version lacks it any more.
  driver_versions_[lavapipe] = "22";
  add_run("22 with");
  (void)accept_run("22 with");
  EXPECT_FALSE(has_lacking_file());
}

TEST_F(LackingTest, IsNotNotedForTheOnlyVersion) {
  add_run_with_skip("same version", "25", record::Cause::not_supported);
  (void)accept_run("same version");
  EXPECT_FALSE(has_lacking_file());
}

TEST_F(LackingTest, IsNotNotedForAnotherCause) {
  add_run_with_skip("memory", "22", record::Cause::out_of_memory);
  (void)accept_run("memory");
  EXPECT_FALSE(has_lacking_file());
}

}  // namespace
}  // namespace triptych::judge
