// Triptych anchor_fetch, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Trilinear interpolation by hand at scattered places, on or half-way between the centres of voxels:
// images are optional in OpenCL.
static float anchor_voxel(__global const float* volume, uint x, uint y, uint z) {
  return volume[x + 64u * (y + 64u * z)];
}

__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void anchor_fetch(
    uint4 work, float4 numbers, __global uint* results, __global const float* volume) {  // turns
  uint i = (uint)get_global_id(0);
  uint state = i * 2654435761u + 1u;
  uint sum = 0u;
  for (uint turn = 0u; turn < work.x; ++turn) {
    state = state * 1664525u + 1013904223u;
    float3 at = convert_float3((uint3)(state >> 11, state >> 18, state >> 25) & 127u) * 0.5f;
    uint3 low = convert_uint3(at);
    float3 share = at - convert_float3(low);
    uint3 high = min(low + 1u, 63u);
    float v00 = mix(anchor_voxel(volume, low.x, low.y, low.z),
                    anchor_voxel(volume, high.x, low.y, low.z), share.x);
    float v10 = mix(anchor_voxel(volume, low.x, high.y, low.z),
                    anchor_voxel(volume, high.x, high.y, low.z), share.x);
    float v01 = mix(anchor_voxel(volume, low.x, low.y, high.z),
                    anchor_voxel(volume, high.x, low.y, high.z), share.x);
    float v11 = mix(anchor_voxel(volume, low.x, high.y, high.z),
                    anchor_voxel(volume, high.x, high.y, high.z), share.x);
    float value = mix(mix(v00, v10, share.y), mix(v01, v11, share.y), share.z);
    sum += (uint)(value * 8.0f + 0.5f);
  }
  results[i] = sum;
}
