// Raycasting for quadrature=cells (scene::Quadrature), in which the ray goes from cell to cell. A
// cell is the space between eight voxel centres, in which the field along the ray is a cubic
// polynomial. The position at which the ray crosses a plane is computed from the cell's index and
// not accumulated. The contribution of a cell therefore does not depend on the previous cells, so
// the image is bit-identical with and without skipping. This code exists only in single precision.
// The structure of its loops follows from the compiler properties described in raycast.glsl.
// "Times" are positions on the ray, in steps.
#include "volume/raycast/field.glsl"

// The data of a ray that is needed to walk from cell to cell. Cell i is between the voxels i and i+1. The first cell
// (−1) and the last cell are the half voxels at the faces of the volume, where values are clamped.
struct Way {
  vec3 p0;         // entry point of the ray into the volume, relative to the first voxel's centre
  vec3 g;          // one step, in voxels
  vec3 inverse_g;
  ivec3 forward;   // 1 if the ray runs towards higher indices, otherwise 0
};

Way make_way(Ray ray) {
  Way way;
  way.p0 = ray.p0 - 0.5;
  way.g = ray.g;
  // To avoid a division by zero, a ray parallel to a face is assumed to need 10²⁰ steps to the next face.
  way.inverse_g = 1.0 / mix(ray.g, vec3(1.0e-20), lessThan(abs(ray.g), vec3(1.0e-20)));
  way.forward = ivec3(greaterThan(way.inverse_g, vec3(0.0)));
  return way;
}

vec3 crossings(Way way, ivec3 planes) { return (vec3(planes) - way.p0) * way.inverse_g; }
vec3 entries(Way way, ivec3 cell) { return crossings(way, cell + 1 - way.forward); }
vec3 exits(Way way, ivec3 cell) { return crossings(way, cell + way.forward); }
float least(vec3 v) { return min(v.x, min(v.y, v.z)); }

// Returns the cell that the ray enters at the nearest of three planes, one for each axis. The ray crosses the planes at
// the times `at`, which are positions on the ray. Along the other axes, the index is that of the cell that contains the
// ray at the time of the nearest plane. This index is determined from the same times that a walk from cell to cell
// would compare.
ivec3 cell_behind(Way way, ivec3 planes, vec3 at) {
  float t = least(at);
  ivec3 direction = 2 * way.forward - 1;
  ivec3 cell = ivec3(floor(way.p0 + t * way.g));
  cell += direction * ivec3(lessThanEqual(exits(way, cell), vec3(t)));
  cell -= direction * ivec3(greaterThan(entries(way, cell), vec3(t)));
  ivec3 crossed = ivec3(lessThanEqual(at, vec3(t)));
  return crossed * (planes - 1 + way.forward) + (1 - crossed) * cell;
}

// Returns c.x + c.y·s + c.z·s² + c.w·s³.
float cubic(vec4 c, float s) { return c.x + s * (c.y + s * (c.z + s * c.w)); }

