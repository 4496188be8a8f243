#include "fuzzed.hpp"
#include "scene/volume.hpp"
#include "scene/volume_formats.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  static const std::vector<std::string> kinds = [] {
    auto all = fuzz::kinds_of(scene::volume_formats());
    all.emplace_back("spec");  // raw voxels without a header, whose size is in the second line
    return all;
  }();
  const auto input = fuzz::split(data, size, kinds);
  if (!input) return fuzz::rejected;
  // Data files to which a detached header may refer: "v.raw", or "v.img" in a NIfTI or Analyze
  // pair.
  static const std::filesystem::path raw = fuzz::write("v.raw", std::string(64, 'v'));
  static const std::filesystem::path image = fuzz::write("v.img", std::string(64, 'v'));
  if (input->kind == "spec") {
    const std::string spec(input->content.substr(0, input->content.find('\n')));
    fuzz::expect_typed_errors(
        [&] { static_cast<void>(scene::load_volume(raw.string() + ":" + spec)); });
    return fuzz::judged;
  }
  const std::filesystem::path file = fuzz::write("v." + input->kind, input->content);
  for (const scene::Component& component :
       {scene::Component{}, scene::Component{.index = 1}, scene::Component{.magnitude = true}}) {
    fuzz::expect_typed_errors(
        [&] { static_cast<void>(scene::load_volume(file.string(), {}, component)); });
  }
  return fuzz::judged;
}
