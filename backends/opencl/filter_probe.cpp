#include "backends/opencl/filter_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/volume_data.hpp"
#include "core/random.hpp"
#include "scene/half.hpp"

namespace triptych::opencl_backend {
namespace {

constexpr int edge = 8;  // voxels
constexpr std::size_t place_count = 8192;
constexpr std::size_t voxel_count = std::size_t{edge} * edge * edge;
using Bits = std::array<bool, voxel_count>;
using Place = std::array<float, 4>;  // position in voxels, and the value sampled there

Bits random_bits() {
  core::Random random(1);
  Bits bits{};
  for (bool& bit : bits) bit = random.uniform() < 0.5;
  return bits;
}

std::vector<Place> random_places() {
  core::Random random(2);
  std::vector<Place> places(place_count);
  for (Place& each : places) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      each.at(axis) = static_cast<float>(random.uniform(0, edge));
    }
  }
  return places;
}

// Creates a volume whose voxels are either 0 or the largest value of the format. Sampled values are
// divided by that value.
template <typename T>
scene::VoxelGrid make_pattern(const Bits& bits, scene::VoxelFormat format, T largest) {
  scene::VoxelGrid grid{.format = format, .size = {edge, edge, edge}};
  grid.data.resize(voxel_count * sizeof largest);
  for (std::size_t i = 0; i < voxel_count; ++i) {
    if (bits[i]) std::memcpy(&grid.data[i * sizeof largest], &largest, sizeof largest);
  }
  return grid;
}

scene::VoxelGrid pattern_of(const Bits& bits, scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return make_pattern(bits, format, std::uint8_t{255});
    case scene::VoxelFormat::u16:
      return make_pattern(bits, format, std::uint16_t{65535});
    case scene::VoxelFormat::f32:
      return make_pattern(bits, format, 1.0F);
    case scene::VoxelFormat::f16:
      return make_pattern(bits, format, scene::to_half(1));
  }
  return {};
}

double trilinear(const Bits& bits, const Place& place) {
  double value = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t index = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const double q = static_cast<double>(place.at(axis)) - 0.5;
      const double below = std::floor(q);
      const bool upper = (corner >> axis & 1U) != 0;
      weight *= upper ? q - below : 1 - (q - below);
      const int voxel = std::clamp(static_cast<int>(below) + (upper ? 1 : 0), 0, edge - 1);
      index = index * edge + static_cast<std::size_t>(voxel);
    }
    if (bits.at(index)) value += weight;
  }
  return value;
}

// Writes the sampled value into each place.
void sample_on_device(const Session& session, Programs& programs, const scene::VoxelGrid& pattern,
                      std::vector<Place>& places) {
  constexpr auto sampler = technique::Sampler::hardware;
  const Constants constants{.sampler = sampler, .voxel = pattern.format};
  const cl::Program program = programs.get(
      program_source({"parameters.cl", "volume.cl", "filter_probe.cl"}), constants.options());
  technique::RaycastParameters parameters{};
  parameters.volume_size = {edge, edge, edge, 0};
  parameters.value_map = {1, 0, 0, 0};
  const cl::Memory volume = upload(session, pattern, sampler);
  checked([&] {
    const std::size_t bytes = places.size() * sizeof(Place);
    const cl::Buffer uniform(session.context, CL_MEM_READ_ONLY, sizeof parameters);
    const cl::Buffer buffer(session.context, CL_MEM_READ_WRITE, bytes);
    write_buffer(session, uniform, 0, sizeof parameters, &parameters);
    write_buffer(session, buffer, 0, bytes, places.data());
    run_checked(session, {make_launch(program, "filter_probe", cl::NDRange(places.size()),
                                      cl::NullRange, uniform, volume, buffer)});
    read_buffer(session, buffer, bytes, places.data());
  });
}

}  // namespace

double probe_filter(const Session& session, Programs& programs, scene::VoxelFormat format) {
  const Bits bits = random_bits();
  std::vector<Place> places = random_places();
  sample_on_device(session, programs, pattern_of(bits, format), places);
  double worst = 0;
  for (const Place& each : places) {
    worst = std::max(worst, std::abs(static_cast<double>(each[3]) - trilinear(bits, each)));
  }
  return worst;
}

}  // namespace triptych::opencl_backend
