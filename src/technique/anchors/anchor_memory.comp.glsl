// Triptych anchor_memory, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Reads one stream and writes another, 16 KiB to a work-group, sixteen bytes at a time.
layout(local_size_x = 64) in;
layout(std140) TRI_BINDING(0) uniform Anchor { uvec4 work; vec4 numbers; };  // key; unused
layout(std430) TRI_BINDING(1) writeonly buffer Results { uvec4 results[]; };
layout(std430) TRI_BINDING(2) readonly buffer Source { uvec4 source[]; };

void main() {
  uint at = gl_WorkGroupID.x * 1024u + gl_LocalInvocationID.x;
  for (uint turn = 0u; turn < 16u; ++turn) {
    results[at] = source[at] ^ work.x;
    at += 64u;
  }
}
