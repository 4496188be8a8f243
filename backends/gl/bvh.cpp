// Traces rays through a hierarchy of bounding boxes. Compute passes build and traverse it
// (technique/particles/hierarchy.glsl, bvh.comp.glsl).
#include <fmt/format.h>

#include <array>

#include "backends/gl/hierarchy_data.hpp"
#include "backends/gl/particle_data.hpp"
#include "backends/gl/particle_limits.hpp"
#include "backends/gl/particle_source.hpp"
#include "backends/gl/particle_target.hpp"
#include "backends/gl/prepared.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/volume_data.hpp"
#include "technique/particles/particle_counts.hpp"

namespace triptych::gl_backend {
namespace {

using measure::Purpose;
using technique::Structure;

constexpr GLuint binding_traced_pixels = 11;
// The first of the texture units for pixels, spheres, colours and ids.
constexpr GLuint first_shown_texels = 16;

// The passes that build the hierarchy, in the same order as `build_passes`.
enum class BuildPass : std::uint8_t { keys, count, rows, totals, scatter, leaves, level };
constexpr std::array<std::string_view, 7> build_passes{"keys",    "count",  "rows", "totals",
                                                       "scatter", "leaves", "level"};
// Flags in TRI_STEP.w of bvh.comp.glsl. A beam consists of the rays of 4×2 pixels, which one
// invocation traces. continues_beams resumes the traversals that an earlier dispatch did not
// finish, and leaves_beams stores where traversals stop.
constexpr GLuint continues_beams = 1;
constexpr GLuint leaves_beams = 2;

constexpr std::string_view tree_defines =
    "#define TRI_TREE_ORIGIN tree_origin\n#define TRI_TREE_SHAPE tree_shape\n"
    "#define TRI_STEP tree_step\n"
    "uniform vec4 tree_origin;\nuniform uvec4 tree_shape;\nuniform uvec4 tree_step;\n";

Program tree_program(const Api& gl, const ParticleConstants& constants,
                     const std::vector<std::string_view>& files,
                     std::vector<std::string>& sources) {
  std::vector<std::string_view> all{"box_math.h", "hierarchy.glsl"};
  all.insert(all.end(), files.begin(), files.end());
  const std::vector<Stage> stages =
      particle_stages(gl, constants, {{GL_COMPUTE_SHADER, all, std::string(tree_defines)}});
  sources.push_back(stages.front().source);
  return link(gl, stages);
}

Program build_program(const Api& gl, ParticleConstants constants, BuildPass pass,
                      std::vector<std::string>& sources) {
  constants.count = false;  // the build passes have no counters
  const std::string main_file =
      fmt::format("hierarchy_{}.comp.glsl", build_passes.at(static_cast<std::size_t>(pass)));
  if (pass == BuildPass::keys)
    return tree_program(gl, constants, {"storage.glsl", main_file}, sources);
  if (pass == BuildPass::leaves) {
    return tree_program(gl, constants, {"storage.glsl", "sphere_box.glsl", main_file}, sources);
  }
  return tree_program(gl, constants, {main_file}, sources);
}

Program trace_program(const Api& gl, const ParticleConstants& constants,
                      std::vector<std::string>& sources) {
  return tree_program(gl, constants,
                      {"keys.glsl", "sphere_box.glsl", "traced.glsl", "bvh.comp.glsl"}, sources);
}

Program show_program(const Api& gl, const ParticleConstants& constants,
                     std::vector<std::string>& sources) {
  const std::vector<Stage> stages = particle_stages(
      gl, constants,
      {{GL_VERTEX_SHADER, {"traced_show.vert.glsl"}, "#define TRI_CORNER gl_VertexID\n"},
       {GL_FRAGMENT_SHADER,
        {"keys.glsl", "traced_texels.glsl", "storage.glsl", "traced_show.frag.glsl"},
        {}}});
  for (const Stage& stage : stages) sources.push_back(stage.source);
  return link(gl, stages);
}

std::size_t traced_words(const scene::ParticleScene& scene) {
  return 2 * static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
}

class BvhDrawing final : public Drawing {
 public:
  BvhDrawing(const Api& gl, const measure::ParticleWork& work,
             const technique::Arrangement& arrangement);

