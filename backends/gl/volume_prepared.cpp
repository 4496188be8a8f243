#include "backends/gl/volume_prepared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "backends/gl/compute_pass.hpp"
#include "backends/gl/prepared.hpp"
#include "measure/contract/not_drawn.hpp"
#include "technique/volume/long_rays.hpp"
#include "technique/volume/opacity_form.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/preintegration.hpp"
#include "technique/volume/raycast_buffers.hpp"

namespace triptych::gl_backend {
namespace {

// The binding in technique/volume/raycast/parameters.glsl.
constexpr GLuint binding_volume_counters = 5;

std::size_t pixel_count(const measure::VolumeWork& work) {
  return static_cast<std::size_t>(work.scene.width) * static_cast<std::size_t>(work.scene.height);
}

std::size_t counters_size(std::size_t pixels) {
  return sizeof(GLuint) * technique::raycast_counter_stride * pixels;
}

// The program that also counts its work, and the buffer for its counters. Both are created when
// they are first needed.
struct Counting {
  Program program;
  Buffer counters;
};

// Sums the counters of all pixels in 64-bit integers.
record::Counts sum_counters(const Api& gl, const Buffer& counters, std::size_t pixels) {
  std::vector<GLuint> values(pixels * technique::raycast_counter_stride);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.BindBuffer(GL_COPY_READ_BUFFER, counters.get());
  gl.GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(counters_size(pixels)),
                      values.data());
  gl.check("glGetBufferSubData");
  measure::check_counted(values);
  record::Counts counts{{"rays", pixels}};
  for (std::size_t c = 0; c < technique::raycast_counters.size(); ++c) {
    std::uint64_t& sum = counts[std::string(technique::raycast_counters[c])];
    for (std::size_t i = c; i < values.size(); i += technique::raycast_counter_stride) {
      sum += values[i];
    }
  }
  return counts;
}

class VolumeDrawing final : public Drawing {
 public:
  VolumeDrawing(const Api& gl, const measure::VolumeWork& work, const Constants& constants,
                std::unique_ptr<Pass> pass)
      : constants_(constants),
        width_(work.scene.width),
        pixels_(pixel_count(work)),
        pass_(std::move(pass)),
        data_(
            gl, work,
            constants.parts ? cut_of(gl, "raycast", work).parts : std::vector<technique::Part>{}) {
    const std::vector<Stage> stages = pass_->stages(gl, constants);
    program_ = link(gl, stages);
    std::vector<std::string> sources;
    for (const Stage& stage : stages) sources.push_back(stage.source);
    kernel_hash_ = hash_of(gl, sources);
    if (data_.parts() == 0) pass_->dump(work, sources.front());
  }

  [[nodiscard]] std::span<const Statistic> statistics() const override {
    return pass_->statistics();
  }

  void poison(const Api& gl) override {
    pass_->poison(gl);
    if (counting_) poison_buffer(gl, counting_->counters);
  }

  void bind(const Api& gl, measure::Purpose purpose) override {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !counting_) counting_ = make_counting(gl);
    data_.bind(gl);
    pass_->bind(gl);
    gl.UseProgram(counting ? counting_->program.get() : program_.get());
    if (counting) {
      gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_volume_counters,
                        counting_->counters.get());
    }
  }

  void submit(const Api& gl, measure::Purpose purpose) override {
    if (data_.parts() == 0) pass_->submit(gl, purpose);
    for (int part = 0; part < data_.parts(); ++part) {
      data_.move_part(gl, part);
      pass_->submit(gl, purpose);
      gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
  }

  [[nodiscard]] record::Counts counters(const Api& gl) const override {
    return sum_counters(gl, counting_->counters, pixels_);
  }
  [[nodiscard]] core::Image read(const Api& gl) const override { return pass_->read(gl); }
  [[nodiscard]] std::string kernel_hash() const override { return kernel_hash_; }

  [[nodiscard]] technique::RayTrace trace(const Api& gl, int x, int y) override {
    if (constants_.cells) throw core::NotSupported(measure::pixel_history_unsupported);
    const std::vector<std::uint32_t> words = technique::ray_trace_words_for(x, y, width_, pixels_);
    const auto size = static_cast<GLsizeiptr>(words.size() * sizeof(GLuint));
    Constants constants = constants_;
    constants.count = constants.trace = true;
    counting_.emplace(Counting{link(gl, pass_->stages(gl, constants)),
                               device_buffer(gl, words.size() * sizeof(GLuint))});
    gl.BindBuffer(GL_COPY_WRITE_BUFFER, counting_->counters.get());
    gl.BufferSubData(GL_COPY_WRITE_BUFFER, 0, size, words.data());
    bind(gl, measure::Purpose::counters);
    submit(gl, measure::Purpose::counters);
    gl.Finish();
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<std::uint32_t> records(technique::ray_trace_words);
    gl.BindBuffer(GL_COPY_READ_BUFFER, counting_->counters.get());
    gl.GetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(counters_size(pixels_)),
                        static_cast<GLsizeiptr>(records.size() * sizeof(GLuint)), records.data());
    counting_.reset();  // the next counting frame needs a program that does not trace
    return technique::read_ray_trace(records);
  }

 private:
  [[nodiscard]] Counting make_counting(const Api& gl) const {
    Constants constants = constants_;
    constants.count = true;
    return {link(gl, pass_->stages(gl, constants)), device_buffer(gl, counters_size(pixels_))};
  }

  Constants constants_;
  int width_;
  std::size_t pixels_;
  std::unique_ptr<Pass> pass_;
  VolumeData data_;
  Program program_;
  std::string kernel_hash_;
  std::optional<Counting> counting_;
};

