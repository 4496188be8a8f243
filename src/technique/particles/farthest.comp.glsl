// Each work group finds the farthest depth in a block of 16×16 pixels. TRI_DEPTH(pixel) is the reversed depth
// of a pixel.
layout(local_size_x = 64) in;
layout(std430) TRI_BINDING(10) writeonly buffer Farthest { uint farthest[]; };

shared uint shared_farthest;

void main() {
  if (gl_LocalInvocationIndex == 0u) shared_farthest = 0xFFFFFFFFu;
  barrier();
  uint own = 0xFFFFFFFFu;
  for (int k = 0; k < 4; ++k) {
    int i = 64 * k + int(gl_LocalInvocationIndex);
    ivec2 pixel = 16 * ivec2(gl_WorkGroupID.xy) + ivec2(i % 16, i / 16);
    if (pixel.x < u.viewport.x && pixel.y < u.viewport.y) own = min(own, floatBitsToUint(TRI_DEPTH(pixel)));
  }
  atomicMin(shared_farthest, own);
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    farthest[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = shared_farthest;
  }
}
