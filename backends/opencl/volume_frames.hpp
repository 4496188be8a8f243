#pragma once
// Frames of the volume techniques, which run one kernel for all pixels.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "backends/opencl/volume_data.hpp"
#include "backends/opencl/volume_parts.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/pixel_history.hpp"

namespace triptych::opencl_backend {

// Returns the constants for the program that is used for timing, which counts nothing.
[[nodiscard]] Constants constants_of(const Session& session, const measure::VolumeWork& work);

class VolumeFrames final : public measure::Prepared, public measure::PixelTracer {
 public:
  // Compiles the program twice, for timing and for counting its work, and uploads all data.
  VolumeFrames(const Session& session, Programs& programs, VolumeCache& volumes,
               const measure::VolumeWork& work, Constants constants);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return hash_; }
  [[nodiscard]] technique::RayTrace trace(int x, int y) override;

 private:
  void upload_surroundings(const measure::VolumeWork& work, const Constants& constants,
                           std::span<const std::int32_t> map);
  [[nodiscard]] Launch launch(const cl::Program& program, int columns) const;
  [[nodiscard]] record::Counts read_counters();

  Session session_;
  Programs& programs_;
  Constants constants_;  // for the program that is used for timing
  int width_;
  int height_;
  std::string hash_;
  cl::Buffer parameters_;
  cl::Memory volume_;
  cl::Buffer table_;
  cl::Buffer bricks_;
  cl::Buffer quadrature_;
  cl::Buffer image_;
  cl::Buffer counters_;
  cl::Buffer pauses_;                 // states that rays keep from one part to the next
  std::optional<VolumeParts> parts_;  // set if the volume does not fit on the device as a whole
  std::vector<Launch> timed_;         // one launch, with the injected extra work if there is any
  std::vector<Launch> counting_;      // one launch, without the injected extra work
  FrameRun run_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace triptych::opencl_backend
