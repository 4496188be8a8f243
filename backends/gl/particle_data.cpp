#include "backends/gl/particle_data.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "backends/gl/volume_data.hpp"
#include "technique/particles/particle_counts.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::gl_backend {
namespace {

// The bindings of technique/particles/parameters.glsl and storage.glsl.
constexpr GLuint binding_parameters = 0;
constexpr GLuint binding_transfer = 1;
constexpr GLuint binding_counters = 2;
constexpr GLuint binding_spheres = 3;
constexpr GLuint binding_colours = 4;
constexpr GLuint binding_ids = 5;

// Writes the part of a buffer that begins at byte `begin`.
using Fill = std::function<void(std::size_t begin, std::span<std::byte> out)>;

// Fills a buffer piece by piece through a small staging array, in multiples of 16 bytes, so that
// the host never holds a copy of the whole buffer. The buffer is never empty, because a storage
// block must be backed by a buffer even if the shader does not read it.
Buffer filled_buffer(const Api& gl, std::size_t size, const Fill& fill) {
  constexpr std::size_t most_at_once = std::size_t{4} << 20U;
  Buffer buffer(gl);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
  const std::size_t whole = std::max<std::size_t>(size, 16);
  gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(whole), nullptr, GL_STATIC_DRAW);
  buffer.record_memory(gl.memory_ledger.buffer(whole));
  std::vector<std::byte> memory(std::min(size, most_at_once));
  for (std::size_t begin = 0; begin < size; begin += memory.size()) {
    const std::span piece = std::span(memory).first(std::min(memory.size(), size - begin));
    fill(begin, piece);
    gl.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(begin),
                     static_cast<GLsizeiptr>(piece.size()), piece.data());
  }
  gl.check("glBufferSubData");
  return buffer;
}

Buffer property_buffer(const Api& gl, const technique::Arrangement& arrangement,
                       technique::Property property) {
  return filled_buffer(
      gl, arrangement.bytes(property),
      [&](std::size_t begin, std::span<std::byte> out) { arrangement.copy(property, begin, out); });
}

// Creates a buffer with the numbers 0, 1, 2…
Buffer number_buffer(const Api& gl, std::size_t count) {
  return filled_buffer(gl, count * sizeof(GLuint), [](std::size_t begin, std::span<std::byte> out) {
    std::vector<GLuint> numbers(out.size() / sizeof(GLuint));
    std::iota(numbers.begin(), numbers.end(), static_cast<GLuint>(begin / sizeof(GLuint)));
    std::ranges::copy(std::as_bytes(std::span(numbers)), out.begin());
  });
}

Buffer parameter_buffer(const Api& gl, const measure::ParticleWork& work,
                        const technique::Arrangement& arrangement) {
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  return constant_buffer(gl, std::as_bytes(std::span(&parameters, 1)));
}

}  // namespace

ParticleData::ParticleData(const Api& gl, const measure::ParticleWork& work,
                           const technique::Arrangement& arrangement)
    : parameters_(parameter_buffer(gl, work, arrangement)),
      transfer_(
          constant_buffer(gl, std::as_bytes(std::span(work.scene.intensity_colours.entries)))),
      spheres_(property_buffer(gl, arrangement, technique::Property::sphere)),
      colours_(property_buffer(gl, arrangement, technique::Property::colour)),
      ids_(property_buffer(gl, arrangement, technique::Property::id)),
      vertices_(gl) {
  if (gl.ARB_shader_draw_parameters == 0) numbers_ = number_buffer(gl, arrangement.count());
  describe_vertices(gl, work.scene.particles->colour);
}

void ParticleData::upload_camera(const Api& gl, const measure::ParticleWork& work,
                                 const technique::Arrangement& arrangement) const {
  const technique::ParticleParameters parameters =
      technique::particle_parameters(work.scene, work.options, arrangement);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, parameters_.get());
  gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0, sizeof parameters, &parameters);
  gl.check("glBufferSubData");
}

void ParticleData::describe_vertices(const Api& gl, scene::ColourKind colour) {
  gl.BindVertexArray(vertices_.get());
  gl.BindBuffer(GL_ARRAY_BUFFER, spheres_.get());
  gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.BindBuffer(GL_ARRAY_BUFFER, colours_.get());
  if (colour == scene::ColourKind::rgba8) {
    gl.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
  } else {
    gl.VertexAttribPointer(1, colour == scene::ColourKind::rgba32 ? 4 : 1, GL_FLOAT, GL_FALSE, 0,
                           nullptr);
  }
  gl.BindBuffer(GL_ARRAY_BUFFER, ids_.get());
  gl.VertexAttribIPointer(2, 1, GL_UNSIGNED_INT, 0, nullptr);
  for (GLuint attribute = 0; attribute < 3; ++attribute) gl.EnableVertexAttribArray(attribute);
  if (numbers_.get() != 0) {
    gl.BindBuffer(GL_ARRAY_BUFFER, numbers_.get());
    gl.VertexAttribIPointer(3, 1, GL_UNSIGNED_INT, 0, nullptr);
    gl.VertexAttribDivisor(3, 1);
    gl.EnableVertexAttribArray(3);
  }
  gl.check("glVertexAttribPointer");
}

void ParticleData::bind(const Api& gl) const {
  gl.BindVertexArray(vertices_.get());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, binding_parameters, parameters_.get());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, binding_transfer, transfer_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_spheres, spheres_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_colours, colours_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_ids, ids_.get());
}

ParticleCounters::ParticleCounters(const Api& gl)
    : rows_(device_buffer(gl, technique::particle_counter_bytes)) {}

void ParticleCounters::start(const Api& gl) const {
  const std::vector<std::byte> zeros(technique::particle_counter_bytes);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, rows_.get());
  gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0, technique::particle_counter_bytes, zeros.data());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_counters, rows_.get());
}

std::vector<std::uint32_t> ParticleCounters::read(const Api& gl) const {
  std::vector<std::uint32_t> rows(technique::particle_counter_bytes / sizeof(std::uint32_t));
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, rows_.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, 0, technique::particle_counter_bytes, rows.data());
  gl.check("glGetBufferSubData");
  return rows;
}

}  // namespace triptych::gl_backend
