#pragma once
// A small world to judge: three devices with two scenes and two paths each. The store and the
// folder with the baselines are temporary.

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

  // Changes a record and its image before they are stored.
  using Tweak = std::function<void(record::Record&, core::Image&)>;

 protected:
  JudgeTest();

  // Adds twelve measured records. Times have 0.5 % noise around a mean for each configuration.
  void add_run(const std::string& run, const Tweak& tweak = {});
  // `how` contains all settings except the plan, the reason, the date and the reference image.
  std::vector<std::string> accept_run(const std::string& run, AcceptRequest how = {});
  // Accepts a run with the id "accepted".
  void accept_first(const Tweak& tweak = {});
  [[nodiscard]] GateResult gate(const std::string& run) const { return gate(run, request_); }
  [[nodiscard]] GateResult gate(const std::string& run, const GateRequest& request) const;
  // Changes an accepted file and its checksum, as if this content had been accepted.
  void rewrite(const std::string& name, const std::string& content);
  [[nodiscard]] std::filesystem::path baseline(const std::string& name) const;
  // Returns the only file in a folder of the plan's baselines whose name begins with `start`.
  [[nodiscard]] std::filesystem::path device_file(const std::string& folder,
                                                  const std::string& start) const;

  [[nodiscard]] static core::Image truth_of(const std::string& scene);
  // Return the findings with this verdict, optionally of one check only, or with this cause.
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Verdict verdict);
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Verdict verdict,
                                                 Check check);
  [[nodiscard]] static std::vector<Finding> with(const GateResult& result, Cause cause);
  // Returns all findings of a result as text, for messages of failed expectations.
  [[nodiscard]] static std::string text(const GateResult& result);

  static inline const std::string plain_ = "camera=front,data=ball,technique=raycast";
  static inline const std::string bricks_ = "camera=front,data=ball,skip=bricks,technique=raycast";
  static inline const std::string front_ = "camera=front,data=ball";

  TemporaryFolder folder_;
  record::Store store_;
  GateRequest request_;
  record::Checks checks_;  // checks of the plan, for runs that are added later
  std::string plan_hash_;
  // Driver versions of devices by id, for runs that are added later.
  std::map<std::string, std::string> driver_versions_;
  std::map<std::string, std::string> settings_;  // settings for all devices
  std::map<std::string, std::map<std::string, record::StatisticWorth>> calibrations_;

 private:
  [[nodiscard]] record::Record make_record(const std::string& run, const record::Device& device,
                                           const std::string& scene, const std::string& variant);
  [[nodiscard]] std::vector<double> noisy(double level);
  core::Random random_{7};
};

// Returns the change of one number. The test fails if the number did not change.
[[nodiscard]] Change change_of(const Observation& what, const std::string& name);
// Returns whether this cause is among those that lost points.
[[nodiscard]] bool has(const std::vector<Observation>& because, Cause cause);

}  // namespace triptych::judge
