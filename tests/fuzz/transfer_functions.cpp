#include "fuzzed.hpp"
#include "scene/transfer_function.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  const std::filesystem::path file = fuzz::write("t.txt", fuzz::text_of(data, size));
  fuzz::expect_typed_errors(
      [&] { static_cast<void>(scene::load_transfer_function(file.string())); });
  return fuzz::judged;
}
