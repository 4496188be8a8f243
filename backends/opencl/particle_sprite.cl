// Generates sprites like sprite.glsl: first the coordinate frame at the sphere's centre, then the
// corners in clip space, which are clipped and projected to the grid of the rasterizer. Depth need
// not be computed here, because with an infinite far plane, z is `near` at every corner, and w is
// the distance along the view axis.

#define TRI_SCREEN_QUAD 1
#define TRI_RAY_QUAD 2
#define TRI_POLYGON 3
#define TRI_ADAPTIVE_POLYGON 4
// Sprites whose vertices are written by separate passes (particle_expand.cl).
#define TRI_EXPANDED_QUAD 5
#define TRI_EVALUATED_QUAD 6
#define TRI_POINT 7
#define TRI_STORED (TRI_SPRITE >= TRI_EXPANDED_QUAD)
#define TRI_LARGEST_POINT 255.0f  // in pixels: the largest point of Mesa's software devices

#if TRI_SPRITE == TRI_POLYGON
#define TRI_SPRITE_CORNERS 32
#elif TRI_SPRITE == TRI_ADAPTIVE_POLYGON
#define TRI_SPRITE_CORNERS 16
#else
#define TRI_SPRITE_CORNERS 4
#endif
// Each of the five clipping planes may add a corner.
#define TRI_MOST_CORNERS (TRI_SPRITE_CORNERS + 5)
// The number of fractional bits of a position on the grid, as with the other APIs.
#define TRI_SUBPIXEL_BITS 8
#define TRI_SUBPIXELS (1 << TRI_SUBPIXEL_BITS)

// The outline of a sprite in clip space. Rows are counted from the top, so y points down.
typedef struct {
  int n;
  float x[TRI_MOST_CORNERS];
  float y[TRI_MOST_CORNERS];
  float w[TRI_MOST_CORNERS];
} Outline;

// The rays of one triangle, as a linear function of the position on the screen: `origin` is where
// the ray of the upper left corner of the image intersects the image plane, and `right` and `down`
// are the changes per 1/256 pixel in these directions.
typedef struct {
  float2 right;
  float2 down;
  float2 origin;
} RayPlane;

typedef struct {
  int n;
  int x[TRI_MOST_CORNERS];  // in 1/256 pixel
  int y[TRI_MOST_CORNERS];
#if TRI_RAY_AT_VERTEX
  RayPlane rays[TRI_MOST_CORNERS - 2];  // for the triangles 0, k + 1, k + 2
#endif
} Polygon;

// The coordinate frame in which a ray-aligned sprite lies, perpendicular to the ray through the
// centre and just in front of the sphere.
typedef struct {
  float3 centre;
  float3 right;  // its length is the radius of the sprite
  float3 up;
  int everywhere;  // 1: the sprite covers the whole viewport
} Frame;

TRI_FN float length_of(float3 v) { return TRI_SQRT(v.x * v.x + v.y * v.y + v.z * v.z); }