std::optional<std::string> texture_reason(const Api& gl, const scene::VoxelGrid& grid,
                                          bool in_parts) {
  const auto [nx, ny, nz] = grid.size;
  const std::int64_t edge = gl.limit(GL_MAX_3D_TEXTURE_SIZE);
  if ((in_parts ? std::max(nx, ny) : std::max({nx, ny, nz})) > edge) {
    return fmt::format("the volume has {}x{}x{} voxels, but GL_MAX_3D_TEXTURE_SIZE is {}", nx, ny,
                       nz, edge);
  }
  if (!in_parts && !can_store_whole(gl, grid.size, grid.format)) {
    return fmt::format(
        "GL_PROXY_TEXTURE_3D reports that the driver cannot create a texture of {}x{}x{} voxels in "
        "format {} ({} bytes)",
        nx, ny, nz, scene::name_of(grid.format), grid.data.size());
  }
  return std::nullopt;
}

// Returns the reason why the volume fits neither as a whole nor in parts.
std::optional<std::string> voxels_reason(const Api& gl, const measure::VolumeWork& work,
                                         const technique::RaycastBuffers& buffers,
                                         const technique::Cut& cut) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  const bool in_parts = !cut.parts.empty();
  const auto most_texels = static_cast<std::uint64_t>(gl.limit(GL_MAX_TEXTURE_BUFFER_SIZE));
  auto reason = is_packed(work)
                    ? technique::packed_reason(
                          in_parts ? 0 : technique::packed_texels(grid.size, grid.format), buffers,
                          {most_texels, "GL_MAX_TEXTURE_BUFFER_SIZE"})
                    : texture_reason(gl, grid, in_parts);
  return reason ? reason : cut.reason;
}

}  // namespace

Constants constants_of(const measure::VolumeWork& work) {
  return {
      .manual_sampler = work.options.sampler == technique::Sampler::manual,
      .packed = is_packed(work),
      .voxel_bits = technique::voxel_bits(work.scene.grid->format),
      .shading = work.scene.shading.enabled,
      .count = false,
      .speed_of_light = false,
      .fault = static_cast<int>(work.options.fault),
      .opacity_form = technique::opacity_form(
          work.options.fault == technique::Fault::uncorrected_opacity ? 1 : work.scene.step_voxels),
      .preintegrated = technique::preintegration_form(work.scene),
      .cells = work.scene.quadrature == scene::Quadrature::cells,
      .leaps = work.options.skip == technique::Skip::distance,
      .adapt = work.options.adapt > 0,
      .precision = work.options.precision == technique::Precision::fp64 ? 64 : 32,
      .long_rays = technique::has_long_rays(work.scene)};
}

std::optional<std::string> volume_unsupported(const Api& gl, std::string_view technique,
                                              const measure::VolumeWork& work) {
  if (auto reason = storage_unsupported(gl)) return reason;
  // Doubles were introduced in GL 4.0, but below 4.3 the sources are compiled as GLSL 3.30
  // (program.cpp).
  if (work.options.precision == technique::Precision::fp64 && gl.VERSION_4_3 == 0) {
    return "precision=fp64 requires OpenGL 4.3";
  }
  technique::RaycastBuffers buffers = technique::raycast_buffers(work.scene, work.options);
  const technique::Cut cut = cut_of(gl, technique, work);
  if (!cut.parts.empty()) buffers.pauses = technique::pauses_bytes(work.scene, work.options);
  if (auto reason = voxels_reason(gl, work, buffers, cut)) return reason;
  return technique::buffer_reason(
      buffers, static_cast<std::uint64_t>(gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)),
      "GL_MAX_SHADER_STORAGE_BLOCK_SIZE");
}

std::unique_ptr<measure::Prepared> prepare_volume(Context& context, Stamps stamps,
                                                  const measure::VolumeWork& work,
                                                  const Constants& constants,
                                                  std::unique_ptr<Pass> pass) {
  return make_prepared(
      context, stamps,
      std::make_unique<VolumeDrawing>(context.gl(), work, constants, std::move(pass)));
}

}  // namespace triptych::gl_backend
