#pragma once
// Trials on pooled runs, each put before the gate and counted.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "judge/evaluation/bench.hpp"
#include "judge/evaluation/counting.hpp"

namespace triptych::judge {

// An unplanted run, by its number in the pool, with these records in place of its own.
struct Attempt {
  std::size_t run = 0;
  std::vector<record::Record> changed;
};

class TrialJudge {
 public:
  // The pool must live as long; `folder` must be empty and stay.
  TrialJudge(const RunPool& pool, std::set<Check> checks, const std::filesystem::path& folder);

  [[nodiscard]] const std::vector<std::string>& devices() const { return devices_; }

  // Judges these devices – none: all – by the unplanted runs that are in neither attempt: by the
  // first and, where there is a second and enough runs are left, by both launches.
  void judge(const Trial& trial, const Attempt& first, const std::optional<Attempt>& second,
             const std::vector<std::string>& devices);
  // Whether an unplanted run as it is, judged twice, gives the same bytes; and what measuring it
  // took.
  void judge_twice(std::size_t run);

  [[nodiscard]] Tallies tallies() && { return std::move(tallies_); }

 private:
  // Two launches and what is stored of the other runs.
  struct Launches {
    Launch first;
    std::optional<Launch> second;
    const TrialHistory& stored;
  };

  [[nodiscard]] const TrialHistory& history(const std::set<std::size_t>& left_out);
  [[nodiscard]] TrialStore& store(std::size_t run, std::size_t launch);
  [[nodiscard]] GateRequest request(const std::set<Check>& checks,
                                    const std::vector<std::string>& devices) const;
  void judge_by_all(const Trial& trial, const Launches& launches,
                    const std::vector<std::string>& devices);
  void count_seconds(const PooledRun& run);

  const RunPool& pool_;
  std::set<Check> checks_;
  std::filesystem::path folder_;
  std::vector<std::string> devices_;
  std::map<std::set<std::size_t>, std::unique_ptr<TrialHistory>> histories_;  // by what is left out
  // By run and launch: both launches of a trial may be made of the same run.
  std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<TrialStore>> stores_;
  Tallies tallies_;
};

}  // namespace triptych::judge
