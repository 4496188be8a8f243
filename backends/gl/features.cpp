#include "backends/gl/features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "backends/gl/framebuffer.hpp"
#include "backends/gl/objects.hpp"
#include "backends/gl/program.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

using measure::count_right;
using measure::judged_feature;
using measure::ProbedFeature;
using Words = std::vector<GLuint>;

Program kernel(const Api& gl, std::string_view file) {
  if (gl.VERSION_4_3 == 0) throw core::NotSupported("needs OpenGL 4.3");
  return link(gl, std::array{plain_stage(gl, GL_COMPUTE_SHADER, file)});
}

void set_uniform(const Api& gl, const Program& program, const char* name, GLuint x, GLuint y) {
  gl.Uniform2ui(gl.GetUniformLocation(program.get(), name), x, y);
}

// Allocates a buffer of this many bytes. Throws NotSupported if the driver cannot allocate it.
Buffer allocate_buffer(const Api& gl, GLenum target, std::uint64_t bytes) {
  Buffer buffer(gl);
  gl.BindBuffer(target, buffer.get());
  gl.BufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
  if (gl.GetError() == GL_OUT_OF_MEMORY) {
    throw core::NotSupported(fmt::format("the driver cannot allocate a buffer of {} bytes", bytes));
  }
  return buffer;
}

Buffer result_buffer(const Api& gl, std::size_t words) {
  const Words unwritten(words, 0xFFFFFFFF);
  Buffer buffer(gl);
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.get());
  gl.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(words * sizeof(GLuint)),
                unwritten.data(), GL_DYNAMIC_COPY);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer.get());
  return buffer;
}

template <class Value>
std::vector<Value> read_back(const Api& gl, const Buffer& buffer, std::uint64_t offset,
                             std::size_t count) {
  std::vector<Value> values(count);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, buffer.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(count * sizeof(Value)), values.data());
  gl.check("glGetBufferSubData");
  return values;
}

ProbedFeature probe_groups(const Api& gl) {
  const Program program = kernel(gl, "features_groups.comp");
  const auto most = static_cast<GLuint>(
      std::min<std::int64_t>(gl.limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0), 100'003));
  const std::size_t count = std::size_t{4} * most;
  const Buffer numbers = result_buffer(gl, count);
  gl.UseProgram(program.get());
  gl.DispatchCompute(most, 2, 2);
  const auto found = read_back<GLuint>(gl, numbers, 0, count);
  return judged_feature(count_right(found, [](std::size_t i) { return i + 1; }), count,
                        fmt::format("{} x 2 x 2 groups", most));
}

// Runs the same kernel at the beginning of a buffer and at `offset`. If the driver dropped the
// upper bits of the offset, the second run would overwrite the beginning.
ProbedFeature probe_offset(const Api& gl, std::uint64_t offset) {
  constexpr std::size_t count = 65536;
  constexpr std::uint64_t bytes = count * sizeof(GLuint);
  const Program program = kernel(gl, "features_write.comp");
  const Buffer buffer = allocate_buffer(gl, GL_SHADER_STORAGE_BUFFER, offset + bytes);
  const std::array<std::array<GLuint, 2>, 2> lines{{{7, 3}, {11, 5}}};
  gl.UseProgram(program.get());
  for (std::size_t n = 0; n < lines.size(); ++n) {
    gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, buffer.get(), static_cast<GLintptr>(n * offset),
                       static_cast<GLsizeiptr>(bytes));
    set_uniform(gl, program, "line", lines[n][0], lines[n][1]);
    gl.DispatchCompute(count / 64, 1, 1);
  }
  std::uint64_t right = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const auto found = read_back<GLuint>(gl, buffer, n * offset, count);
    right += count_right(
        found, [&](std::size_t i) { return lines[n][0] + lines[n][1] * static_cast<GLuint>(i); });
  }
  return judged_feature(right, 2 * count, fmt::format("offset of {} bytes", offset));
}

// Textures

constexpr GLuint image_edge = 16;
constexpr float border_value = 1;

float texel_value(GLuint x, GLuint y, GLuint level) {
  return 2.0F + static_cast<float>(x + image_edge * y + 1000 * level);
}

// Returns the index of the texel that coordinate `at` addresses along one axis of an image of
// `size` texels. `at` may lie outside of the image. Returns `size` for the border.
GLuint addressed(int at, GLuint size, GLint mode) {
  const int texels = static_cast<int>(size);
  if (mode == GL_CLAMP_TO_BORDER) return at < 0 || at >= texels ? size : static_cast<GLuint>(at);
  const int period = mode == GL_MIRRORED_REPEAT ? 2 * texels : texels;
  const int within = (at % period + period) % period;
  return static_cast<GLuint>(within < texels ? within : period - 1 - within);
}

