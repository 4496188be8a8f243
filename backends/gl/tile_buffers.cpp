#include "backends/gl/tile_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "backends/gl/cell_draws.hpp"
#include "backends/gl/volume_data.hpp"
#include "core/error.hpp"
#include "core/image.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings of technique/particles/tiles.glsl, tile_grid.glsl and the passes.
constexpr GLuint binding_cells = 6;
constexpr GLuint binding_camera_spheres = 7;
constexpr GLuint binding_kept = 8;
constexpr GLuint binding_tiles = 9;
constexpr GLuint binding_entries = 10;
constexpr GLuint binding_pixels = 11;
constexpr GLuint binding_cell_ends = 12;
constexpr GLuint binding_camera_texels = 13;
constexpr GLuint binding_tile_texels = 14;
constexpr GLuint binding_entry_texels = 15;
constexpr GLuint binding_pixel_texels = 16;
constexpr GLuint binding_sphere_texels = 17;
constexpr GLuint binding_colour_texels = 18;
constexpr GLuint binding_id_texels = 19;
constexpr GLuint image_unit = 0;  // TRI_LARGE_PIXELS

constexpr std::size_t word = sizeof(GLuint);
constexpr std::size_t header_words = 8;  // the fields from small_kept to groups in tiles.glsl
constexpr std::size_t groups_at = 4 * word;
constexpr std::size_t tile_words = 8;
constexpr std::size_t planes = 2;
constexpr GLuint block_edge = 4;  // in tiles; TRI_BLOCK

GLuint parts(int size, int part) {
  return static_cast<GLuint>((size + part - 1) / part);
}

Buffer filled(const Api& gl, std::size_t words, GLuint value) {
  const std::vector<GLuint> values(words, value);
  return constant_buffer(gl, std::as_bytes(std::span(values)));
}

Buffer cell_buffer(const Api& gl, std::span<const technique::Cell> cells) {
  return cells.empty() ? device_words(gl, 0) : constant_buffer(gl, std::as_bytes(cells));
}

void copy(const Api& gl, const Buffer& from, const Buffer& to, std::size_t at, std::size_t size) {
  gl.BindBuffer(GL_COPY_READ_BUFFER, from.get());
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, to.get());
  gl.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, static_cast<GLintptr>(at),
                       static_cast<GLsizeiptr>(size));
}

std::size_t colour_words(scene::ColourKind colour) {
  return colour == scene::ColourKind::rgba32 ? 4 : 1;
}

// Creates a texture in which each texel stores two pixels, one above the other. `any` is true if
// passes before the last one draw large spheres; otherwise, the texture has a single texel.
Texture pair_texture(const Api& gl, int width, int height, bool any) {
  const GLsizei columns = any ? width : 1;
  const GLsizei rows = any ? (height + 1) / 2 : 1;
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, columns, rows, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.check("glTexImage2D");
  texture.record_memory(gl.memory_ledger.image(4 * word * static_cast<std::uint64_t>(columns) *
                                               static_cast<std::uint64_t>(rows)));
  return texture;
}

}  // namespace

std::optional<std::string> TileBuffers::unsupported(const Api& gl,
                                                    const scene::ParticleScene& scene) {
  // Number of storage blocks of tiles_bin, including the counters.
  constexpr std::int64_t blocks = 9;
  const std::int64_t most_blocks = gl.limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  if (most_blocks < blocks) {
    return fmt::format("needs {} storage blocks, but GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS is {}",
                       blocks, most_blocks);
  }
  const std::int64_t pixels = std::int64_t{scene.width} * scene.height;
  const std::int64_t most = gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  if (static_cast<std::int64_t>(planes * word) * pixels > most) {
    return fmt::format(
        "{}x{} pixels need a storage block of {} bytes, but GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}",
        scene.width, scene.height, static_cast<std::int64_t>(planes * word) * pixels, most);
  }
  // An entry is a pair of a tile and a large sphere that overlaps it. A cell (a range of
  // neighbouring particles) needs the most entries if each of its spheres overlaps every tile.
  const std::int64_t tiles = std::int64_t{parts(scene.width, technique::tile_edge)} *
                             parts(scene.height, technique::tile_edge);
  const auto crowd = std::min<std::int64_t>(4 * technique::particles_per_cell,
                                            static_cast<std::int64_t>(scene.particles->count()));
  if (static_cast<std::int64_t>(word) * tiles * crowd > most) {
    return fmt::format(
        "{} spheres that all overlap {} tiles may need a storage block of {} bytes, but "
        "GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}",
        crowd, tiles, static_cast<std::int64_t>(word) * tiles * crowd, most);
  }
  return std::nullopt;
}

