// Chains of multiply-adds in registers.
#include "backends/gl/anchor_drawing.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

constexpr std::string_view id = "anchor_arithmetic";

std::optional<std::string> unsupported(const Api& gl, const measure::AnchorWork& work) {
  return anchor_unsupported(gl, id, work);
}

std::unique_ptr<Drawing> make(const Api& gl, const measure::AnchorWork& work) {
  return std::make_unique<AnchorDrawing>(gl, id, work);
}

}  // namespace

AnchorTechnique anchor_arithmetic() {
  return {&unsupported, &make};
}

}  // namespace triptych::gl_backend
