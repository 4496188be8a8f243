// read_data particles|volume FILE [COMPONENT [OUT]]: prints what Triptych reads from a particle or
// volume file as one line of JSON, for comparison with other programs. If OUT is given, also writes
// the particles (x, y, z, radius as float32) or the voxel values (float64) to that file. If
// Triptych rejects the file, prints a message and exits with code 3.

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/find_file.hpp"
#include "scene/particle_formats.hpp"
#include "scene/particles.hpp"
#include "scene/volume.hpp"
#include "scene/volume_formats.hpp"

namespace {

using namespace triptych;

template <typename T>
void write_array(const std::string& file, const std::vector<T>& values) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}

nlohmann::json facts_json(const scene::ReadFacts& facts) {
  nlohmann::json kinds = nlohmann::json::object();
  for (const auto& [name, count] : facts.kinds) kinds[name] = count;
  return {{"format", facts.format},
          {"unit", facts.unit},
          {"kinds", kinds},
          {"elements", facts.elements},
          {"value_type", facts.value_type},
          {"components", facts.components},
          {"orientation", facts.orientation},
          {"notes", facts.notes}};
}

nlohmann::json read_particles(const std::string& data, const std::string& out) {
  const scene::ParticleSet set = scene::load_particles(data, scene::ColourKind::rgba8);
  nlohmann::json json = facts_json(set.facts);
  json["count"] = set.count();
  json["dropped"] = set.dropped;
  json["hash"] = set.hash;
  if (!out.empty()) {
    write_array(out, set.spheres);
    write_array(out + ".rgba8", set.rgba8);
  }
  return json;
}

nlohmann::json read_volume(const std::string& data, const std::string& component,
                           const std::string& out) {
  const scene::Volume volume = scene::load_volume(data, {}, scene::parse_component(component));
  nlohmann::json json = facts_json(volume.facts);
  json["size"] = volume.size;
  json["spacing"] = volume.spacing;
  json["type"] = scene::name_of(volume.type);
  json["range"] = {volume.range_lo, volume.range_hi};
  if (!out.empty()) {
    std::vector<double> values(volume.voxel_count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = volume.value(i);
    write_array(out, values);
  }
  return json;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fputs("usage: read_data particles|volume FILE [COMPONENT [OUT]]\n", stderr);
    return 3;
  }
  const bool particles = std::string(arguments[1]) == "particles";
  const std::string data = arguments[2];
  const std::string component = count > 3 ? arguments[3] : "0";
  const std::string out = count > 4 ? arguments[4] : "";
  try {
    const nlohmann::json json =
        particles ? read_particles(data, out) : read_volume(data, component, out);
    std::puts(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return 0;
  } catch (const core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