// Returns the cubic in s that gives the value along the ray through a cell, as a position in the transfer function's
// table, for 0 ≤ s ≤ 1. The coordinates of the ray within the cell run from a to a + b. The eight voxels are
// interpolated along x, then y, then z.
vec4 cubic_of_cell(Grid grid, ivec3 cell, vec3 a, vec3 b) {
  if (TRI_FAULT == fault_half_voxel_shift) a.x += 0.5;
  if (TRI_FAULT == fault_coarse_filter) a = floor(a * 256.0 + 0.5) / 256.0;
#if TRI_PACKED
  if (TRI_FAULT == fault_flipped_axis) { cell.y = grid.last.y - 1 - cell.y; a.y = 1.0 - a.y; b.y = 0.0 - b.y; }
  Corners corners = corners_of(grid, cell_index(grid, clamp(cell + 1, ivec3(0), grid.last + 1)));
  vec4 v0 = vec4(corners.lower.xz, corners.upper.xz);
  vec4 v1 = vec4(corners.lower.yw, corners.upper.yw);
#else
  ivec3 lo = clamp(cell, ivec3(0), grid.last);
  ivec3 hi = clamp(cell + 1, ivec3(0), grid.last);
  if (TRI_FAULT == fault_flipped_axis) { lo.y = grid.last.y - lo.y; hi.y = grid.last.y - hi.y; }
  vec4 v0 = vec4(voxel(grid, lo), voxel(grid, ivec3(lo.x, hi.y, lo.z)), voxel(grid, ivec3(lo.x, lo.y, hi.z)),
                 voxel(grid, ivec3(lo.x, hi.y, hi.z)));
  vec4 v1 = vec4(voxel(grid, ivec3(hi.x, lo.y, lo.z)), voxel(grid, ivec3(hi.x, hi.y, lo.z)),
                 voxel(grid, ivec3(hi.x, lo.y, hi.z)), voxel(grid, hi));
#endif
  vec4 x0 = v0 + a.x * (v1 - v0);  // interpolated along x, for four edges: the terms that are constant in s
  vec4 x1 = b.x * (v1 - v0);       // the terms that are linear in s
  vec2 rise0 = x0.yw - x0.xz;
  vec2 rise1 = x1.yw - x1.xz;
  vec2 y0 = x0.xz + a.y * rise0;
  vec2 y1 = x1.xz + a.y * rise1 + b.y * rise0;
  vec2 y2 = b.y * rise1;
  float z0 = y0.y - y0.x;
  float z1 = y1.y - y1.x;
  float z2 = y2.y - y2.x;
  vec4 c = vec4(y0.x + a.z * z0, y1.x + a.z * z1 + b.z * z0, y2.x + a.z * z2 + b.z * z1, b.z * z2);
  c *= 256.0 * grid.value_map.x;
  c.x += 256.0 * grid.value_map.y - 0.5;
  return c;
}

// Returns a row of technique::kink_table: the smallest kink ≥ i, the largest kink < i, and the first visible
// entry ≥ i. A kink is an entry of the transfer function at which its slope changes.
vec4 kink_row(float i) { return quadrature_entry(int(clamp(i, 0.0, 256.0))); }

// Returns whether any value in the cell has opacity. The test uses the range between the smallest and the largest
// Bernstein coefficient of the cubic, which contains all values.
bool shows(vec4 c) {
  vec4 b = vec4(c.x, c.x + c.y / 3.0, c.x + (2.0 * c.y + c.z) / 3.0, c.x + c.y + c.z + c.w);
  float lowest = clamp(min(min(b.x, b.y), min(b.z, b.w)), 0.0, 255.0);
  float highest = clamp(max(max(b.x, b.y), max(b.z, b.w)), 0.0, 255.0);
  return kink_row(floor(lowest)).z <= ceil(highest);
}

