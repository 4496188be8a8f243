// One stream of storage read, another written.
#include "backends/opencl/anchor_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_anchor_memory(const Session& session, Programs& programs,
                                                         const measure::AnchorWork& work) {
  return std::make_unique<AnchorFrames>(session, programs, "anchor_memory", work);
}

}  // namespace triptych::opencl_backend
