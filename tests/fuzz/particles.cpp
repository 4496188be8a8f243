#include "scene/particles.hpp"

#include "fuzzed.hpp"
#include "scene/particle_formats.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  static const std::vector<std::string> kinds = fuzz::kinds_of(scene::particle_formats());
  const auto input = fuzz::split(data, size, kinds);
  if (!input) return fuzz::rejected;
  const std::string file = fuzz::write("p." + input->kind, input->content).string();
  for (const std::string& name : {file, file + "@1"}) {
    fuzz::expect_typed_errors(
        [&] { static_cast<void>(scene::load_particles(name, scene::ColourKind::intensity)); });
  }
  return fuzz::judged;
}