// Returns the positions of the cubic's extrema in ascending order, or positions greater than 1 if there are none.
vec2 extrema(vec4 c) {
  float discriminant = c.z * c.z - 3.0 * c.w * c.y;
  if (!(discriminant > 0.0)) return vec2(2.0);
  // Both roots are computed from a sum, which avoids cancellation.
  float q = 0.0 - (c.z + (c.z < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
  float e = c.w == 0.0 ? 2.0 : q / (3.0 * c.w);
  float f = q == 0.0 ? 2.0 : c.y / q;
  return vec2(min(e, f), max(e, f));
}

// Returns the position between `from` and `to` where the cubic has the value `value`. The cubic is monotone there
// and has the values at_from and at_to at the two ends. The search starts on the parabola with these values and
// with the cubic's slope at `from`, which is a good start even next to an extremum. It continues with Newton's
// method, or with bisection if a Newton step leaves the bracket.
float where_it_is(vec4 c, float value, float from, float to, float at_from, float at_to) {
  bool rising = at_to > at_from;
  float r = (value - at_from) / (at_to - at_from);
  float slope = (c.y + from * (2.0 * c.z + from * (3.0 * c.w))) * (to - from) / (at_to - at_from);
  float root = sqrt(max(slope * slope + 4.0 * (1.0 - slope) * r, 0.0));
  float s = from + (to - from) * clamp(2.0 * r / (slope + root), 0.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    float error = cubic(c, s) - value;
    if ((error < 0.0) == rising) from = s; else to = s;
    float newton = s - error / (c.y + s * (2.0 * c.z + s * (3.0 * c.w)));
    s = newton >= from && newton <= to ? newton : 0.5 * (from + to);
  }
  return s;
}

// Returns the extinction −log2(1 − alpha). An opacity of 1 counts as an extinction of 8192.
float extinction(float alpha) { return alpha < 1.0 ? 0.0 - tri_log2_1m(alpha) : 8192.0; }

// Adds a piece of `length` voxels whose colours at its two Gauss points are a and b (reference/cell_rule.hpp
// explains the formulas).
void add_piece(inout Light light, vec4 a, vec4 b, float length) {
  float first = extinction(a.a);
  float second = extinction(b.a);
  float depth = 0.5 * length * (first + second);
  if (depth > 0.0) {
    float opacity = tri_1m_exp2(-depth);
    float z = 0.3465735903 * depth;
    float langevin = z / (3.0 + tri_attenuation(z, opacity));
    float tilt = (second - first) / (first + second);
    float share = clamp(0.5 * (1.0 + tilt - 1.7320508076 * langevin), 0.0, 1.0);
    float weight = light.transmittance * opacity;
    light.colour += weight * (a.rgb + share * (b.rgb - a.rgb));
    light.transmittance -= weight;
  }
}

// Adds the piece of the ray between s and `next`, which are positions within the cell from 0 to 1. The ray is in
// the cell from time `begin` to time `end`.
void add_part(inout Light light, Grid grid, Ray ray, vec4 c, float s, float next, float begin, float end,
              float step_voxels) {
  float middle = 0.5 * (s + next);
  float apart = 0.2886751346 * (next - s);
  // transfer() expects a normalised value, which is (p + ½)/256 for position p in the table.
  vec4 a = transfer((cubic(c, middle - apart) + 0.5) / 256.0);
  vec4 b = transfer((cubic(c, middle + apart) + 0.5) / 256.0);
  if (TRI_COUNT == 1) count_samples += 2u;
  if (a.a > 0.0 || b.a > 0.0) {
    if (TRI_COUNT == 1) count_nonzero += (a.a > 0.0 ? 1u : 0u) + (b.a > 0.0 ? 1u : 0u);
    if (TRI_SHADING == 1) {
      vec3 at_a = ray.p0 + (begin + (middle - apart) * (end - begin)) * ray.g;
      vec3 at_b = ray.p0 + (begin + (middle + apart) * (end - begin)) * ray.g;
      a.rgb = shade(grid, a.rgb, at_a, ray.d);
      b.rgb = shade(grid, b.rgb, at_b, ray.d);
    }
    add_piece(light, a, b, step_voxels * (end - begin) * (next - s));
  }
}

// Adds the light of the cell that the ray crosses from time `begin` to time `end` (positions on the ray, in steps).
void add_cell(inout Light light, Grid grid, Ray ray, Way way, ivec3 cell, float begin, float end,
              float step_voxels) {
  vec4 c = cubic_of_cell(grid, cell, way.p0 + begin * way.g - vec3(cell), (end - begin) * way.g);
  vec2 turn = extrema(c);
  float part = 1.0;
  float from = c.x;
  float start = 0.0;  // start of the piece
  // The position in the cell that the loop has reached. The loop is skipped if nothing in the cell is visible.
  float s = end > begin && shows(c) ? 0.0 : 1.0;
  while (s < 1.0) {
    // Stop at the end of the part of the cell, at an extremum (because values are monotone between extrema), or at
    // a kink.
    float stop = min(part / u.shading.w, 1.0);
    bool whole = !(turn.x > s && turn.x < stop) && !(turn.y > s && turn.y < stop);
    if (turn.y > s && turn.y < stop) stop = turn.y;
    if (turn.x > s && turn.x < stop) stop = turn.x;
    float to = cubic(c, stop);
    float kink = to > from ? kink_row(floor(from) + 1.0).x : kink_row(ceil(from)).y;
    // llvmpipe (Mesa 22.3) also runs helper invocations outside the triangle, which read 0 for a kink. They must
    // make progress nevertheless, because the other invocations of the block wait for them.
    bool cut = to > from ? kink > from && kink < to : kink < from && kink > to;
    float next = cut ? where_it_is(c, kink, s, stop, from, to) : stop;
    if (cut || whole) {
      add_part(light, grid, ray, c, start, next, begin, end, step_voxels);
      start = next;
    }
    part += !cut && whole ? 1.0 : 0.0;
    from = cut ? kink : to;
    s = next;
  }
}

// The content of the brick map for a cell: whether its brick is visible, and the planes through which the ray leaves
// the cube of bricks that are all visible or all invisible. At the faces of the volume, the cube is extended to
// include the half cells there.
struct Around {
  bool visible;
  ivec3 planes;
};

Around look_around(Way way, Grid grid, ivec3 cell) {
  int edge = u.brick_grid.w;
  ivec3 bricks = u.brick_grid.xyz;
  ivec3 brick = clamp(cell, ivec3(0), bricks * edge - 1) / edge;
  int reach = brick_at(brick.x + bricks.x * (brick.y + bricks.y * brick.z));
  ivec3 beyond = ivec3(max(abs(reach), 1));
  ivec3 low = (brick + 1 - beyond) * edge;
  ivec3 high = (brick + beyond) * edge;
  low -= ivec3(lessThanEqual(low, ivec3(0))) * (low + 1);
  high += ivec3(greaterThanEqual(high, grid.last)) * (grid.last + 1 - high);
  return Around(reach > 0, low + way.forward * (high - low));
}

#if TRI_PARTS

#include "volume/raycast/pause.glsl"

// Restores the state that pause_here() stored in the previous pass over the volume. The ray continues in `cell`.
void resume(inout Light light, inout ivec3 cell, inout vec3 times, int place) {
  Pause pause = pauses[place];
  light = Light(pause.light.xyz, pause.light.w);
  cell = pause.where.xyz;
  times = pause.times.xyz;
  resume_counts(pause);
}

void pause_here(Light light, ivec3 cell, vec3 times, int place) {
  pauses[place] = Pause(vec4(light.colour, light.transmittance), ivec4(cell, 0), ivec4(0), vec4(times, 0.0),
                        counts_so_far());
}

#endif

// Returns the premultiplied RGBA of the pixel. For a volume drawn in parts, this includes only the light gathered so
// far, and `place` is the index of the pixel's Pause.
#if TRI_PARTS
vec4 raycast_part(ivec2 pixel, int place) {
#else
vec4 raycast(ivec2 pixel) {
#endif
  Ray ray = make_ray(pixel);
  Grid grid = load_grid();
  Way way = make_way(ray);
  if (TRI_FAULT == fault_extra_sample && ray.steps > 0.0) ray.steps += 1.0;
  float step_voxels = TRI_FAULT == fault_uncorrected_opacity ? 1.0 : u.ray_centre.w;
  float enough = u.ray_right.w;
  Light light = Light(vec3(0.0), 1.0);
  // min(0, int(ray.steps)) is always 0 but depends on the ray, as in skips() in walk.glsl.
  bool skipping = u.brick_grid.w > min(0, int(ray.steps));
  ivec3 cell = clamp(ivec3(floor(way.p0)), ivec3(-1), grid.last);
  float begin = 0.0;
  float seen = skipping ? 0.0 : 3.0e38;  // all bricks up to this time are visible
  float end = ray.steps;
#if TRI_PARTS
  vec3 times = vec3(begin, seen, end);
  if (u.pass.x > 0) resume(light, cell, times, place);
  begin = times.x;
  seen = times.y;
  end = times.z;
  while (begin < end && cell_is_here(cell.z + 1)) {
#else
  while (begin < end) {
#endif
    Around around = Around(true, cell + way.forward);
    if (begin >= seen) {
      around = look_around(way, grid, cell);
      if (TRI_COUNT == 1) { count_bricks_visited++; count_bricks_skipped += around.visible ? 0u : 1u; }
      if (around.visible) {
        seen = least(crossings(way, around.planes));
        around.planes = cell + way.forward;
      }
    }
    vec3 at = crossings(way, around.planes);
    float leave = least(at);
    if (around.visible) add_cell(light, grid, ray, way, cell, begin, min(leave, ray.steps), step_voxels);
    ivec3 crossed = ivec3(lessThanEqual(at, vec3(leave)));
    cell = around.visible ? cell + crossed * (2 * way.forward - 1) : cell_behind(way, around.planes, at);
    begin = max(leave, 0.0);
    if (light.transmittance < enough) end = 0.0;
  }
#if TRI_PARTS
  pause_here(light, cell, vec3(begin, seen, end), place);
#endif
  if (TRI_COUNT == 1 && light.transmittance < enough) count_terminated = 1u;
#if TRI_COUNT
  store_counts(pixel, ray.steps > 0.0, 0u);
#endif
  return vec4(light.colour, 1.0 - light.transmittance) + light.transmittance * u.background;
}
