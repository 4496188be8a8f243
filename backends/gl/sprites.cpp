#include "backends/gl/sprites.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "backends/gl/cell_draws.hpp"
#include "backends/gl/large_points.hpp"
#include "backends/gl/occlusion.hpp"
#include "backends/gl/particle_data.hpp"
#include "backends/gl/particle_target.hpp"
#include "technique/particles/arrangement.hpp"
#include "technique/particles/particle_counts.hpp"

namespace triptych::gl_backend {
namespace {

using measure::Purpose;
using technique::Culling;

std::vector<Statistic> statistics_of(const Sprites& sprites, Culling culling) {
  std::vector<Statistic> wanted{
      {GL_VERTICES_SUBMITTED_ARB, "input_assembly_vertices"},
      {GL_PRIMITIVES_SUBMITTED_ARB, "input_assembly_primitives"},
      {GL_VERTEX_SHADER_INVOCATIONS_ARB, "vertex_invocations"},
      {GL_CLIPPING_INPUT_PRIMITIVES_ARB, "clipping_invocations"},
      {GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, "clipping_primitives"},
      {GL_FRAGMENT_SHADER_INVOCATIONS_ARB, "fragment_invocations"},
  };
  for (const ParticleStage& stage : sprites.front().stages) {
    if (stage.type == GL_GEOMETRY_SHADER) {
      wanted.push_back({GL_GEOMETRY_SHADER_INVOCATIONS, "geometry_invocations"});
      wanted.push_back({GL_GEOMETRY_SHADER_PRIMITIVES_EMITTED_ARB, "geometry_primitives"});
    } else if (stage.type == GL_TESS_CONTROL_SHADER) {
      wanted.push_back({GL_TESS_CONTROL_SHADER_PATCHES_ARB, "tessellation_control_patches"});
      wanted.push_back(
          {GL_TESS_EVALUATION_SHADER_INVOCATIONS_ARB, "tessellation_evaluation_invocations"});
    }
  }
  if (culling != Culling::none) {
    wanted.push_back({GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"});
  }
  return wanted;
}

// The programs of all draws, either for timing or for counting.
struct Programs {
  struct Draw {
    std::array<Program, 2> cull;  // culling before the first draw and before the second draw
    Program sprites;
  };
  std::vector<Draw> draws;
  std::vector<std::string> sources;
};

// Returns the values of TRI_OCCLUSION in cull.glsl, one for each culling pass of a frame.
std::vector<int> passes_of(Culling culling) {
  if (culling == Culling::none) return {};
  if (culling == Culling::frustum) return {0};
  return {1, 2};
}

ParticleStage cull_stage(bool instanced, int pass) {
  std::vector<std::string_view> files{"cells.glsl", "cull.glsl", "cull.comp.glsl"};
  if (pass > 0) {
    files = {"sprite.glsl", "cells.glsl", "occlusion.glsl", "cull.glsl", "cull.comp.glsl"};
  }
  return {
      GL_COMPUTE_SHADER, files,
      fmt::format("#define TRI_INSTANCED {:d}\n#define TRI_OCCLUSION {}\n", int{instanced}, pass)};
}

// With occlusion culling, a second draw follows the first. It draws the cells (ranges of
// neighbouring particles) that have become visible since the previous frame. Its spheres are
// therefore drawn after those of the first draw, although their cells may come first in the drawing
// order (technique::Arrangement). Because the camera does not move, hidden cells stay hidden, so
// the second draw is empty. Even if it were not empty, the order would matter only for exactly
// equal depths in different cells.
class SpriteDrawing final : public Drawing {
 public:
  SpriteDrawing(const Api& gl, const measure::ParticleWork& work, const Sprites& sprites,
                const technique::Arrangement& arrangement)
      : options_(work.options),
        background_(work.scene.background),
        near_(work.scene.camera.near),
        particles_(arrangement.count()),
        cells_(arrangement.cells.size()),
        sprites_(sprites),
        statistics_(statistics_of(sprites, work.options.culling)),
        constants_(particle_constants(work)),
        data_(gl, work, arrangement),
        target_(gl, work.scene.width, work.scene.height, work.options.fault),
        programs_(make_programs(gl, constants_)) {
    for (const SpriteDraw& draw : sprites) {
      const std::vector<technique::Cell> cells =
          draw.large_only ? cells_with_large_points(gl, work.scene, arrangement)
                          : arrangement.cells;
      draws_.emplace_back(gl, cells, draw.instanced);
      if (options_.extra_work_stride == 0) continue;
      extra_.emplace_back(gl, thinned(cells, options_.extra_work_stride), draw.instanced);
    }
    if (options_.culling == Culling::occlusion && cells_ > 0) {
      occlusion_.emplace(gl, work, cells_);
      programs_.sources.push_back(occlusion_->source());
      if (gl.executes()) draw_before(gl, work, arrangement);
    }
    kernel_hash_ = hash_of(gl, programs_.sources);
  }

  [[nodiscard]] std::span<const Statistic> statistics() const override { return statistics_; }

  void poison(const Api& gl) override {
    target_.poison(gl);
    if (options_.culling == Culling::none) return;
    for (const CellDraws& each : draws_) each.poison(gl);
  }

  void bind(const Api& gl, Purpose purpose) override {
    if (purpose == Purpose::counters) {
      if (occlusion_) {
        settle(gl);
        poison(gl);
      }
      if (!counting_) {
        ParticleConstants constants = constants_;
        constants.count = true;
        counting_.emplace(Counting{make_programs(gl, constants), ParticleCounters(gl)});
      }
      counting_->counters.start(gl);
    }
    prepare_state(gl);
  }

  void submit(const Api& gl, Purpose purpose) override {
    const bool counting = purpose == Purpose::counters;
    const Programs& programs = counting ? counting_->programs : programs_;
    target_.clear(gl, background_);
    if (occlusion_) occlusion_->start_frame(gl);
    draw(gl, programs, draws_, 0);
    if (occlusion_) {
      occlusion_->find_farthest(gl, target_.depth_texture());
      draw(gl, programs, draws_, 1);
    }
    // The extra work is drawn after the image, when its fragments no longer pass the depth test. It
    // is never counted.
    if (!counting && !extra_.empty()) draw(gl, programs, extra_, 0);
  }

  [[nodiscard]] record::Counts counters(const Api& gl) const override {
    return technique::particle_counts(
        {.culling = options_.culling, .cells = cells_, .particles = particles_},
        counting_->counters.read(gl), read(gl));
  }
  [[nodiscard]] core::Image read(const Api& gl) const override { return target_.read(gl, near_); }
  [[nodiscard]] std::string kernel_hash() const override { return kernel_hash_; }

 private:
  struct Counting {
    Programs programs;
    ParticleCounters counters;
  };

  // Draws a frame from the previous camera, which is not measured. It is needed because occlusion
  // culling in the first measured frame uses the cells that were visible in the frame before it.
  void draw_before(const Api& gl, const measure::ParticleWork& work,
                   const technique::Arrangement& arrangement) {
    if (work.camera_before) data_.upload_camera(gl, work.before(), arrangement);
    prepare_state(gl);
    submit(gl, Purpose::statistics);
    if (work.camera_before) data_.upload_camera(gl, work, arrangement);
  }

  // Draws two frames, after which the set of hidden cells no longer changes. The first frame after
  // a jump of the camera draws everything that is visible. The second frame skips the hidden cells,
  // and all later frames do the same work as the second.
  void settle(const Api& gl) {
    prepare_state(gl);
    for (int frame = 0; frame < 2; ++frame) submit(gl, Purpose::statistics);
  }

  void prepare_state(const Api& gl) const {
    data_.bind(gl);
    target_.bind(gl);
    gl.Enable(GL_PROGRAM_POINT_SIZE);
    if (gl.PatchParameteri != nullptr) gl.PatchParameteri(GL_PATCH_VERTICES, 1);
  }

  [[nodiscard]] Programs make_programs(const Api& gl, const ParticleConstants& constants) const {
    Programs programs;
    const auto program = [&](const std::vector<ParticleStage>& described,
                             const ParticleConstants& with) {
      const std::vector<Stage> stages = particle_stages(gl, with, described);
      for (const Stage& stage : stages) programs.sources.push_back(stage.source);
      return link(gl, stages);
    };
    for (const SpriteDraw& draw : sprites_) {
      Programs::Draw draw_programs;
      // Only the culling passes of the first draw are counted, because the culling passes of the
      // other draws test the same cells.
      ParticleConstants culling = constants;
      culling.count = constants.count && programs.draws.empty();
      for (const int pass : passes_of(options_.culling)) {
        draw_programs.cull[pass == 2 ? 1 : 0] =
            program({cull_stage(draw.instanced, pass)}, culling);
      }
      std::vector<ParticleStage> stages = draw.stages;
      stages.push_back({GL_FRAGMENT_SHADER, {"sphere.frag.glsl"}, {}});
      draw_programs.sprites = program(stages, constants);
      programs.draws.push_back(std::move(draw_programs));
    }
    return programs;
  }

  // `pass` selects the culling program: 0 before the first draw, and 1 for the cells that became
  // visible afterwards.
  void draw(const Api& gl, const Programs& programs, const std::vector<CellDraws>& draws,
            std::size_t pass) const {
    if (options_.culling != Culling::none) {
      const Label label(gl, "cull cells");
      for (std::size_t i = 0; i < draws.size(); ++i) {
        gl.UseProgram(programs.draws[i].cull[pass].get());
        draws[i].cull(gl);
      }
      // The draw that follows reads the commands, and the next culling pass, possibly in the next
      // frame, reads which cells were visible.
      gl.MemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const Label label(gl, "draw sprites");
    for (std::size_t i = 0; i < draws.size(); ++i) {
      gl.UseProgram(programs.draws[i].sprites.get());
      draws[i].draw(gl, sprites_[i].mode);
    }
  }

  technique::ParticleOptions options_;
  std::array<float, 4> background_;
  double near_;
  std::uint64_t particles_;
  std::uint64_t cells_;
  Sprites sprites_;
  std::vector<Statistic> statistics_;
  ParticleConstants constants_;
  ParticleData data_;
  ParticleTarget target_;
  std::string kernel_hash_;
  Programs programs_;
  std::optional<Counting> counting_;
  std::vector<CellDraws> draws_;
  std::vector<CellDraws> extra_;
  std::optional<Occlusion> occlusion_;
};

}  // namespace

ParticleStage attribute_stage() {
  return {GL_VERTEX_SHADER, {"sprite.glsl", "attributes.vert.glsl"}, {}};
}

ParticleStage instance_stage(const Api& gl, std::string_view file) {
  return {GL_VERTEX_SHADER,
          {"storage.glsl", "sprite.glsl", file},
          gl.ARB_shader_draw_parameters != 0
              ? "#define TRI_PARTICLE (gl_BaseInstanceARB + gl_InstanceID)\n"
                "#define TRI_CORNER gl_VertexID\n"
              : "layout(location = 3) in uint particle_number;\n"
                "#define TRI_PARTICLE particle_number\n#define TRI_CORNER gl_VertexID\n"};
}

Sprites tessellated(std::string_view define) {
  const std::string defines = fmt::format("#define TRI_QUAD {:d}\n#define TRI_ADAPTIVE {:d}\n",
                                          int{define == "quad"}, int{define == "adaptive"});
  return {{GL_PATCHES,
           false,
           false,
           {attribute_stage(),
            {GL_TESS_CONTROL_SHADER, {"sprite.glsl", "polygon.tesc.glsl"}, defines},
            {GL_TESS_EVALUATION_SHADER, {"sprite.glsl", "polygon.tese.glsl"}, defines}}}};
}

Sprites from_geometry_stage(bool screen_aligned) {
  return {{GL_POINTS,
           false,
           false,
           {attribute_stage(),
            {GL_GEOMETRY_SHADER,
             {"sprite.glsl", "quad.geom.glsl"},
             fmt::format("#define TRI_SCREEN_ALIGNED {:d}\n", int{screen_aligned})}}}};
}

std::unique_ptr<Drawing> draw_sprites(const Api& gl, const measure::ParticleWork& work,
                                      const Sprites& sprites) {
  return std::make_unique<SpriteDrawing>(gl, work, sprites, technique::arrange(work.scene));
}

}  // namespace triptych::gl_backend