TRI_FN float3 crossed(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

TRI_FN Frame sprite_frame(const Particles* u, float4 sphere) {
  float d2 = sphere.x * sphere.x + sphere.y * sphere.y + sphere.z * sphere.z;
  float d = TRI_SQRT(d2);
  float3 v = sphere.xyz / d;
  float3 reference =
      fabs(v.y) > 0.9f ? (float3)(1.0f, 0.0f, 0.0f) : (float3)(0.0f, 1.0f, 0.0f);
  float3 right = crossed(v, reference);
  right /= length_of(right);
  float plane = tri_sprite_plane(d, sphere.w);
  float radius =
      tri_sprite_radius(d, sphere.w, plane, max(u->plane.z, u->plane.w), u->eye_rest.w);
  Frame frame;
  frame.centre = v * plane;
  frame.right = radius * right;
  frame.up = radius * crossed(right, v);
  frame.everywhere = tri_surrounds(d2, sphere.w);
  return frame;
}

TRI_FN void add_corner(const Particles* u, float3 place, Outline* outline) {
  int k = outline->n++;
  outline->x[k] = place.x / u->plane.x;
  outline->y[k] = (0.0f - place.y) / u->plane.y;
  outline->w[k] = place.z;
}

// Adds the rectangle with these two opposite corners on the image plane.
TRI_FN void add_rectangle(const Particles* u, float2 low, float2 high, Outline* outline) {
  add_corner(u, (float3)(low.x, low.y, 1.0f), outline);
  add_corner(u, (float3)(high.x, low.y, 1.0f), outline);
  add_corner(u, (float3)(high.x, high.y, 1.0f), outline);
  add_corner(u, (float3)(low.x, high.y, 1.0f), outline);
}

// Creates a screen-aligned sprite: the rectangle around the silhouette, clipped to the viewport.
// Adds no corners if nothing is visible.
TRI_FN void screen_outline(const Particles* u, float4 sphere, Outline* outline) {
  float2 x = covered(sphere.x, sphere.z, sphere.w, u->plane.z, u->eye_rest.w);
  float2 y = covered(sphere.y, sphere.z, sphere.w, u->plane.w, u->eye_rest.w);
  float2 low = (float2)(max(x.x, 0.0f - u->plane.x), max(y.x, 0.0f - u->plane.y));
  float2 high = (float2)(min(x.y, u->plane.x), min(y.y, u->plane.y));
  // As in the paper (docs/paper.md), the sprite of a sphere that intersects the plane of the eye
  // covers the whole viewport.
  if (tri_eye_plane(sphere.z, sphere.w) == 1) {
    high = (float2)(u->plane.x, u->plane.y);
    low = -high;
  }
  if (low.x <= high.x && low.y <= high.y) add_rectangle(u, low, high, outline);
}

TRI_FN int sprite_corners(const Particles* u, float4 sphere) {
#if TRI_SPRITE == TRI_ADAPTIVE_POLYGON
  return tri_adaptive_corners(
      tri_projected_radius(length_of(sphere.xyz), sphere.w, max(u->plane.z, u->plane.w)));
#elif TRI_SPRITE == TRI_POLYGON
  return u->viewport.z;
#else
  return 4;
#endif
}

// Creates a ray-aligned sprite. Returns false if clipping planes must not cut it: a sprite that
// covers the whole viewport is drawn at w = 1, and `near` may be larger than that.
TRI_FN bool ray_outline(const Particles* u, float4 sphere, Outline* outline) {
  Frame frame = sprite_frame(u, sphere);
  if (frame.everywhere == 1) {
    add_rectangle(u, (float2)(0.0f - u->plane.x, 0.0f - u->plane.y),
                  (float2)(u->plane.x, u->plane.y), outline);
    return false;
  }
#if TRI_SPRITE == TRI_RAY_QUAD
  add_corner(u, frame.centre - frame.right - frame.up, outline);
  add_corner(u, frame.centre + frame.right - frame.up, outline);
  add_corner(u, frame.centre + frame.right + frame.up, outline);
  add_corner(u, frame.centre - frame.right + frame.up, outline);
#else
  int n = sprite_corners(u, sphere);
  float reach = 1.00001f / tri_cosine_turns(0.5f / (float)n);
  for (int k = 0; k < n; ++k) {
    float turns = ((float)k + 0.5f) / (float)n;
    add_corner(u,
               frame.centre + reach * (tri_cosine_turns(turns) * frame.right +
                                       tri_sine_turns(turns) * frame.up),
               outline);
  }
#endif
  return true;
}

// Returns how far a corner lies inside one of the clipping planes. The planes are the near plane
// and the four sides of a guard band, which extends this many viewports to each side, so that
// positions fit the grid.
#define TRI_GUARD_BAND 4.0f
TRI_FN float within(const Outline* outline, int k, int plane, float near) {
  float side = TRI_GUARD_BAND * outline->w[k];
  return plane == 0   ? outline->w[k] - near
         : plane == 1 ? side - outline->x[k]
         : plane == 2 ? side + outline->x[k]
         : plane == 3 ? side - outline->y[k]
                      : side + outline->y[k];
}

TRI_FN bool needs_clipping(const Outline* outline, float near) {
  bool outside = false;
  for (int k = 0; k < outline->n; ++k) {
    for (int plane = 0; plane < 5; ++plane) {
      outside = outside | (within(outline, k, plane, near) < 0.0f);
    }
  }
  return outside;
}

// Clips with the algorithm of Sutherland and Hodgman (1974).
TRI_FN void clip_outline(Outline* outline, float near) {
  for (int plane = 0; plane < 5; ++plane) {
    Outline from = *outline;
    outline->n = 0;
    for (int k = 0; k < from.n; ++k) {
      int next = k + 1 < from.n ? k + 1 : 0;
      float here = within(&from, k, plane, near);
      float there = within(&from, next, plane, near);
      if (here >= 0.0f) {
        int to = outline->n++;
        outline->x[to] = from.x[k];
        outline->y[to] = from.y[k];
        outline->w[to] = from.w[k];
      }
      if ((here >= 0.0f) != (there >= 0.0f) && outline->n < TRI_MOST_CORNERS) {
        float share = here / (here - there);
        int to = outline->n++;
        outline->x[to] = from.x[k] + share * (from.x[next] - from.x[k]);
        outline->y[to] = from.y[k] + share * (from.y[next] - from.y[k]);
        outline->w[to] = from.w[k] + share * (from.w[next] - from.w[k]);
      }
    }
  }
}

// Rays that are interpolated between corners. In perspective, (x, y, z)/w is linear on the screen,
// and z is w, so the position on the image plane is linear too. It is described by one plane for
// each triangle of the fan. A corner's ray passes through its position after snapping to the grid,
// so that interpolation yields the exact ray of each pixel. With the unsnapped position, rays would
// be off by up to 1/256 pixel.
#if TRI_RAY_AT_VERTEX
// Returns a·b − c·d, exact except for the rounding of the result. This matters because the small
// areas of long, thin triangles are differences of large products.
TRI_FN float difference_of_products(float a, float b, float c, float d) {
  float first = a * b;
  float second = c * d;
  return (first - second) + (tri_product_error(a, b, first) - tri_product_error(c, d, second));
}

TRI_FN RayPlane fit_rays(const Particles* u, const Polygon* polygon, int b, int c) {
  float bx = (float)(polygon->x[b] - polygon->x[0]), by = (float)(polygon->y[b] - polygon->y[0]);
  float cx = (float)(polygon->x[c] - polygon->x[0]), cy = (float)(polygon->y[c] - polygon->y[0]);
  float2 unit = (float2)(u->plane.z, 0.0f - u->plane.w) / (float)TRI_SUBPIXELS;
  float2 to_b = (float2)(bx, by) * unit;
  float2 to_c = (float2)(cx, cy) * unit;
  float area = difference_of_products(bx, cy, by, cx);
  float scale = area != 0.0f ? 1.0f / area : 0.0f;
  RayPlane rays;
  rays.right = (float2)(difference_of_products(to_b.x, cy, to_c.x, by),
                        difference_of_products(to_b.y, cy, to_c.y, by)) * scale;
  rays.down = (float2)(difference_of_products(to_c.x, bx, to_b.x, cx),
                       difference_of_products(to_c.y, bx, to_b.y, cx)) * scale;
  float2 at_a = (float2)((float)polygon->x[0] * unit.x - u->plane.x,
                         (float)polygon->y[0] * unit.y + u->plane.y);
  rays.origin = at_a - (float)polygon->x[0] * rays.right - (float)polygon->y[0] * rays.down;
  return rays;
}

// Returns the triangle of the fan that contains a position on the grid. On a diagonal, either
// neighbour can be used, because their planes meet there.
TRI_FN int fan_triangle(const Polygon* polygon, float right, float down) {
  float from_x = right - (float)polygon->x[0];
  float from_y = down - (float)polygon->y[0];
  int found = 0;
  for (int k = 1; k + 2 < polygon->n; ++k) {
    float dx = (float)(polygon->x[k + 1] - polygon->x[0]);
    float dy = (float)(polygon->y[k + 1] - polygon->y[0]);
    float next_x = (float)(polygon->x[k + 2] - polygon->x[0]);
    float next_y = (float)(polygon->y[k + 2] - polygon->y[0]);
    if ((dx * from_y - dy * from_x) * (dx * next_y - dy * next_x) > 0.0f) found = k;
  }
  return found;
}
#endif

// Converts the outline from clip space to the grid.
TRI_FN void snap_outline(const Particles* u, const Outline* outline, Polygon* polygon) {
  float across = (float)(u->viewport.x * (TRI_SUBPIXELS / 2));
  float down = (float)(u->viewport.y * (TRI_SUBPIXELS / 2));
  for (int k = 0; k < outline->n; ++k) {
    polygon->x[k] = (int)tri_floor(outline->x[k] / outline->w[k] * across + across + 0.5f);
    polygon->y[k] = (int)tri_floor(outline->y[k] / outline->w[k] * down + down + 0.5f);
  }
  polygon->n = outline->n;
#if TRI_RAY_AT_VERTEX
  for (int k = 0; k + 2 < polygon->n; ++k) {
    polygon->rays[k] = fit_rays(u, polygon, k + 1, k + 2);
  }
#endif
}

#if TRI_SPRITE == TRI_POINT
// Creates the square around the centre, with centre and size rounded to the grid. Returns the
// number of vertices with which the sphere was drawn.
TRI_FN int stored_polygon(const Particles* u, __global const float* stored, size_t particle,
                          Polygon* polygon) {
  float4 point = vload4(2 * particle, stored);
  polygon->n = 0;
  if (point.w == 0.0f) return 0;
  Outline outline;
  outline.n = 0;
  if (point.w == 4.0f) {
    float4 bounds = vload4(2 * particle + 1, stored);
    add_rectangle(u, bounds.lo, bounds.hi, &outline);
    snap_outline(u, &outline, polygon);
    return 4;
  }
  int middle_x = (int)tri_floor(point.x * (float)(u->viewport.x * (TRI_SUBPIXELS / 2)) +
                                (float)(u->viewport.x * (TRI_SUBPIXELS / 2)) + 0.5f);
  int middle_y = (int)tri_floor(point.y * (float)(u->viewport.y * (TRI_SUBPIXELS / 2)) +
                                (float)(u->viewport.y * (TRI_SUBPIXELS / 2)) + 0.5f);
  int size = max((int)tri_floor(point.z * (float)TRI_SUBPIXELS + 0.5f), TRI_SUBPIXELS);
  int left = middle_x - (size >> 1);
  int top = middle_y - (size >> 1);
  for (int k = 0; k < 4; ++k) {
    polygon->x[k] = k == 0 || k == 3 ? left : left + size;
    polygon->y[k] = k < 2 ? top : top + size;
  }
  polygon->n = 4;
  return 1;
}
#elif TRI_STORED
// Assembles the polygon from its four vertices in clip space. A vertex lies in front of the near
// plane if z exceeds w.
TRI_FN int stored_polygon(const Particles* u, __global const float* stored, size_t particle,
                          Polygon* polygon) {
  Outline outline;
  outline.n = 4;
  float near = 0.0f;
  for (int k = 0; k < 4; ++k) {
    float4 corner = vload4(4 * particle + (size_t)k, stored);
    outline.x[k] = corner.x;
    outline.y[k] = corner.y;
    outline.w[k] = corner.w;
    near = corner.z;
  }
  if (needs_clipping(&outline, near)) clip_outline(&outline, near);
  snap_outline(u, &outline, polygon);
  return 4;
}
#else
// Creates the sprite on the grid. Returns the number of its corners before clipping; 0 if there is
// no sprite.
TRI_FN int make_polygon(const Particles* u, float4 sphere, Polygon* polygon) {
  Outline outline;
  outline.n = 0;
#if TRI_SPRITE == TRI_SCREEN_QUAD
  screen_outline(u, sphere, &outline);
#else
  if (ray_outline(u, sphere, &outline) && needs_clipping(&outline, u->eye.w)) {
    clip_outline(&outline, u->eye.w);
  }
#endif
  snap_outline(u, &outline, polygon);
#if TRI_SPRITE == TRI_SCREEN_QUAD
  return outline.n;
#else
  return sprite_corners(u, sphere);
#endif
}
#endif

// Returns the first pixel whose centre is not before this position on the grid.
TRI_FN int pixel_from(int place) {
  return (place - TRI_SUBPIXELS / 2 + TRI_SUBPIXELS - 1) >> TRI_SUBPIXEL_BITS;
}

// Returns the pixels of row y that the polygon covers, as the first pixel and the pixel after the
// last. Left and upper edges are inside; right and lower edges are not. This is the fill rule of
// the other APIs. With this rule, the triangles of a sprite cover each of its pixels exactly once.
TRI_FN int2 covered_row(const Polygon* polygon, int y) {
  int at = y * TRI_SUBPIXELS + TRI_SUBPIXELS / 2;
  int first = INT_MAX;
  int last = INT_MIN;
  for (int k = 0; k < polygon->n; ++k) {
    int next = k + 1 < polygon->n ? k + 1 : 0;
    bool down = polygon->y[k] <= polygon->y[next];
    int upper = down ? k : next;
    int lower = down ? next : k;
    if (polygon->y[upper] > at || polygon->y[lower] <= at) continue;
    // Computes ⌈x − ½⌉ for the x coordinate of the crossing, in integer arithmetic.
    long height = polygon->y[lower] - polygon->y[upper];
    long crossing = (polygon->x[upper] - TRI_SUBPIXELS / 2) * height +
                    (long)(at - polygon->y[upper]) * (polygon->x[lower] - polygon->x[upper]);
    long unit = height * TRI_SUBPIXELS;
    long whole = crossing / unit;
    int pixel = (int)(whole + (crossing > whole * unit ? 1 : 0));
    first = min(first, pixel);
    last = max(last, pixel);
  }
  return (int2)(first, last);
}

// Computes the rectangle of pixels that contains the polygon, clipped to the viewport.
TRI_FN void polygon_rectangle(const Particles* u, const Polygon* polygon, uint* first, uint* last) {
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;
  for (int k = 0; k < polygon->n; ++k) {
    x0 = min(x0, polygon->x[k]);
    x1 = max(x1, polygon->x[k]);
    y0 = min(y0, polygon->y[k]);
    y1 = max(y1, polygon->y[k]);
  }
  *first = TRI_EMPTY_FIRST;
  *last = TRI_EMPTY_LAST;
  if (polygon->n < 3) return;
  x0 = max(pixel_from(x0), 0);
  y0 = max(pixel_from(y0), 0);
  x1 = min(pixel_from(x1), u->viewport.x) - 1;
  y1 = min(pixel_from(y1), u->viewport.y) - 1;
  if (x0 > x1 || y0 > y1) return;
  *first = packed(x0, y0);
  *last = packed(x1, y1);
}
