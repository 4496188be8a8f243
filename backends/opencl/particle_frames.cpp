#include "backends/opencl/particle_frames.hpp"

#include <array>
#include <limits>

#include "technique/particles/particle_counts.hpp"

namespace triptych::opencl_backend {
namespace {

// The names of the kernels' counters (particles.cl), in the same order.
constexpr std::array<std::string_view, 7> counter_names{"sprites",     "vertices",
                                                        "fragments",   "fragments_discarded",
                                                        "bin_entries", "particles_submitted",
                                                        "cells_culled"};

}  // namespace

ParticleFrames::ParticleFrames(const Session& session, Programs& programs,
                               const measure::ParticleWork& work, Sprite sprite)
    : session_(session),
      programs_(programs),
      width_(work.scene.width),
      height_(work.scene.height),
      near_(work.scene.camera.near),
      constants_(constants_of(work, sprite)),
      stages_(session, upload(session, work), work, constants_) {
  const ParticlePrograms timed = particle_programs(programs_, constants_);
  checked([&] {
    frame_pass_ = stages_.make_pass(timed, 1);
    timed_ = stages_.frame_launches(timed, frame_pass_);
    if (const int stride = work.options.extra_work_stride; stride > 0) {
      extra_ = stages_.make_pass(timed, static_cast<cl_uint>(stride));
      const std::vector<Launch> extra = stages_.extra_launches(timed, *extra_);
      timed_.insert(timed_.end(), extra.begin(), extra.end());
    }
    if (work.camera_before && session.queue.executes()) draw_before(timed, work);
  });
}

// Draws a frame from the previous camera. Creates a separate Pass for this frame, because more
// cells (ranges of neighbouring particles) may be visible from that camera than from the current
// one.
void ParticleFrames::draw_before(const ParticlePrograms& programs,
                                 const measure::ParticleWork& work) {
  upload_camera(session_, stages_.data(), work.before());
  const Pass earlier = stages_.make_pass(programs, 1);
  run_checked(session_, stages_.frame_launches(programs, earlier));
  upload_camera(session_, stages_.data(), work);
}

measure::Frame ParticleFrames::frame(measure::Purpose purpose) {
  return checked([&] {
    const bool counts = purpose == measure::Purpose::counters;
    if (counts) prepare_counting();
    measure::Frame frame = run_.draw(session_, counts ? counting_ : timed_, purpose);
    if (counts) frame.counts = read_counters();
    return frame;  // OpenCL has no pipeline statistics, so none are reported
  });
}

// Resets the set of hidden cells, which depends on the previous frame, and draws one frame. The
// frame that is counted is then the second frame, which skips the same cells as all later frames.
void ParticleFrames::prepare_counting() {
  if (counting_.empty()) {
    ParticleConstants constants = constants_;
    constants.count = true;
    counting_ = stages_.frame_launches(particle_programs(programs_, constants), frame_pass_);
  }
  stages_.mark_all_visible();
  run_checked(session_, timed_);
  poison();
  fill_buffer(session_, stages_.counters(), 0,
              particle_counter_stride * stages_.counter_rows() * sizeof(cl_uint));
}

record::Counts ParticleFrames::read_counters() {
  run_.check();
  std::vector<cl_uint> rows(particle_counter_stride * stages_.counter_rows());
  read_buffer(session_, stages_.counters(), rows.size() * sizeof(cl_uint), rows.data());
  record::Counts counts;
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const std::size_t which = at % particle_counter_stride;
    if (which < counter_names.size()) counts[std::string(counter_names.at(which))] += rows[at];
  }
  counts["cells"] = stages_.data().cell_count;
  counts["particles_culled"] = stages_.data().count - counts["particles_submitted"];
  counts["fragments_kept"] = counts["fragments"] - counts["fragments_discarded"];
  counts["visible_ids"] = technique::visible_ids(image());
  return counts;
}

core::Image ParticleFrames::image() {
  run_.check();
  return read_shaded_image(session_, {.width = width_,
                                      .height = height_,
                                      .near = near_,
                                      .image = stages_.image(),
                                      .ids = stages_.ids(),
                                      .depths = frame_pass_.depths});
}

core::Image read_shaded_image(const Session& session, const ShadedImage& shaded) {
  core::Image image(shaded.width, shaded.height);
  image.ids.resize(image.pixel_count());
  image.depth.resize(image.pixel_count());
  const auto read = [&](const cl::Buffer& from, auto& to) {
    read_buffer(session, from, to.size() * sizeof to[0], to.data());
  };
  read(shaded.image, image.rgba);
  read(shaded.ids, image.ids);
  read(shaded.depths, image.depth);
  for (float& z : image.depth) {
    z = z > 0 ? static_cast<float>(shaded.near / static_cast<double>(z))
              : std::numeric_limits<float>::infinity();
  }
  return image;
}

}  // namespace triptych::opencl_backend
