#include "core/image_io.hpp"
#include "fuzzed.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  fuzz::expect_typed_errors(
      [&] { static_cast<void>(core::decode_exr(std::as_bytes(std::span(data, size)))); });
  return fuzz::judged;
}
