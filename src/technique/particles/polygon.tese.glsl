layout(quads, equal_spacing, ccw) in;

TRI_LINK(0) in vec4 patch_sphere[];
TRI_LINK(1) in vec4 patch_colour[];
TRI_LINK(2) flat in uint patch_id[];
TRI_LINK(4) patch in int patch_corners;

TRI_LINK(0) flat out vec4 sprite_sphere;
TRI_LINK(1) flat out vec4 sprite_colour;
TRI_LINK(2) flat out uint sprite_id;
TRI_LINK(3) out vec3 sprite_ray;

// Returns the index, from 0 to n − 1, of a vertex on the outline of the tessellated quad, counting along the outline
// from (0, 0). polygon.tesc.glsl divides edge e (0: u = 0, 1: v = 0, 2: u = 1, 3: v = 1) into ⌊(n + e)/4⌋ parts.
int outline_index(vec2 place, int n) {
  int parts0 = n / 4;
  int parts1 = (n + 1) / 4;
  int parts2 = (n + 2) / 4;
  int parts3 = (n + 3) / 4;
  if (place.y <= 0.0) return int(place.x * float(parts1) + 0.5);
  if (place.x >= 1.0) return parts1 + int(place.y * float(parts2) + 0.5);
  if (place.y >= 1.0) return parts1 + parts2 + int((1.0 - place.x) * float(parts3) + 0.5);
  return (parts1 + parts2 + parts3 + int((1.0 - place.y) * float(parts0) + 0.5)) % n;
}

void main() {
  Frame frame = sprite_frame(patch_sphere[0]);
  vec2 place = gl_TessCoord.xy;
#if TRI_QUAD
  Corner corner = quad_corner(frame, 2.0 * place - 1.0);
#else
  bool inside = place.x > 0.0 && place.x < 1.0 && place.y > 0.0 && place.y < 1.0;
  Corner corner = polygon_centre(frame);
  if (!inside) corner = polygon_corner(frame, outline_index(place, patch_corners), patch_corners);
#endif
  sprite_sphere = patch_sphere[0];
  sprite_colour = patch_colour[0];
  sprite_id = patch_id[0];
  sprite_ray = corner.ray;
  gl_Position = corner.position;
}
