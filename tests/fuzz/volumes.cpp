#include "fuzzed.hpp"
#include "scene/volume.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  static constexpr std::array<std::string_view, 3> kinds{"nrrd", "nhdr", "dat"};
  const auto input = fuzz::split(data, size, kinds);
  if (!input) return fuzz::rejected;
  // Detached data of a header: "v.raw".
  static const std::filesystem::path raw = fuzz::write("v.raw", std::string(64, 'v'));
  const std::filesystem::path file = fuzz::write("v." + input->kind, input->content);
  fuzz::expect_ours([&] { static_cast<void>(scene::load_volume(file.string())); });
  return fuzz::judged;
}
