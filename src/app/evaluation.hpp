#pragma once
// Material for judging the judge: block differences of sides in turns, and runs, with and without
// planted work.

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/registry.hpp"
#include "judge/evaluation/compare.hpp"
#include "measure/plan.hpp"
#include "record/store.hpp"

namespace triptych::app {

struct EvaluationMaterial {
  std::vector<measure::Plan> plans;
  std::vector<std::string> devices;
  std::vector<double> sizes;  // planted, in percent
  // Of all that is measured; it ends with what is then under way. Each device and plan has an equal
  // part of it where sides are measured in turns.
  std::optional<std::chrono::seconds> budget;
  std::chrono::seconds limit{60};

  int configurations = 6;  // of each plan, in turns
  int launches = 12;       // of both workers
  int blocks = 384;  // of each configuration and size in a launch, at most: until a look tells
  std::uint64_t seed = 1;

  int rounds = 8;          // unplanted runs of each plan, each after its anchors
  int planted_rounds = 2;  // of them, how many are followed by one run of every size
};

// What is being done, for people.
using TellStep = std::function<void(const std::string&)>;

// So many configurations of a plan that every level of what it varies is among them, if they are
// enough for that.
[[nodiscard]] std::vector<measure::Configuration> covering(const measure::Plan& plan,
                                                           std::size_t count);

// A device against itself in turns, side b planted or not. Each launch of a configuration and size
// is appended to the file as a line of JSON: {"plan", "configuration", "factors", "device", "key",
// "percent", "launch", "clock", "frames_per_turn", "seconds", "differences"}. What a device cannot
// do is told and left out. Throws as measure::Turns does, but for SideEnded.
void measure_blocks(const EvaluationMaterial& material, const Registry& registry,
                    const std::filesystem::path& file, const TellStep& tell);

// Ordinary runs into the store, the anchors before each.
void measure_runs(const EvaluationMaterial& material, const Registry& registry,
                  record::Store& store, const TellStep& tell);

// The lines of such a file; none where it is not there. A last line that its writer, killed, did
// not end is told and left out. Throws InputError with file and line.
[[nodiscard]] std::vector<judge::BlockSeries> read_blocks(const std::filesystem::path& file,
                                                          const TellStep& tell);

}  // namespace triptych::app