  [[nodiscard]] std::span<const Statistic> statistics() const override {
    static constexpr std::array<Statistic, 1> wanted{
        {{GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"}}};
    return wanted;
  }
  void poison(const Api& gl) override {
    target_.poison(gl);
    poison_buffer(gl, pixels_);
  }
  void bind(const Api& gl, Purpose purpose) override;
  void submit(const Api& gl, Purpose purpose) override;
  [[nodiscard]] record::Counts counters(const Api& gl) const override {
    return technique::particle_counts(
        {.method = technique::Method::rays, .culling = options_.culling},
        counting_->counters.read(gl), read(gl));
  }
  [[nodiscard]] core::Image read(const Api& gl) const override { return target_.read(gl, near_); }
  [[nodiscard]] std::string kernel_hash() const override { return kernel_hash_; }

 private:
  struct Counting {
    Program trace;
    ParticleCounters counters;
  };
  using Step = std::array<GLuint, 4>;

  [[nodiscard]] const Program& pass(BuildPass which) const {
    return build_.at(static_cast<std::size_t>(which));
  }
  void bind_data(const Api& gl) const;
  void run(const Api& gl, const Program& program, std::uint32_t invocations,
           const Step& step) const;
  void sort(const Api& gl) const;
  void fit(const Api& gl, bool refit) const;
  void trace_beams(const Api& gl, const Program& trace, GLuint stride, GLuint flags) const;
  void build(const Api& gl);

  technique::ParticleOptions options_;
  double near_;
  std::array<float, 4> background_;
  ParticleConstants constants_;
  technique::Hierarchy hierarchy_;
  technique::BeamGrid grid_;
  ParticleData data_;
  HierarchyData tree_;
  Buffer pixels_;
  std::array<Texture, 4> shown_texels_;
  ParticleTarget target_;
  std::vector<Program> build_;
  Program trace_;
  Program show_;
  std::string kernel_hash_;
  // The number of dispatches after which the traversals of all beams have ended.
  std::uint32_t rounds_ = 1;
  std::optional<Counting> counting_;
};

BvhDrawing::BvhDrawing(const Api& gl, const measure::ParticleWork& work,
                       const technique::Arrangement& arrangement)
    : options_(work.options),
      near_(work.scene.camera.near),
      background_(work.scene.background),
      constants_(particle_constants(work)),
      hierarchy_(arrangement),
      grid_(technique::beam_grid(work.scene.width, work.scene.height)),
      data_(gl, work, arrangement),
      tree_(gl, hierarchy_, grid_.beams()),
      pixels_(device_words(gl, traced_words(work.scene))),
      target_(gl, work.scene.width, work.scene.height, options_.fault) {
  constexpr std::size_t word = sizeof(GLuint);
  const std::size_t count = std::max<std::size_t>(arrangement.count(), 1);
  const std::size_t colour_words =
      std::max<std::size_t>(arrangement.bytes(technique::Property::colour) / word, 1);
  shown_texels_ = {texels_of(gl, pixels_, traced_words(work.scene), GL_R32UI),
                   texels_of(gl, data_.spheres(), 4 * count, GL_RGBA32F),
                   texels_of(gl, data_.colours(), colour_words, GL_R32UI),
                   texels_of(gl, data_.ids(), count, GL_R32UI)};
  std::vector<std::string> sources;
  for (std::size_t pass = 0; pass < build_passes.size(); ++pass) {
    build_.push_back(build_program(gl, constants_, static_cast<BuildPass>(pass), sources));
  }
  trace_ = trace_program(gl, constants_, sources);
  show_ = show_program(gl, constants_, sources);
  kernel_hash_ = hash_of(gl, sources);
  if (hierarchy_.particles() > 0 && gl.executes()) build(gl);
}

void BvhDrawing::bind_data(const Api& gl) const {
  data_.bind(gl);
  tree_.bind(gl);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_traced_pixels, pixels_.get());
  for (GLuint n = 0; n < shown_texels_.size(); ++n) {
    gl.ActiveTexture(GL_TEXTURE0 + first_shown_texels + n);
    gl.BindTexture(GL_TEXTURE_BUFFER, shown_texels_.at(n).get());
  }
  gl.ActiveTexture(GL_TEXTURE0);
}

void BvhDrawing::run(const Api& gl, const Program& program, std::uint32_t invocations,
                     const Step& step) const {
  const technique::HierarchyParameters& tree = hierarchy_.parameters();
  gl.UseProgram(program.get());
  gl.Uniform4fv(gl.GetUniformLocation(program.get(), "tree_origin"), 1, tree.origin.data());
  gl.Uniform4uiv(gl.GetUniformLocation(program.get(), "tree_shape"), 1, tree.shape.data());
  gl.Uniform4uiv(gl.GetUniformLocation(program.get(), "tree_step"), 1, step.data());
  const auto [columns, group_rows] = technique::group_rows(invocations);
  gl.DispatchCompute(columns, group_rows, 1);
  // Later passes read the results as texels or from storage buffers.
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void BvhDrawing::sort(const Api& gl) const {
  constexpr std::uint32_t digits = 256;
  const std::uint32_t runs = hierarchy_.runs();
  run(gl, pass(BuildPass::keys), hierarchy_.particles(), {});
  for (const technique::SortPass& digit : technique::sort_passes(hierarchy_)) {
    const Step values{digit.shift, digit.from, runs, 0};
    run(gl, pass(BuildPass::count), runs, values);
    run(gl, pass(BuildPass::rows), digits, values);
    run(gl, pass(BuildPass::totals), 1, values);
    run(gl, pass(BuildPass::scatter), runs, values);
  }
}

void BvhDrawing::fit(const Api& gl, bool refit) const {
  run(gl, pass(BuildPass::leaves), hierarchy_.leaves(), {refit ? 1U : 0U, 0, 0, 0});
  for (std::uint32_t nodes = hierarchy_.leaves() / 2; nodes > 0; nodes /= 2) {
    run(gl, pass(BuildPass::level), nodes, {nodes, 0, 0, 0});
  }
}

// Traces every stride-th beam.
void BvhDrawing::trace_beams(const Api& gl, const Program& trace, GLuint stride,
                             GLuint flags) const {
  run(gl, trace, (grid_.beams() + stride - 1) / stride,
      {stride, grid_.columns, grid_.beams(), flags});
}

// Builds the hierarchy, and counts the dispatches that tracing needs. Because the camera does not
// move, every frame needs the same number.
void BvhDrawing::build(const Api& gl) {
  bind_data(gl);
  sort(gl);
  fit(gl, false);
  trace_beams(gl, trace_, 1, leaves_beams);
  while (!tree_.all_ended(gl)) {
    ++rounds_;
    trace_beams(gl, trace_, 1, continues_beams | leaves_beams);
  }
}

void BvhDrawing::bind(const Api& gl, Purpose purpose) {
  if (purpose == Purpose::counters) {
    if (!counting_) {
      ParticleConstants constants = constants_;
      constants.count = true;
      std::vector<std::string> sources;
      counting_.emplace(Counting{trace_program(gl, constants, sources), ParticleCounters(gl)});
    }
    counting_->counters.start(gl);
  }
  bind_data(gl);
  target_.bind(gl);
}

void BvhDrawing::submit(const Api& gl, Purpose purpose) {
  target_.clear(gl, background_);
  if (hierarchy_.particles() == 0) return;
  if (options_.structure == Structure::rebuilt) sort(gl);
  if (options_.structure != Structure::built_once) {
    fit(gl, options_.structure == Structure::refitted);
  }
  const bool counts = purpose == Purpose::counters;
  const Program& trace = counts ? counting_->trace : trace_;
  const GLuint keep_flag = rounds_ > 1 ? leaves_beams : 0;
  for (std::uint32_t round = 0; round < rounds_; ++round) {
    trace_beams(gl, trace, 1, keep_flag | (round > 0 ? continues_beams : 0));
  }
  if (options_.extra_work_stride > 0 && !counts && rounds_ == 1) {
    trace_beams(gl, trace, static_cast<GLuint>(options_.extra_work_stride), 0);
  }
  gl.UseProgram(show_.get());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

std::optional<std::string> bvh_unsupported(const Api& gl, const measure::ParticleWork& work) {
  if (auto reason = particles_unsupported(gl, work, true)) return reason;
  constexpr std::int64_t blocks = 10;
  const std::int64_t most_blocks = gl.limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  if (most_blocks < blocks) {
    return fmt::format("needs {} storage blocks, but GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS is {}",
                       blocks, most_blocks);
  }
  const auto needed = static_cast<std::int64_t>(
      sizeof(GLuint) * std::max(traced_words(work.scene), 4 * work.scene.particles->count()));
  const std::int64_t most = gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  if (needed > most) {
    return fmt::format(
        "{} particles and {}x{} pixels need a storage block of {} bytes, but "
        "GL_MAX_SHADER_STORAGE_BLOCK_SIZE is {}",
        work.scene.particles->count(), work.scene.width, work.scene.height, needed, most);
  }
  return std::nullopt;
}

std::unique_ptr<Drawing> make_bvh(const Api& gl, const measure::ParticleWork& work) {
  return std::make_unique<BvhDrawing>(gl, work, technique::arrange(work.scene));
}

}  // namespace

ParticleTechnique bvh() {
  return {&bvh_unsupported, &make_bvh};
}

}  // namespace triptych::gl_backend
