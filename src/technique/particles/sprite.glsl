// Computes the sprites of all techniques: a coordinate frame at a sphere's centre, and the corners of the sprite in
// clip space. Depth is reversed with an infinite far plane: clip z is `near` everywhere, so that
// z/w = near/distance, and nothing visible is closer than `near`. Rows are counted from the top as in Vulkan, so clip y
// points down.

struct Corner {
  vec4 position;  // in clip space
  vec3 ray;       // a point on the ray through the corner, in camera space
};

Corner corner_at(vec3 place) {
  return Corner(vec4(place.x / u.plane.x, -place.y / u.plane.y, u.eye.w, place.z), place);
}

// Returns the corner `side` (±1, ±1) of a rectangle on the image plane, at the depth of a surface at this distance.
Corner corner_on_image(vec2 low, vec2 high, vec2 side, float distance) {
  vec2 place = mix(low, high, 0.5 * side + 0.5);
  return Corner(vec4(place.x / u.plane.x, -place.y / u.plane.y, tri_depth(u.eye.w, distance), 1.0),
                vec3(place, 1.0));
}

// Returns the corner of a degenerate sprite that covers no pixel: all its corners are the same point outside the
// view.
Corner nowhere() { return Corner(vec4(2.0, 2.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0)); }

// Computes the bounds of a sphere on the image plane, with a margin of 1/64 pixel, clipped to the viewport.
// low > high if the sphere is outside the viewport. An injected fault makes the bounds 1 % smaller.
void image_bounds(vec4 sphere, out vec2 low, out vec2 high) {
  vec2 x = tri_sphere_interval(sphere.x, sphere.z, sphere.w);
  vec2 y = tri_sphere_interval(sphere.y, sphere.z, sphere.w);
  TRI_PRECISE vec2 margin = 0.015625 * u.plane.zw;
  TRI_PRECISE vec2 begin = vec2(x.x, y.x) - margin;
  TRI_PRECISE vec2 end = vec2(x.y, y.y) + margin;
  if (u.eye_rest.w < 1.0) {
    TRI_PRECISE vec2 shrink = 0.5 * (1.0 - u.eye_rest.w) * (end - begin);
    begin += shrink;
    end -= shrink;
  }
  low = max(begin, -u.plane.xy);
  high = min(end, u.plane.xy);
}

// Returns the size in pixels of the square point that contains these bounds.
float point_size(vec2 low, vec2 high) {
  vec2 pixels = (high - low) / u.plane.zw;
  return max(pixels.x, pixels.y);
}

// Computes the screen-aligned quad of the paper (docs/paper.md), which is the rectangle around the
// silhouette or, if the sphere reaches the plane of the eye and thus has no bounded silhouette, the
// whole viewport. low > high if nothing is visible.
void screen_bounds(vec4 sphere, out vec2 low, out vec2 high) {
  image_bounds(sphere, low, high);
  if (tri_eye_plane(sphere.z, sphere.w) == 1) {
    low = -u.plane.xy;
    high = u.plane.xy;
  }
}

// Returns the corner `side` of a rectangle at the depth of the sphere's front. TRI_SPRITE_GROWTH: additional pixels
// on each side, for devices with a coarse vertex grid.
Corner front_corner(vec4 sphere, vec2 low, vec2 high, vec2 side) {
  if (TRI_SPRITE_GROWTH > 0.0) {
    low -= TRI_SPRITE_GROWTH * u.plane.zw;
    high += TRI_SPRITE_GROWTH * u.plane.zw;
  }
  float front = (sphere.z - sphere.w) * 0.9990234375;
  return corner_on_image(low, high, side, max(front, u.eye.w));
}

// The frame of a ray-aligned sprite: a plane perpendicular to the ray through the centre, just in front of the
// sphere.
struct Frame {
  vec3 centre;
  vec3 right;  // its length is the radius of the sprite
  vec3 up;
  int everywhere;  // 1 if the sprite is the whole viewport
};

Frame sprite_frame(vec4 sphere) {
  float d2 = dot(sphere.xyz, sphere.xyz);
  float d = sqrt(d2);
  vec3 v = sphere.xyz / d;
  vec3 reference = abs(v.y) > 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 right = normalize(cross(v, reference));
  float plane = tri_sprite_plane(d, sphere.w);
  float radius = tri_sprite_radius(d, sphere.w, plane, max(u.plane.z, u.plane.w), u.eye_rest.w);
  if (TRI_SPRITE_GROWTH > 0.0) {  // a pixel is at least as large at depth sphere.z as on the sprite
    radius += TRI_SPRITE_GROWTH * max(u.plane.z, u.plane.w) * max(sphere.z, 0.0);
  }
  return Frame(v * plane, radius * right, radius * cross(right, v), tri_surrounds(d2, sphere.w));
}

// Returns the corner `side` (±1, ±1) of a square sprite.
Corner quad_corner(Frame frame, vec2 side) {
  if (frame.everywhere == 1) return corner_on_image(-u.plane.xy, u.plane.xy, side, u.eye.w);
  return corner_at(frame.centre + side.x * frame.right + side.y * frame.up);
}

// Returns corner k of the polygon with n ≥ 4 corners around the circle. If the sprite is the whole viewport, the
// first four corners are those of the viewport, and further corners repeat the last of them.
Corner polygon_corner(Frame frame, int k, int n) {
  if (frame.everywhere == 1) {
    vec2 side = vec2(k == 0 || k >= 3 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0);
    return corner_on_image(-u.plane.xy, u.plane.xy, side, u.eye.w);
  }
  float turns = (float(k) + 0.5) / float(n);
  float reach = 1.00001 / tri_cosine_turns(0.5 / float(n));
  return corner_at(frame.centre + reach * (tri_cosine_turns(turns) * frame.right +
                                           tri_sine_turns(turns) * frame.up));
}

// Returns the centre of the polygon.
Corner polygon_centre(Frame frame) {
  if (frame.everywhere == 1) {
    return corner_on_image(-u.plane.xy, u.plane.xy, vec2(0.0), u.eye.w);
  }
  return corner_at(frame.centre);
}

int corners_of(vec4 sphere) {
  return tri_adaptive_corners(
      tri_projected_radius(length(sphere.xyz), sphere.w, max(u.plane.z, u.plane.w)));
}
