// One work group per cell, when a scene is prepared: what its particles will need at most. From it the host
// divides the cells into rounds and sizes the buffer of entries.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(3) readonly buffer Spheres { vec4 spheres[]; };
struct Need {
  uint pixels;   // of its small spheres' rectangles
  uint entries;  // of its large ones
};
layout(std430) TRI_BINDING(12) buffer Needs { Need needs[]; };  // zero before

void main() {
  uint index = TRI_ROUND.x + gl_WorkGroupID.x;
  Cell cell = cells[index];
  Need need = Need(0u, 0u);
  for (uint i = gl_LocalInvocationIndex; i < cell.count; i += 64u) {
    ivec4 rectangle = pixel_rectangle(camera_space(spheres[cell.begin + i]));
    ivec2 span = (rectangle.xy + rectangle.zw - 1) / TRI_TILE - rectangle.xy / TRI_TILE + 1;
    if (is_small(rectangle)) {
      need.pixels += uint(rectangle.z * rectangle.w);
    } else {
      need.entries += uint(span.x * span.y);
    }
  }
  atomicAdd(needs[index].pixels, need.pixels);
  atomicAdd(needs[index].entries, need.entries);
}
