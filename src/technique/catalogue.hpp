#pragma once
// The list of techniques. It is defined in catalogue.json, which CMake also reads.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::technique {

// The kind of device work that a frame of the technique consists of. Timers are calibrated
// separately for each kind.
enum class Work : std::uint8_t { compute, draw };
[[nodiscard]] std::string_view name_of(Work work);

// How a particle technique finds the pixels of a sphere: by a sprite that covers the sphere, by the
// tiles of the image that the sphere reaches, or by rays.
enum class Method : std::uint8_t { sprites, tiles, rays };
// The vertices that a technique draws for each sphere: none, one, or one for each corner of the
// sprite.
enum class Vertices : std::uint8_t { none, one, corners };

struct Technique {
  std::string id;     // also the stem of its file names in every backend's folder
  std::string suite;  // "volume" or "particles"
  Work work = Work::compute;
  Method method = Method::rays;
  Vertices vertices = Vertices::none;
  bool uses_corners = false;      // the factor `corners` sets the number of a sprite's corners
  bool fetches_by_index = false;  // its shaders read all spheres from one storage buffer
  bool instanced = false;         // draws one instance per sphere
  bool parts = false;             // can draw a volume in parts if it does not fit into memory
  bool draws_image = true;        // false for speed_of_light, which only adds up values
  std::vector<std::string> apis;  // the APIs on which the technique exists
  std::string summary;
};

[[nodiscard]] const std::vector<Technique>& catalogue();
[[nodiscard]] const Technique& technique(
    std::string_view id);  // throws InputError that lists the known names

}  // namespace triptych::technique
