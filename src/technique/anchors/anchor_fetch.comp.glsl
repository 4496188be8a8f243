// Triptych anchor_fetch, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Trilinear fetches at scattered places, on or half-way between the centres of voxels.
layout(local_size_x = 64) in;
layout(std140) TRI_BINDING(0) uniform Anchor { uvec4 work; vec4 numbers; };  // turns; unused
layout(std430) TRI_BINDING(1) writeonly buffer Results { uint results[]; };
TRI_BINDING(3) uniform sampler3D volume;

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint state = i * 2654435761u + 1u;
  uint sum = 0u;
  for (uint turn = 0u; turn < work.x; ++turn) {
    state = state * 1664525u + 1013904223u;
    uvec3 place = uvec3(state >> 11, state >> 18, state >> 25) & 127u;  // in half voxels
    vec3 at = (vec3(place) * 0.5 + 0.5) * (1.0 / 64.0);
    sum += uint(textureLod(volume, at, 0.0).r * 8.0 + 0.5);
  }
  results[i] = sum;
}