// Creates a texture with four mip levels, in which no two texels are equal.
Texture levels_texture(const Api& gl, GLint mode) {
  Texture texture(gl);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
  for (GLuint level = 0; level < 4; ++level) {
    const GLuint size = image_edge >> level;
    std::vector<float> texels;
    for (GLuint i = 0; i < size * size; ++i)
      texels.push_back(texel_value(i % size, i / size, level));
    gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(level), GL_R32F, static_cast<GLsizei>(size),
                  static_cast<GLsizei>(size), 0, GL_RED, GL_FLOAT, texels.data());
  }
  const std::array<float, 4> white{border_value, border_value, border_value, border_value};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, white.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 3);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, mode);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, mode);
  return texture;
}

std::uint64_t correct_samples_in_level(const Api& gl, const Program& program, GLint mode,
                                       GLuint level) {
  const GLuint size = image_edge >> level;
  const GLuint side = 4 * size;
  const std::size_t count = std::size_t{side} * side;
  const Buffer values = result_buffer(gl, count);
  set_uniform(gl, program, "size", size, level);
  gl.DispatchCompute(static_cast<GLuint>(count / 64), 1, 1);
  const auto found = read_back<float>(gl, values, 0, count);
  return count_right(found, [&](std::size_t i) {
    const auto place = [&](std::size_t at) {
      return static_cast<int>(at) - static_cast<int>(size);
    };
    const GLuint x = addressed(place(i % side), size, mode);
    const GLuint y = addressed(place(i / side), size, mode);
    return x == size || y == size ? border_value : texel_value(x, y, level);
  });
}

ProbedFeature probe_addressing(const Api& gl, GLint mode, GLuint levels) {
  const Program program = kernel(gl, "features_sample.comp");
  const Texture texture = levels_texture(gl, mode);
  gl.UseProgram(program.get());
  std::uint64_t right = 0;
  std::uint64_t expected = 0;
  for (GLuint level = 0; level < levels; ++level) {
    right += correct_samples_in_level(gl, program, mode, level);
    expected += std::uint64_t{16} * (image_edge >> level) * (image_edge >> level);
  }
  return judged_feature(right, expected,
                        levels > 1 ? fmt::format("{} levels", levels)
                                   : std::string("coordinates from -1 to 3 on both axes"));
}

ProbedFeature probe_wide_image(const Api& gl) {
  const Program program = kernel(gl, "features_fetch.comp");
  const auto width = static_cast<GLuint>(gl.limit(GL_MAX_TEXTURE_SIZE) / 64 * 64);
  std::vector<float> texels(std::size_t{2} * width);
  std::iota(texels.begin(), texels.end(), 1.0F);
  const Texture texture(gl);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture.get());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, static_cast<GLsizei>(width), 2, 0, GL_RED, GL_FLOAT,
                texels.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  const Buffer values = result_buffer(gl, width);
  gl.UseProgram(program.get());
  gl.DispatchCompute(width / 64, 1, 1);
  const auto found = read_back<float>(gl, values, 0, width);
  return judged_feature(count_right(found, [&](std::size_t i) { return texels[width + i]; }), width,
                        fmt::format("{} x 2 texels", width));
}

// Draws

struct PointGrid {
  GLuint width;
  GLuint height;
};

Buffer filled(const Api& gl, GLenum target, std::span<const GLuint> words) {
  Buffer buffer(gl);
  gl.BindBuffer(target, buffer.get());
  gl.BufferData(target, static_cast<GLsizeiptr>(words.size_bytes()), words.data(), GL_STATIC_DRAW);
  return buffer;
}

