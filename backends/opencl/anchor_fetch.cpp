// Trilinear interpolation by hand from a small volume of floats.
#include "backends/opencl/anchor_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_anchor_fetch(const Session& session, Programs& programs,
                                                        const measure::AnchorWork& work) {
  return std::make_unique<AnchorFrames>(session, programs, "anchor_fetch", work);
}

}  // namespace triptych::opencl_backend
