#include "judge/baselines/baselines.hpp"

#include "fuzzed.hpp"

namespace triptych {
namespace {

// Reads the baselines as the gate does, but without verifying the checksums in the manifest,
// because that would reject every modified file at once.
void read_all(const judge::Baselines& baselines) {
  const std::string name = "x";
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.problem()); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.reference(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.counters(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.memory(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.errors(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.scores(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.cost_of_all_drivers()); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.statistics_of_all_drivers(name)); });
  fuzz::expect_typed_errors([&] { static_cast<void>(baselines.statistics_calibration("d")); });
}

}  // namespace
}  // namespace triptych

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  static constexpr std::array<std::string_view, 8> kinds{
      "manifest.json", "images.json", "counters.json", "memory.json",
      "accuracy.json", "score.json",  "cost/d.json",   "statistics/d.json"};
  const auto input = fuzz::split(data, size, kinds);
  if (!input) return fuzz::rejected;
  const std::filesystem::path file = fuzz::write("s/p/" + input->kind, input->content);
  read_all(judge::Baselines(fuzz::folder(), "s/p"));
  std::filesystem::remove(file);
  return fuzz::judged;
}
