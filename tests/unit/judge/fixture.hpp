#pragma once
// Test data for the judge: three devices, each with two scenes that are drawn with and without
// brick skipping. The store and the folder of baselines are temporary.

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/random.hpp"
#include "judge/gate/gate.hpp"
#include "record/store.hpp"
#include "tests/support/temporary_folder.hpp"

namespace triptych::judge {

using test::TemporaryFolder;

class JudgeTest : public testing::Test {
 public:
  static constexpr const char* plan = "volume/quick";
  static constexpr float bound = 1e-3F;

  // A function that changes a record and its image before they are stored.
  using Tweak = std::function<void(record::Record&, core::Image&)>;

 protected:
  JudgeTest();

  // Adds twelve measured records. Times have 0.5 % noise around a mean for each configuration.
  void add_run(const std::string& run, const Tweak& tweak = {});
  // Accepts a run. `request` supplies all settings except the plan, the reason and the date. If it
  // has no function that returns reference images, truth_of() is used.
  std::vector<std::string> accept_run(const std::string& run, AcceptRequest request = {});
  // Adds and accepts a run with the id "accepted".
  void accept_first(const Tweak& tweak = {});
  [[nodiscard]] GateResult gate(const std::string& run) const { return gate(run, request_); }
  [[nodiscard]] GateResult gate(const std::string& run, const GateRequest& request) const;
  // Replaces the content of an accepted file and updates its checksum, as if the content had been
  // accepted.
  void rewrite(const std::string& name, const std::string& content);
  [[nodiscard]] std::filesystem::path baseline(const std::string& name) const;
  // Returns the only file in a folder of the plan's baselines whose name begins with `start`.
  [[nodiscard]] std::filesystem::path device_file(const std::string& folder,
                                                  const std::string& start) const;

  [[nodiscard]] static core::Image truth_of(const std::string& scene);
  // Returns the findings with one verdict (optionally only those from one check), or with one
  // cause.
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Verdict verdict);
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Verdict verdict,
                                                 Check check);
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Cause cause);
  // Returns all findings of a result as a string, for the messages of failed expectations.
  [[nodiscard]] static std::string text(const GateResult& result);

  static inline const std::string plain_ = "camera=front,data=ball,technique=raycast";
  static inline const std::string bricks_ = "camera=front,data=ball,skip=bricks,technique=raycast";
  static inline const std::string front_ = "camera=front,data=ball";

  TemporaryFolder folder_;
  record::Store store_;
  GateRequest request_;
  record::Checks checks_;  // the checks of the plan, for runs that are added later
  std::string plan_hash_;
  // Driver versions by device id, for runs that are added later.
  std::map<std::string, std::string> driver_versions_;
  std::map<std::string, std::string> settings_;  // settings of all devices
  std::map<std::string, std::map<std::string, record::StatisticWorth>> calibrations_;

 private:
  [[nodiscard]] record::Record make_record(const std::string& run, const record::Device& device,
                                           const std::string& scene, const std::string& variant);
  [[nodiscard]] std::vector<double> noisy(double level);
  core::Random random_{7};
};

// Returns the change of one value. The test fails if the value did not change.
[[nodiscard]] Change change_of(const Observation& observation, const std::string& name);
// Returns whether this cause is among the reasons for lost points.
[[nodiscard]] bool has_cause(const std::vector<Observation>& because, Cause cause);

}  // namespace triptych::judge
