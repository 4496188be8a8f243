// Traces rays through a hierarchy of bounding boxes. Kernels build and traverse it
// (particle_hierarchy.cl, particle_rays.cl).
#include <array>
#include <string_view>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/particle_data.hpp"
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/particle_programs.hpp"
#include "backends/opencl/techniques.hpp"
#include "measure/contract/not_drawn.hpp"
#include "technique/particles/hierarchy.hpp"
#include "technique/particles/particle_counts.hpp"

namespace triptych::opencl_backend {
namespace {

using technique::Structure;

constexpr std::size_t ray_group = 64;

cl_uint4 vector_of(const std::array<std::uint32_t, 4>& v) {
  return {{v[0], v[1], v[2], v[3]}};
}
cl_float4 vector_of(const std::array<float, 4>& v) {
  return {{v[0], v[1], v[2], v[3]}};
}

technique::Hierarchy hierarchy_of(const measure::ParticleWork& work) {
  return technique::Hierarchy(technique::arrange(work.scene));
}

ParticleConstants traced_constants(const measure::ParticleWork& work) {
  ParticleConstants constants = constants_of(work, Sprite::rectangle);
  constants.traced = true;
  return constants;
}

std::size_t traced_tiles(const scene::ParticleScene& scene) {
  const auto tiles = [](int pixels) {
    return (static_cast<std::size_t>(pixels) + tile_edge - 1) / tile_edge;
  };
  return tiles(scene.width) * tiles(scene.height);
}

class BvhFrames final : public measure::Prepared {
 public:
  BvhFrames(const Session& session, Programs& programs, const measure::ParticleWork& work);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return ray_hash(constants_); }

 private:
  [[nodiscard]] cl::Buffer words(std::size_t count) const {
    return make_buffer(session_, CL_MEM_READ_WRITE,
                       std::max<std::size_t>(count, 4) * sizeof(cl_uint));
  }
  void add_sort(const RayPrograms& programs, std::vector<Launch>& to) const;
  void add_fit(const RayPrograms& programs, bool moved, std::vector<Launch>& to) const;
  [[nodiscard]] Launch trace(const RayPrograms& programs, cl_uint stride) const;
  [[nodiscard]] std::vector<Launch> frame_launches(const RayPrograms& programs,
                                                   cl_uint extra_stride) const;
  [[nodiscard]] record::Counts read_counters();