TileBuffers::TileBuffers(const Api& gl, const scene::ParticleScene& scene,
                         const technique::Arrangement& arrangement,
                         const technique::TileRounds& rounds, const ParticleData& data,
                         int extra_work_stride)
    : width_(scene.width),
      height_(scene.height),
      tiles_{parts(width_, technique::tile_edge), parts(height_, technique::tile_edge)},
      cells_(cell_buffer(gl, arrangement.cells)),
      small_(rounds.small),
      camera_spheres_(device_words(gl, 4 * arrangement.count())),
      tile_states_(device_buffer(gl, tile_bytes())),
      pixels_(device_buffer(gl, planes * pixel_bytes())),
      cell_ends_(device_words(gl, arrangement.cells.size())),
      large_pixels_(pair_texture(gl, width_, height_, rounds.resolved())),
      zeros_(filled(gl, std::max(pixel_bytes(), tile_bytes()) / word, 0)),
      no_particles_(filled(gl, pixel_bytes() / word, core::Image::no_particle)) {
  const std::size_t times = extra_work_stride == 0 ? 1 : 2;
  const std::size_t count = std::max<std::size_t>(arrangement.count(), 1);
  kept_ = device_words(gl, times * count);
  entries_ = device_words(gl, times * rounds.entries);
  if (extra_work_stride != 0) {
    thinned_ = cell_buffer(gl, thinned(arrangement.cells, extra_work_stride));
  }
  const std::size_t entry_bytes = word * std::max<std::size_t>(times * rounds.entries, 4);
  add_texel_view(gl, binding_camera_texels, camera_spheres_.get(), 4 * word * count, GL_RGBA32F);
  add_texel_view(gl, binding_tile_texels, tile_states_.get(), tile_bytes(), GL_RGBA32UI);
  add_texel_view(gl, binding_entry_texels, entries_.get(), entry_bytes, GL_R32UI);
  add_texel_view(gl, binding_pixel_texels, pixels_.get(), planes * pixel_bytes(), GL_R32UI);
  add_texel_view(gl, binding_sphere_texels, data.spheres().get(), 4 * word * count, GL_RGBA32F);
  add_texel_view(gl, binding_colour_texels, data.colours().get(),
                 colour_words(scene.particles->colour) * word * count, GL_R32UI);
  add_texel_view(gl, binding_id_texels, data.ids().get(), word * count, GL_R32UI);
  gl.check("glTexBuffer");
  clear_pixels(gl);
}

void TileBuffers::add_texel_view(const Api& gl, GLuint binding, GLuint buffer, std::size_t bytes,
                                 GLenum format) {
  const std::size_t texels = bytes / (format == GL_R32UI ? word : 4 * word);
  const auto most = static_cast<std::size_t>(gl.limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  if (texels > most) {
    throw core::NotSupported(fmt::format(
        "needs a buffer texture of {} texels, but GL_MAX_TEXTURE_BUFFER_SIZE is {}", texels, most));
  }
  Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_BUFFER, texture.get());
  gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer);
  texels_.push_back({binding, std::move(texture)});
}

std::size_t TileBuffers::pixel_bytes() const {
  return word * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

std::size_t TileBuffers::tile_bytes() const {
  return word * (header_words + tile_words * tiles_[0] * tiles_[1]);
}

GLuint TileBuffers::groups_for_tiles() const {
  return (tiles_[0] * tiles_[1] + 63) / 64;
}

GLuint TileBuffers::blocks() const {
  return (tiles_[0] + block_edge - 1) / block_edge * ((tiles_[1] + block_edge - 1) / block_edge);
}

void TileBuffers::dispatch_listed(const Api& gl) const {
  gl.MemoryBarrier(GL_COMMAND_BARRIER_BIT);
  gl.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, tile_states_.get());
  gl.DispatchComputeIndirect(static_cast<GLintptr>(groups_at));
}

void TileBuffers::bind(const Api& gl) const {
  const auto use = [&](GLuint binding, const Buffer& buffer) {
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.get());
  };
  use(binding_cells, cells_);
  use(binding_camera_spheres, camera_spheres_);
  use(binding_kept, kept_);
  use(binding_tiles, tile_states_);
  use(binding_entries, entries_);
  use(binding_pixels, pixels_);
  use(binding_cell_ends, cell_ends_);
  for (const Texels& each : texels_) {
    gl.ActiveTexture(GL_TEXTURE0 + each.binding);
    gl.BindTexture(GL_TEXTURE_BUFFER, each.texture.get());
  }
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindImageTexture(image_unit, large_pixels_.get(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32UI);
}

void TileBuffers::choose(const Api& gl, Cells cells) const {
  const Buffer& chosen = cells == Cells::all ? cells_ : thinned_;
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_cells, chosen.get());
}

void TileBuffers::clear_pixels(const Api& gl) const {
  copy(gl, zeros_, pixels_, 0, pixel_bytes());
  copy(gl, no_particles_, pixels_, pixel_bytes(), pixel_bytes());
}

void TileBuffers::poison(const Api& gl) const {
  for (const Buffer* each : {&camera_spheres_, &kept_, &entries_}) poison_buffer(gl, *each);
}

void TileBuffers::clear(const Api& gl) const {
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy(gl, zeros_, tile_states_, 0, tile_bytes());
  if (small_) clear_pixels(gl);
}

void TileBuffers::start_round(const Api& gl) const {
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy(gl, zeros_, tile_states_, word, 5 * word);  // keeps word 0, the number of small spheres
}

}  // namespace triptych::gl_backend
