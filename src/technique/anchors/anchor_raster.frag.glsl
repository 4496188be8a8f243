// Triptych anchor_raster, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// One step of a byte, to be added to the target.
layout(location = 0) out vec4 colour;

void main() {
  colour = vec4(1.0 / 255.0);
}