// Draws one point on each of the first `count` pixels, and checks every pixel. The shader computes
// the pixel from the vertex number plus the instance number. The instance numbers are read from a
// vertex attribute that advances once per instance; its buffer has `instances` elements.
template <class Draw>
ProbedFeature probe_points(const Api& gl, PointGrid grid, GLuint count, std::size_t instances,
                           std::string size, const Draw& draw) {
  const Program program =
      link(gl, std::array{plain_stage(gl, GL_VERTEX_SHADER, "features_points.vert"),
                          plain_stage(gl, GL_FRAGMENT_SHADER, "features_points.frag")});
  const Renderbuffer target =
      pixels(gl, GL_R32UI, static_cast<int>(grid.width), static_cast<int>(grid.height));
  const Framebuffer framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.get());
  check_framebuffer(gl);
  const std::array<GLuint, 4> nothing{};
  gl.ClearBufferuiv(GL_COLOR, 0, nothing.data());
  gl.Viewport(0, 0, static_cast<GLsizei>(grid.width), static_cast<GLsizei>(grid.height));
  Words numbers(instances);
  std::iota(numbers.begin(), numbers.end(), 0U);
  const VertexArray vertices(gl);
  gl.BindVertexArray(vertices.get());
  const Buffer buffer = filled(gl, GL_ARRAY_BUFFER, numbers);
  gl.VertexAttribIPointer(0, 1, GL_UNSIGNED_INT, 0, nullptr);
  gl.VertexAttribDivisor(0, 1);
  gl.EnableVertexAttribArray(0);
  gl.UseProgram(program.get());
  set_uniform(gl, program, "size", grid.width, grid.height);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  draw();
  Words found(std::size_t{grid.width} * grid.height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, static_cast<GLsizei>(grid.width), static_cast<GLsizei>(grid.height),
                GL_RED_INTEGER, GL_UNSIGNED_INT, found.data());
  gl.check("glReadPixels");
  return judged_feature(count_right(found, [&](std::size_t i) { return i < count ? i + 1 : 0; }),
                        found.size(), std::move(size));
}

ProbedFeature probe_indirect_draws(const Api& gl) {
  if (gl.VERSION_4_3 == 0) throw core::NotSupported("needs OpenGL 4.3");
  constexpr GLuint count = 100'000;
  Words commands;  // vertex count, instance count, first vertex, first instance
  for (GLuint i = 0; i < count; ++i) commands.insert(commands.end(), {1, 1, 0, i});
  return probe_points(gl, {512, 196}, count, count, fmt::format("{} draws", count), [&] {
    const Buffer buffer = filled(gl, GL_DRAW_INDIRECT_BUFFER, commands);
    gl.MultiDrawArraysIndirect(GL_POINTS, nullptr, static_cast<GLsizei>(count), 0);
    gl.Finish();
  });
}

ProbedFeature probe_instances(const Api& gl) {
  constexpr GLuint count = 10'000'000;
  if (gl.limit(GL_MAX_RENDERBUFFER_SIZE) < 4096) {
    throw core::NotSupported("needs a GL_MAX_RENDERBUFFER_SIZE of at least 4096");
  }
  return probe_points(gl, {4096, 2442}, count, count, fmt::format("{} instances", count),
                      [&] { gl.DrawArraysInstanced(GL_POINTS, 0, 1, count); });
}

// Draws with indices that are 1000 too large and a base vertex of -1000.
ProbedFeature probe_base_vertex(const Api& gl) {
  constexpr GLuint count = 100'000;
  constexpr GLint base = -1000;
  Words indices(count);
  std::iota(indices.begin(), indices.end(), static_cast<GLuint>(-base));
  return probe_points(gl, {512, 196}, count, 1, fmt::format("base vertex {}", base), [&] {
    const Buffer buffer = filled(gl, GL_ELEMENT_ARRAY_BUFFER, indices);
    gl.DrawElementsBaseVertex(GL_POINTS, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr,
                              base);
    gl.Finish();
  });
}

}  // namespace

std::vector<measure::FeatureProbe> feature_probes(Context& context) {
  constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30U;
  const auto probe = [&context](std::string name, auto run) {
    return measure::FeatureProbe{.name = std::move(name), .run = [&context, run] {
                                   const Current current(context);
                                   measure::ProbedFeature probed = run(context.gl());
                                   context.gl().check("feature probe");
                                   return probed;
                                 }};
  };
  return {
      probe("work-groups", probe_groups),
      probe("offset-2-gib", [](const Api& gl) { return probe_offset(gl, 2 * gibibyte); }),
      probe("offset-4-gib", [](const Api& gl) { return probe_offset(gl, 4 * gibibyte); }),
      probe("repeat", [](const Api& gl) { return probe_addressing(gl, GL_REPEAT, 1); }),
      probe("mirrored-repeat",
            [](const Api& gl) { return probe_addressing(gl, GL_MIRRORED_REPEAT, 1); }),
      probe("border", [](const Api& gl) { return probe_addressing(gl, GL_CLAMP_TO_BORDER, 1); }),
      probe("mip-levels", [](const Api& gl) { return probe_addressing(gl, GL_REPEAT, 4); }),
      probe("wide-image", probe_wide_image),
      probe("indirect-draws", probe_indirect_draws),
      probe("instances", probe_instances),
      probe("base-vertex", probe_base_vertex)};
}

}  // namespace triptych::gl_backend
