#include "backends/gl/filter_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "backends/gl/program.hpp"
#include "backends/gl/volume_data.hpp"
#include "core/random.hpp"
#include "scene/half.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings of shaders/filter_probe.comp.
constexpr GLuint unit_volume = 1;
constexpr GLuint binding_probe = 4;
constexpr int probe_group_size = 64;

// The size is a power of two, so that dividing a position by it is exact and only the filter's
// error is measured. The volume is larger than the tiles into which renderers such as softpipe
// divide volumes, so that errors at the seams of these tiles are found.
constexpr int edge = 64;
constexpr int point_count = 512 * probe_group_size;
using Point = std::array<float, 4>;  // position in voxels, and the value sampled there

scene::VoxelGrid random_bits(scene::VoxelFormat format, core::Random& random) {
  const std::size_t bytes = scene::bytes_of(format);
  scene::VoxelGrid grid;
  grid.format = format;
  grid.size = {edge, edge, edge};
  grid.data.resize(std::size_t{edge} * edge * edge * bytes);
  for (std::size_t at = 0; at < grid.data.size(); at += bytes) {
    if (random.uniform() < 0.5) continue;
    constexpr float one = 1;
    static const scene::Half half_one = scene::to_half(1);
    if (format == scene::VoxelFormat::f32) {
      std::memcpy(&grid.data[at], &one, sizeof one);
    } else if (format == scene::VoxelFormat::f16) {
      std::memcpy(&grid.data[at], &half_one, sizeof half_one);
    } else {
      std::fill_n(grid.data.begin() + static_cast<std::ptrdiff_t>(at), bytes, std::byte{0xFF});
    }
  }
  return grid;
}

double bit(const scene::VoxelGrid& grid, int x, int y, int z) {
  const auto inside = [](int i) { return static_cast<std::size_t>(std::clamp(i, 0, edge - 1)); };
  const std::size_t index = inside(x) + edge * (inside(y) + edge * inside(z));
  const std::size_t last = (index + 1) * scene::bytes_of(grid.format) - 1;
  return grid.data[last] != std::byte{0} ? 1 : 0;  // the top byte of 1 is nonzero in every format
}

double interpolated(const scene::VoxelGrid& grid, const Point& point) {
  std::array<int, 3> base{};
  std::array<double, 3> share{};
  for (std::size_t axis = 0; axis < base.size(); ++axis) {
    const double q = static_cast<double>(point[axis]) - 0.5;
    base[axis] = static_cast<int>(std::floor(q));
    share[axis] = q - base[axis];
  }
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> step{corner & 1, (corner >> 1) & 1, corner >> 2};
    double weight = 1;
    for (std::size_t axis = 0; axis < step.size(); ++axis) {
      weight *= step[axis] == 1 ? share[axis] : 1 - share[axis];
    }
    value += weight * bit(grid, base[0] + step[0], base[1] + step[1], base[2] + step[2]);
  }
  return value;
}

// Samples the volume on the device at the position of each point, and stores the sampled values in
// the points.
void fetch(const Api& gl, const scene::VoxelGrid& grid, std::vector<Point>& points) {
  const Stage stage = plain_stage(gl, GL_COMPUTE_SHADER, "filter_probe.comp");
  const Program program = link(gl, std::span(&stage, 1));
  const Texture volume = volume_texture(gl, grid, true);
  const Buffer probe = constant_buffer(gl, std::as_bytes(std::span(points)));

  gl.UseProgram(program.get());
  gl.ActiveTexture(GL_TEXTURE0 + unit_volume);
  gl.BindTexture(GL_TEXTURE_3D, volume.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_probe, probe.get());
  gl.DispatchCompute(point_count / probe_group_size, 1, 1);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                      static_cast<GLsizeiptr>(std::span(points).size_bytes()), points.data());
  gl.check("glGetBufferSubData");
}

}  // namespace

double probe_filter(const Api& gl, scene::VoxelFormat format) {
  core::Random random(1);
  const scene::VoxelGrid grid = random_bits(format, random);
  std::vector<Point> points(point_count);
  for (Point& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = static_cast<float>(random.uniform(0, edge));
    }
  }
  fetch(gl, grid, points);
  double worst = 0;
  for (const Point& point : points) {
    const double error = std::abs(static_cast<double>(point[3]) - interpolated(grid, point));
    worst = std::isnan(error) ? 1 : std::max(worst, error);
  }
  return worst;
}

}  // namespace triptych::gl_backend
