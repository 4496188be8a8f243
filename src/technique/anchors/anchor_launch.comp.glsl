// Triptych anchor_launch, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// As little as a launch can do and leave a trace.
layout(local_size_x = 1) in;
layout(std430) TRI_BINDING(1) buffer Results { uint launches; };

void main() {
  atomicAdd(launches, 1u);
}
