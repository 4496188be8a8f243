#pragma once
// Frames of the anchors: launches of one kernel over words of a buffer.

#include <optional>
#include <string>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/programs.hpp"
#include "measure/backend.hpp"
#include "technique/anchors/anchor_work.hpp"

namespace triptych::opencl_backend {

// Why this device cannot do this anchor at this size.
[[nodiscard]] std::optional<std::string> anchor_defect(const Session& session,
                                                       const std::string& technique,
                                                       const measure::AnchorWork& work);

class AnchorFrames final : public measure::Prepared {
 public:
  // The kernel TECHNIQUE of TECHNIQUE.cl.
  AnchorFrames(const Session& session, Programs& programs, const std::string& technique,
               const measure::AnchorWork& work);

  // Many launches have no device time: what they cost lies between the times of their events, where
  // a device may run behind the host or along with it. A frame that counts begins with cleared
  // results, so that what is summed was made by it.
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override { return {}; }
  [[nodiscard]] std::string kernel_hash() const override { return hash_; }

 private:
  [[nodiscard]] cl::Buffer make_input() const;
  [[nodiscard]] Launch launch(const cl::Program& program, const std::string& technique) const;

  Session session_;
  technique::AnchorFrame shape_;
  std::string hash_;
  cl::Buffer results_;
  cl::Buffer input_;  // stream or volume; null where there is none
  std::vector<Launch> launches_;
  std::vector<cl::Event> events_;
};

}  // namespace triptych::opencl_backend
