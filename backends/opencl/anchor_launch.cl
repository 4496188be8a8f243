// Triptych anchor_launch, version 1. FROZEN: never changed; see technique/anchors/shape.hpp.
// As little as a launch can do and leave a trace.
__kernel __attribute__((reqd_work_group_size(1, 1, 1))) void anchor_launch(
    uint4 work, float4 numbers, __global uint* launches) {
  atomic_inc(launches);
}
