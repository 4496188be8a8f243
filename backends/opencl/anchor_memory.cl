// Triptych anchor_memory, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// Reads one stream and writes another, 16 KiB to a work-group, sixteen bytes at a time.
__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void anchor_memory(
    uint4 work, float4 numbers, __global uint4* results, __global const uint4* source) {  // key
  uint at = (uint)get_group_id(0) * 1024u + (uint)get_local_id(0);
  for (uint turn = 0u; turn < 16u; ++turn) {
    results[at] = source[at] ^ work.x;
    at += 64u;
  }
}
