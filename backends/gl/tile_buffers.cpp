#include "backends/gl/tile_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "backends/gl/cell_draws.hpp"
#include "backends/gl/particle_target.hpp"
#include "backends/gl/volume_data.hpp"
#include "technique/particles/tile_rounds.hpp"

namespace triptych::gl_backend {
namespace {

// Bindings of technique/particles/tiles.glsl and its passes.
constexpr GLuint binding_cells = 6;
constexpr GLuint binding_kept_spheres = 7;
constexpr GLuint binding_kept = 8;
constexpr GLuint binding_tiles = 9;
constexpr GLuint binding_entries = 10;
constexpr GLuint binding_pixels = 11;
constexpr GLuint binding_cell_ends = 12;
constexpr GLuint binding_picture = 13;

constexpr std::size_t word = sizeof(GLuint);
constexpr std::size_t header_words = 4;  // small_kept, large_kept, placed_entries, no_state
constexpr std::size_t tile_words = 4;
constexpr std::size_t planes = 4;

GLuint parts(int size, int part) {
  return static_cast<GLuint>((size + part - 1) / part);
}

Buffer filled(const Api& gl, std::size_t words, GLuint value) {
  const std::vector<GLuint> values(words, value);
  return constant_buffer(gl, std::as_bytes(std::span(values)));
}

Buffer words(const Api& gl, std::size_t count) {
  return device_buffer(gl, word * std::max<std::size_t>(count, 4));
}

Buffer cell_buffer(const Api& gl, std::span<const technique::Cell> cells) {
  return cells.empty() ? words(gl, 0) : constant_buffer(gl, std::as_bytes(cells));
}

void copy(const Api& gl, const Buffer& from, const Buffer& to, std::size_t at, std::size_t size) {
  gl.BindBuffer(GL_COPY_READ_BUFFER, from.get());
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, to.get());
  gl.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, static_cast<GLintptr>(at),
                       static_cast<GLsizeiptr>(size));
}

template <class T>
void read_back(const Api& gl, const Buffer& from, std::size_t at, std::vector<T>& to) {
  gl.BindBuffer(GL_COPY_READ_BUFFER, from.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(at),
                      static_cast<GLsizeiptr>(to.size() * sizeof(T)), to.data());
}

}  // namespace

std::optional<std::string> TileBuffers::unsupported(const Api& gl,
                                                    const scene::ParticleScene& scene) {
  constexpr std::int64_t blocks = 9;  // of tiles_bin, with counters
  const std::int64_t most_blocks = gl.limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  if (most_blocks < blocks) {
    return fmt::format("{} storage blocks, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS is {}", blocks,
                       most_blocks);
  }
  const std::int64_t pixels = std::int64_t{scene.width} * scene.height;
  const std::int64_t most = gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  if (static_cast<std::int64_t>(planes * word) * pixels > most) {
    return fmt::format(
        "{}x{} pixels need a storage block of {} bytes, GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}",
        scene.width, scene.height, static_cast<std::int64_t>(planes * word) * pixels, most);
  }
  // The largest single cell, with every sphere in every tile.
  const std::int64_t tiles = std::int64_t{parts(scene.width, technique::tile_edge)} *
                             parts(scene.height, technique::tile_edge);
  const auto crowd = std::min<std::int64_t>(4 * technique::particles_per_cell,
                                            static_cast<std::int64_t>(scene.particles->count()));
  if (static_cast<std::int64_t>(word) * tiles * crowd > most) {
    return fmt::format(
        "{} spheres before {} tiles may need a storage block of {} bytes, "
        "GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}",
        crowd, tiles, static_cast<std::int64_t>(word) * tiles * crowd, most);
  }
  return std::nullopt;
}

TileBuffers::TileBuffers(const Api& gl, const scene::ParticleScene& scene,
                         const technique::Arrangement& arrangement, std::uint64_t entries,
                         int extra_work_stride)
    : width_(scene.width),
      height_(scene.height),
      tiles_{parts(width_, technique::tile_edge), parts(height_, technique::tile_edge)},
      cells_(cell_buffer(gl, arrangement.cells)),
      tile_states_(device_buffer(gl, tile_bytes())),
      pixels_(device_buffer(gl, planes * pixel_bytes())),
      cell_ends_(words(gl, arrangement.cells.size())),
      picture_(device_buffer(gl, 4 * pixel_bytes())),
      zeros_(filled(gl, std::max(pixel_bytes(), tile_bytes()) / word, 0)),
      no_particles_(filled(gl, pixel_bytes() / word, core::Image::no_particle)) {
  const std::size_t times = extra_work_stride == 0 ? 1 : 2;
  const std::size_t most_kept = std::max<std::size_t>(times * arrangement.count(), 4);
  kept_spheres_ = words(gl, 4 * most_kept);
  kept_ = words(gl, most_kept);
  entries_ = words(gl, times * entries);
  if (extra_work_stride != 0) {
    thinned_ = cell_buffer(gl, thinned(arrangement.cells, extra_work_stride));
  }
}

std::size_t TileBuffers::pixel_bytes() const {
  return word * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

std::size_t TileBuffers::tile_bytes() const {
  return word * (header_words + tile_words * tiles_[0] * tiles_[1]);
}

std::array<GLuint, 2> TileBuffers::groups_for_tiles() const {
  return {(tiles_[0] * tiles_[1] + 63) / 64, 1};
}

std::array<GLuint, 2> TileBuffers::groups_of_pixels() const {
  return {parts(width_, 8), parts(height_, 8)};
}

void TileBuffers::bind(const Api& gl) const {
  const auto use = [&](GLuint binding, const Buffer& buffer) {
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.get());
  };
  use(binding_cells, cells_);
  use(binding_kept_spheres, kept_spheres_);
  use(binding_kept, kept_);
  use(binding_tiles, tile_states_);
  use(binding_entries, entries_);
  use(binding_pixels, pixels_);
  use(binding_cell_ends, cell_ends_);
  use(binding_picture, picture_);
}

void TileBuffers::choose(const Api& gl, Cells cells) const {
  const Buffer& chosen = cells == Cells::all ? cells_ : thinned_;
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_cells, chosen.get());
}

void TileBuffers::clear(const Api& gl) const {
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy(gl, zeros_, tile_states_, 0, tile_bytes());
  for (std::size_t plane = 0; plane < planes; ++plane) {
    copy(gl, plane % 2 == 0 ? zeros_ : no_particles_, pixels_, plane * pixel_bytes(),
         pixel_bytes());
  }
}

void TileBuffers::start_round(const Api& gl) const {
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy(gl, zeros_, tile_states_, word, 2 * word);  // large_kept, placed_entries
}

core::Image TileBuffers::read(const Api& gl, double near) const {
  core::Image image(width_, height_);
  image.depth.resize(image.pixel_count());
  image.ids.resize(image.pixel_count());
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  read_back(gl, picture_, 0, image.rgba);
  read_back(gl, pixels_, 0, image.depth);
  read_back(gl, pixels_, pixel_bytes(), image.ids);
  gl.check("glGetBufferSubData");
  to_distances(image, near);
  return image;
}

}  // namespace triptych::gl_backend
