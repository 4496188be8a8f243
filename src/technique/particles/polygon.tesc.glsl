// One particle per patch. TRI_ADAPTIVE: 1 if the number of corners depends on the projected radius, 0 if it is
// a parameter. TRI_QUAD: 1 for a square without a centre vertex, which consists of the two triangles of an
// undivided quad; otherwise 0.
layout(vertices = 1) out;

TRI_LINK(0) in vec4 particle_sphere[];
TRI_LINK(1) in vec4 particle_colour[];
TRI_LINK(2) flat in uint particle_id[];

TRI_LINK(0) out vec4 patch_sphere[];
TRI_LINK(1) out vec4 patch_colour[];
TRI_LINK(2) flat out uint patch_id[];
TRI_LINK(4) patch out int patch_corners;

void main() {
  patch_sphere[gl_InvocationID] = particle_sphere[0];
  patch_colour[gl_InvocationID] = particle_colour[0];
  patch_id[gl_InvocationID] = particle_id[0];
#if TRI_QUAD
  int corners = 4;
#elif TRI_ADAPTIVE
  int corners = corners_of(particle_sphere[0]);
#else
  int corners = u.viewport.z;
#endif
  patch_corners = corners;
#if TRI_COUNT
  add_count(TRI_COUNT_SPRITES, particle_id[0], 1u);
  add_count(TRI_COUNT_VERTICES, particle_id[0], uint(corners));
#endif
#if TRI_QUAD
  gl_TessLevelOuter = float[4](1.0, 1.0, 1.0, 1.0);
  gl_TessLevelInner = float[2](1.0, 1.0);
#else
  // The outline of an n-gon is the outline of a quad patch whose four edges are divided into n parts in total.
  // An inner level of 2 adds one vertex in the middle.
  for (int edge = 0; edge < 4; ++edge) gl_TessLevelOuter[edge] = float((corners + edge) / 4);
  gl_TessLevelInner = float[2](2.0, 2.0);
#endif
}
