#version 450
#extension GL_KHR_shader_subgroup_arithmetic : require
// Writes the subgroup of each invocation, and the sum of the invocation numbers in that subgroup.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) writeonly buffer Sums { uvec2 sums[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  sums[i] = uvec2(gl_SubgroupID, subgroupAdd(i + 1u));
}
