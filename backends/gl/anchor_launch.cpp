// One invocation per dispatch, many dispatches.
#include "backends/gl/anchor_drawing.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

constexpr std::string_view id = "anchor_launch";

std::optional<std::string> unsupported(const Api& gl, const measure::AnchorWork& work) {
  return anchor_unsupported(gl, id, work);
}

std::unique_ptr<Drawing> make(const Api& gl, const measure::AnchorWork& work) {
  return std::make_unique<AnchorDrawing>(gl, id, work);
}

}  // namespace

AnchorTechnique anchor_launch() {
  return {&unsupported, &make};
}

}  // namespace triptych::gl_backend
