// Each invocation generates the quad of one sprite, perpendicular to the ray through the sphere's centre, as
// quad.geom.glsl does.
layout(local_size_x = 32) in;
layout(triangles, max_vertices = 128, max_primitives = 64) out;
taskPayloadSharedEXT CellList list;

TRI_LINK(0) flat out vec4 sprite_sphere[];
TRI_LINK(1) flat out vec4 sprite_colour[];
TRI_LINK(2) flat out uint sprite_id[];
TRI_LINK(3) out vec3 sprite_ray[];

void main() {
  uint group = gl_WorkGroupID.x;
  uint cell = 0u;
  while (cell < 31u && group >= list.end[cell]) ++cell;
  uint first = TRI_MESH_SPRITES * (group - (cell > 0u ? list.end[cell - 1u] : 0u));
  uint sprites = min(list.count[cell] - first, TRI_MESH_SPRITES);
  SetMeshOutputsEXT(4u * sprites, 2u * sprites);
  uint n = gl_LocalInvocationIndex;
  if (n >= sprites) return;
  uint particle = list.begin[cell] + first + n;
  vec4 sphere = camera_space(spheres[particle]);
  vec4 colour = colour_at_vertex(stored_colour(particle));
  Frame frame = sprite_frame(sphere);
  for (uint k = 0u; k < 4u; ++k) {
    Corner corner = quad_corner(frame, vec2(k & 1u, k >> 1) * 2.0 - 1.0);
    uint vertex = 4u * n + k;
    gl_MeshVerticesEXT[vertex].gl_Position = corner.position;
    sprite_sphere[vertex] = sphere;
    sprite_colour[vertex] = colour;
    sprite_id[vertex] = ids[particle];
    sprite_ray[vertex] = corner.ray;
  }
  gl_PrimitiveTriangleIndicesEXT[2u * n] = uvec3(4u * n, 4u * n + 1u, 4u * n + 2u);
  gl_PrimitiveTriangleIndicesEXT[2u * n + 1u] = uvec3(4u * n + 2u, 4u * n + 1u, 4u * n + 3u);
#if TRI_COUNT
  add_count(TRI_COUNT_SPRITES, particle, 1u);
  add_count(TRI_COUNT_VERTICES, particle, 4u);
#endif
}
