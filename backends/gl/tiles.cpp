// Sorts spheres into tiles in compute shaders, and shades the nearest hit of each pixel once
// (technique/particles/tiles.glsl describes the passes).
#include <fmt/format.h>

#include <array>

#include "backends/gl/particle_data.hpp"
#include "backends/gl/particle_limits.hpp"
#include "backends/gl/particle_source.hpp"
#include "backends/gl/particle_target.hpp"
#include "backends/gl/prepared.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/tile_buffers.hpp"
#include "core/error.hpp"
#include "technique/particles/particle_counts.hpp"
#include "technique/particles/tile_rounds.hpp"

namespace triptych::gl_backend {
namespace {

using measure::Purpose;
using technique::Culling;

constexpr GLuint tile_group_size = 64;
constexpr std::array<std::string_view, 7> passes{"cells",   "bin",    "place", "fill",
                                                 "resolve", "settle", "index"};
enum TilePass : std::size_t { cells, bin, place, fill, resolve, settle, index };

struct Programs {
  std::array<Program, passes.size()> by_pass;
  Program show;
  std::vector<std::string> sources;
};

// GL numbers image units separately from texture units and storage blocks, and there are only a few
// image units. Therefore TRI_LARGE_PIXELS is 0.
std::string tile_defines(Culling culling, int spheres) {
  return fmt::format("#define TRI_SPHERES {}\n#define TRI_CULLING {}\n#define TRI_LARGE_PIXELS 0\n",
                     spheres, static_cast<int>(culling));
}

Programs make_programs(const Api& gl, const ParticleConstants& constants, Culling culling,
                       int spheres) {
  Programs programs;
  const auto program = [&](const std::vector<ParticleStage>& described,
                           const ParticleConstants& with) {
    const std::vector<Stage> stages = particle_stages(gl, with, described);
    for (const Stage& stage : stages) programs.sources.push_back(stage.source);
    return link(gl, stages);
  };
  const std::string defines = tile_defines(culling, spheres);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    std::vector<std::string_view> files{"sprite.glsl"};
    if (i == cells || i == bin) files.emplace_back("cells.glsl");
    const std::string main_file = fmt::format("tiles_{}.comp.glsl", passes[i]);
    files.insert(files.end(), {"keys.glsl", "tile_grid.glsl", "tiles.glsl", main_file});
    programs.by_pass[i] =
        program({{GL_COMPUTE_SHADER, files,
                  defines + "#define TRI_ROUND round_cells\nuniform uvec2 round_cells;\n"}},
                constants);
  }
  ParticleConstants showing = constants;
  showing.count = false;
  programs.show =
      program({{GL_VERTEX_SHADER,
                {"keys.glsl", "tile_grid.glsl", "tiles_show.vert.glsl"},
                defines + "#define TRI_INSTANCE gl_InstanceID\n#define TRI_CORNER gl_VertexID\n"},
               {GL_FRAGMENT_SHADER,
                {"keys.glsl", "tile_grid.glsl", "storage.glsl", "tiles_show.frag.glsl"},
                defines}},
              showing);
  return programs;
}

class TilesDrawing final : public Drawing {
 public:
  TilesDrawing(const Api& gl, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement)
      : options_(work.options),
        near_(work.scene.camera.near),
        background_(work.scene.background),
        particles_(arrangement.count()),
        constants_(particle_constants(work)),
        rounds_(rounds_of(gl, work.scene, arrangement)),
        data_(gl, work, arrangement),
        buffers_(gl, work.scene, arrangement, rounds_, data_, options_.extra_work_stride),
        target_(gl, work.scene.width, work.scene.height, options_.fault),
        cells_(arrangement.cells.size()),
        programs_(make_programs(gl, constants_, options_.culling, rounds_.spheres())) {
    kernel_hash_ = hash_of(gl, programs_.sources);
  }

