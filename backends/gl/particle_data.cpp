#include "backends/gl/particle_data.hpp"

#include <algorithm>
#include <numeric>

#include "backends/gl/volume_data.hpp"
#include "core/image.hpp"
#include "technique/particles/particle_parameters.hpp"

namespace triptych::gl_backend {
namespace {

// Bindings of technique/particles/parameters.glsl and storage.glsl.
constexpr GLuint binding_parameters = 0;
constexpr GLuint binding_transfer = 1;
constexpr GLuint binding_counters = 2;
constexpr GLuint binding_spheres = 3;
constexpr GLuint binding_colours = 4;
constexpr GLuint binding_ids = 5;

constexpr std::size_t counter_rows = 1024;
constexpr std::size_t counters_per_row = 8;

// Never empty: a block needs a buffer even where nothing will be read.
template <class T>
Buffer array_buffer(const Api& gl, const std::vector<T>& values) {
  static constexpr std::array<std::byte, 16> nothing{};
  if (values.empty()) return constant_buffer(gl, nothing);
  return constant_buffer(gl, std::as_bytes(std::span(values)));
}

Buffer colour_buffer(const Api& gl, const technique::Arrangement& arrangement) {
  switch (arrangement.colour) {
    case scene::ColourKind::rgba8:
      return array_buffer(gl, arrangement.rgba8);
    case scene::ColourKind::rgba32:
      return array_buffer(gl, arrangement.rgba32);
    case scene::ColourKind::intensity:
      break;
  }
  return array_buffer(gl, arrangement.intensity);
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
      spheres_(array_buffer(gl, arrangement.spheres)),
      colours_(colour_buffer(gl, arrangement)),
      ids_(array_buffer(gl, arrangement.ids)),
      vertices_(gl) {
  if (gl.ARB_shader_draw_parameters == 0) {
    std::vector<std::uint32_t> numbers(arrangement.count());
    std::iota(numbers.begin(), numbers.end(), 0U);
    numbers_ = array_buffer(gl, numbers);
  }
  describe_vertices(gl, arrangement.colour);
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
    : rows_(device_buffer(gl, sizeof(GLuint) * counter_rows * counters_per_row)) {}

void ParticleCounters::start(const Api& gl) const {
  const std::vector<GLuint> zeros(counter_rows * counters_per_row);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, rows_.get());
  gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(zeros.size() * sizeof(GLuint)),
                   zeros.data());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_counters, rows_.get());
}

std::vector<std::uint64_t> ParticleCounters::sums(const Api& gl) const {
  std::vector<GLuint> values(counter_rows * counters_per_row);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, rows_.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, 0,
                      static_cast<GLsizeiptr>(values.size() * sizeof(GLuint)), values.data());
  gl.check("glGetBufferSubData");
  std::vector<std::uint64_t> sums(counters_per_row);
  for (std::size_t i = 0; i < values.size(); ++i) sums[i % counters_per_row] += values[i];
  return sums;
}

record::Counts common_counts(const technique::ParticleOptions& options, std::uint64_t cells,
                             std::uint64_t particles, const std::vector<std::uint64_t>& sums,
                             std::span<const std::uint32_t> ids) {
  const auto sum = [&](Counted which) { return sums[static_cast<std::size_t>(which)]; };
  const bool all = options.culling == technique::Culling::none;
  const std::uint64_t submitted = all ? particles : sum(Counted::submitted);
  std::vector<std::uint32_t> visible(ids.begin(), ids.end());
  std::ranges::sort(visible);
  visible.erase(std::ranges::unique(visible).begin(), visible.end());
  const bool gap = !visible.empty() && visible.back() == core::Image::no_particle;
  return {{"cells", cells},
          {"cells_culled", all ? 0 : sum(Counted::cells_culled)},
          {"particles_submitted", submitted},
          {"particles_culled", particles - submitted},
          {"sprites", sum(Counted::sprites)},
          {"vertices", sum(Counted::vertices)},
          {"fragments", sum(Counted::fragments)},
          {"fragments_discarded", sum(Counted::discarded)},
          {"fragments_kept", sum(Counted::fragments) - sum(Counted::discarded)},
          {"visible_ids", visible.size() - (gap ? 1 : 0)}};
}

}  // namespace triptych::gl_backend
