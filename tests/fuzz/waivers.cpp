#include "fuzzed.hpp"
#include "judge/baselines/baselines.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  const auto file = fuzz::write("waivers.json", fuzz::text_of(data, size));
  fuzz::expect_typed_errors(
      [&] { static_cast<void>(judge::Baselines(fuzz::folder(), "s/p").waivers("2026-01-01")); });
  fuzz::expect_typed_errors([&] { static_cast<void>(judge::read_expected_outcomes(file)); });
  return fuzz::judged;
}