  [[nodiscard]] std::span<const Statistic> statistics() const override {
    static constexpr std::array<Statistic, 1> wanted{
        {{GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"}}};
    return wanted;
  }

  void poison(const Api& gl) override {
    target_.poison(gl);
    buffers_.poison(gl);
  }

  void bind(const Api& gl, Purpose purpose) override {
    if (purpose == Purpose::counters) {
      if (!counting_) {
        ParticleConstants constants = constants_;
        constants.count = true;
        counting_.emplace(
            Counting{make_programs(gl, constants, options_.culling, rounds_.spheres()),
                     ParticleCounters(gl)});
      }
      counting_->counters.start(gl);
    }
    data_.bind(gl);
    buffers_.bind(gl);
    target_.bind(gl);
  }

  void submit(const Api& gl, Purpose purpose) override {
    const bool counting = purpose == Purpose::counters;
    const Programs& programs = counting ? counting_->programs : programs_;
    draw_depths(gl, programs, !counting && options_.extra_work_stride != 0);
    if (rounds_.small) run(gl, programs, index, technique::list_groups(particles_));
    target_.clear(gl, background_);
    gl.UseProgram(programs.show.get());
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(buffers_.blocks()));
  }

  [[nodiscard]] record::Counts counters(const Api& gl) const override {
    return technique::particle_counts({.method = technique::Method::tiles,
                                       .culling = options_.culling,
                                       .cells = cells_,
                                       .particles = particles_},
                                      counting_->counters.read(gl), read(gl));
  }
  [[nodiscard]] core::Image read(const Api& gl) const override { return target_.read(gl, near_); }
  [[nodiscard]] std::string kernel_hash() const override { return kernel_hash_; }

 private:
  struct Counting {
    Programs programs;
    ParticleCounters counters;
  };

  static technique::TileRounds rounds_of(const Api& gl, const scene::ParticleScene& scene,
                                         const technique::Arrangement& arrangement) {
    technique::TileRounds rounds = technique::tile_rounds(
        scene, arrangement,
        static_cast<std::uint32_t>(gl.limit(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0)),
        TileBuffers::wanted_entries);
    if (const auto reason = technique::passes_reason(rounds)) throw core::NotSupported(*reason);
    return rounds;
  }

  // Later passes read the results as texels, as images or from storage buffers.
  static void finish(const Api& gl) {
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                     GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  static void run(const Api& gl, const Programs& programs, TilePass pass, GLuint groups) {
    const Label label(gl, passes[pass]);
    gl.UseProgram(programs.by_pass[pass].get());
    gl.DispatchCompute(groups, 1, 1);
    finish(gl);
  }

  static void run_on(const Api& gl, const Programs& programs, TilePass pass,
                     const technique::TileRound& round, GLuint groups) {
    const Label label(gl, passes[pass]);
    const GLuint program = programs.by_pass[pass].get();
    gl.UseProgram(program);
    gl.Uniform2ui(gl.GetUniformLocation(program, "round_cells"), round.first, round.cells);
    gl.DispatchCompute(groups, 1, 1);
    finish(gl);
  }

  static void bin_cells(const Api& gl, const Programs& programs,
                        const technique::TileRound& round) {
    run_on(gl, programs, cells, round, (round.cells + tile_group_size - 1) / tile_group_size);
    run_on(gl, programs, bin, round, round.cells);
  }

  // Computes the depth of every pixel. Each round processes a range of the cells, which are ranges
  // of neighbouring particles. The injected extra work sorts a part of each round's particles into
  // tiles a second time. It does so before the tiles are resolved (drawn), because afterwards the
  // tiles would reject these particles as hidden.
  void draw_depths(const Api& gl, const Programs& programs, bool extra) const {
    buffers_.clear(gl);
    for (const technique::TileRound& round : rounds_.rounds) {
      buffers_.start_round(gl);
      bin_cells(gl, programs, round);
      if (extra) {
        buffers_.choose(gl, TileBuffers::Cells::thinned);
        bin_cells(gl, programs, round);
        buffers_.choose(gl, TileBuffers::Cells::all);
      }
      const bool last = &round == &rounds_.rounds.back();
      if (!last || round.entries > 0) resolve_tiles(gl, programs, round);
      if (!last) run(gl, programs, settle, buffers_.groups_for_tiles());
    }
  }

  // Draws the round's large spheres, unless the final pass draws them, and computes the farthest
  // depth of each tile.
  void resolve_tiles(const Api& gl, const Programs& programs,
                     const technique::TileRound& round) const {
    run(gl, programs, place, buffers_.groups_for_tiles());
    if (round.entries > 0) run(gl, programs, fill, technique::list_groups(particles_));
    if (rounds_.at_once) return;
    gl.UseProgram(programs.by_pass[resolve].get());
    buffers_.dispatch_listed(gl);
    finish(gl);
  }

  technique::ParticleOptions options_;
  double near_;
  std::array<float, 4> background_;
  std::uint64_t particles_;
  ParticleConstants constants_;
  technique::TileRounds rounds_;
  ParticleData data_;
  TileBuffers buffers_;
  ParticleTarget target_;
  std::uint64_t cells_;
  Programs programs_;
  std::string kernel_hash_;
  std::optional<Counting> counting_;
};

std::optional<std::string> tiles_unsupported(const Api& gl, const measure::ParticleWork& work) {
  if (auto reason = particles_unsupported(gl, work, true)) return reason;
  return TileBuffers::unsupported(gl, work.scene);
}

std::unique_ptr<Drawing> make(const Api& gl, const measure::ParticleWork& work) {
  return std::make_unique<TilesDrawing>(gl, work, technique::arrange(work.scene));
}

}  // namespace

ParticleTechnique tiles() {
  return {&tiles_unsupported, &make};
}

}  // namespace triptych::gl_backend
