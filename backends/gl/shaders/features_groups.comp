// Each work group writes its own number plus 1.
layout(local_size_x = 1) in;
layout(std430, binding = 0) writeonly buffer Numbers { uint numbers[]; };

void main() {
  uvec3 n = gl_NumWorkGroups;
  uint group = gl_WorkGroupID.x + n.x * (gl_WorkGroupID.y + n.y * gl_WorkGroupID.z);
  numbers[group] = group + 1u;
}
