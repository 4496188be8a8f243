#pragma once
// Frames of the particle techniques.

#include <optional>
#include <string>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/particle_programs.hpp"
#include "backends/opencl/particle_stages.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// The image that shading has left on the device. `depths` are reversed; 0 means that there is no
// particle.
struct ShadedImage {
  int width = 0;
  int height = 0;
  double near = 1;
  const cl::Buffer& image;
  const cl::Buffer& ids;
  const cl::Buffer& depths;
};
[[nodiscard]] core::Image read_shaded_image(const Session& session, const ShadedImage& shaded);

class ParticleFrames final : public measure::Prepared {
 public:
  // Compiles the timed build and uploads everything. The counting build, whose kernels also count
  // their work, is compiled when it is first needed. `programs` must outlive this object.
  ParticleFrames(const Session& session, Programs& programs, const measure::ParticleWork& work,
                 Sprite sprite);

  void poison() override { stages_.poison(frame_pass_); }
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return particle_hash(constants_); }

 private:
  void draw_before(const ParticlePrograms& programs, const measure::ParticleWork& work);
  void prepare_counting();
  [[nodiscard]] record::Counts read_counters();

  Session session_;
  Programs& programs_;
  int width_;
  int height_;
  double near_;
  ParticleConstants constants_;
  ParticleStages stages_;
  Pass frame_pass_;
  std::optional<Pass> extra_;  // the injected slowdown
  std::vector<Launch> timed_;
  std::vector<Launch> counting_;
  FrameRun run_;
};

}  // namespace triptych::opencl_backend
