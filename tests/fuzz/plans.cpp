#include "fuzzed.hpp"
#include "measure/plan/plan_yaml.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  fuzz::expect_typed_errors(
      [&] { static_cast<void>(measure::parse_plan(fuzz::text_of(data, size), "plan")); });
  return fuzz::judged;
}