  Session session_;
  Programs& programs_;
  technique::ParticleOptions options_;
  int width_;
  int height_;
  double near_;
  ParticleConstants constants_;
  technique::Hierarchy hierarchy_;
  ParticleData data_;
  std::size_t pixels_;
  std::size_t tiles_;
  cl::Buffer boxes_;
  cl::Buffer tree_spheres_;
  cl::Buffer tree_order_;
  cl::Buffer sorted_;
  cl::Buffer scratch_;
  cl::Buffer depths_;  // reversed depths; 0 where there is no particle
  cl::Buffer winners_;
  cl::Buffer image_;
  cl::Buffer ids_;
  cl::Buffer unused_;
  cl::Buffer counters_;  // one row of 8 counters per tile
  std::vector<Launch> timed_;
  std::vector<Launch> counting_;
  FrameRun run_;
};

BvhFrames::BvhFrames(const Session& session, Programs& programs, const measure::ParticleWork& work)
    : session_(session),
      programs_(programs),
      options_(work.options),
      width_(work.scene.width),
      height_(work.scene.height),
      near_(work.scene.camera.near),
      constants_(traced_constants(work)),
      hierarchy_(hierarchy_of(work)),
      data_(upload(session, work)),
      pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
      tiles_(traced_tiles(work.scene)) {
  checked([&] {
    boxes_ = words(hierarchy_.box_words());
    tree_spheres_ = words(hierarchy_.sphere_words());
    tree_order_ = words(hierarchy_.order_words());
    sorted_ = words(hierarchy_.sorted_words());
    scratch_ = words(hierarchy_.scratch_words());
    depths_ = words(pixels_);
    winners_ = words(pixels_);
    image_ = words(4 * pixels_);
    ids_ = words(pixels_);
    unused_ = words(0);
    counters_ = words(8 * tiles_);
    const RayPrograms timed = ray_programs(programs_, constants_);
    std::vector<Launch> build;
    add_sort(timed, build);
    add_fit(timed, false, build);
    if (session_.queue.executes()) run_checked(session_, build);
    timed_ = frame_launches(timed, static_cast<cl_uint>(options_.extra_work_stride));
  });
}

void BvhFrames::add_sort(const RayPrograms& programs, std::vector<Launch>& to) const {
  const std::size_t count = hierarchy_.particles();
  const cl_uint4 shape = vector_of(hierarchy_.parameters().shape);
  const cl_uint runs = hierarchy_.runs();
  const cl::NDRange one(1);
  to.push_back(make_launch(programs.rays, "find_places",
                           cl::NDRange(round_up(std::max<std::size_t>(count, 1), ray_group)),
                           cl::NDRange(ray_group), vector_of(hierarchy_.parameters().origin), shape,
                           data_.spheres, sorted_));
  for (const technique::SortPass& pass : technique::sort_passes(hierarchy_)) {
    to.push_back(make_launch(programs.rays, "count_digits", cl::NDRange(runs), one, shape,
                             cl_uint{pass.shift}, cl_uint{pass.from}, sorted_, scratch_));
    to.push_back(make_launch(programs.rays, "place_digits", one, one, runs, scratch_));
    to.push_back(make_launch(programs.rays, "move_to_places", cl::NDRange(runs), one, shape,
                             cl_uint{pass.shift}, cl_uint{pass.from}, sorted_, scratch_));
  }
}

void BvhFrames::add_fit(const RayPrograms& programs, bool moved, std::vector<Launch>& to) const {
  const std::size_t leaves = hierarchy_.leaves();
  to.push_back(make_launch(programs.rays, "fit_leaves", cl::NDRange(round_up(leaves, ray_group)),
                           cl::NDRange(ray_group), vector_of(hierarchy_.parameters().shape),
                           cl_uint{moved ? 1U : 0U}, data_.spheres, sorted_, boxes_, tree_spheres_,
                           tree_order_));
  for (std::size_t nodes = leaves / 2; nodes > 0; nodes /= 2) {
    to.push_back(make_launch(programs.rays, "fit_level", cl::NDRange(round_up(nodes, ray_group)),
                             cl::NDRange(ray_group), static_cast<cl_uint>(nodes), boxes_));
  }
}

// Traces every stride-th tile.
Launch BvhFrames::trace(const RayPrograms& programs, cl_uint stride) const {
  return make_launch(programs.rays, "trace_tiles", cl::NDRange((tiles_ + stride - 1) / stride),
                     cl::NDRange(1), data_.parameters, vector_of(hierarchy_.parameters().shape),
                     stride, boxes_, tree_spheres_, tree_order_, depths_, winners_, counters_);
}

// `extra_stride` is the stride of the injected extra work, or 0 if there is none.
std::vector<Launch> BvhFrames::frame_launches(const RayPrograms& programs,
                                              cl_uint extra_stride) const {
  std::vector<Launch> launches;
  if (options_.structure == Structure::rebuilt) add_sort(programs, launches);
  if (options_.structure != Structure::built_once) {
    add_fit(programs, options_.structure == Structure::refitted, launches);
  }
  launches.push_back(trace(programs, 1));
  if (extra_stride > 0) launches.push_back(trace(programs, extra_stride));
  launches.push_back(make_launch(programs.shading, "shade",
                                 cl::NDRange(static_cast<std::size_t>(height_)), cl::NDRange(1),
                                 data_.parameters, data_.spheres, data_.ids, data_.colours,
                                 data_.table, unused_, winners_, unused_, image_, ids_));
  return launches;
}

void BvhFrames::poison() {
  for (const cl::Buffer* each : {&image_, &ids_, &depths_, &winners_}) {
    fill_buffer(session_, *each, measure::poison_word,
                checked([&] { return each->getInfo<CL_MEM_SIZE>(); }));
  }
}

measure::Frame BvhFrames::frame(measure::Purpose purpose) {
  return checked([&] {
    const bool counts = purpose == measure::Purpose::counters;
    if (counts) {
      ParticleConstants constants = constants_;
      constants.count = true;
      if (counting_.empty()) counting_ = frame_launches(ray_programs(programs_, constants), 0);
      fill_buffer(session_, counters_, 0, 8 * tiles_ * sizeof(cl_uint));
    }
    measure::Frame frame = run_.draw(session_, counts ? counting_ : timed_, purpose);
    if (counts) frame.counts = read_counters();
    return frame;
  });
}

record::Counts BvhFrames::read_counters() {
  run_.check();
  std::vector<cl_uint> rows(8 * tiles_);
  read_buffer(session_, counters_, rows.size() * sizeof(cl_uint), rows.data());
  return technique::particle_counts({.method = technique::Method::rays}, rows, image());
}

core::Image BvhFrames::image() {
  run_.check();
  return read_shaded_image(session_, {.width = width_,
                                      .height = height_,
                                      .near = near_,
                                      .image = image_,
                                      .ids = ids_,
                                      .depths = depths_});
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_bvh(const Session& session, Programs& programs,
                                               const measure::ParticleWork& work) {
  return std::make_unique<BvhFrames>(session, programs, work);
}

}  // namespace triptych::opencl_backend
