// Runs one work item per tile. It descends the hierarchy with the beam (the bundle of the rays of
// all pixels of the tile), nearer child first, and draws each sphere that may be visible and whose
// box intersects the beam. bvh.comp.glsl does this for beams of 4×2 pixels, and explains how the
// traversal goes back up.

// Eight directions, whose components are stored in x, y and z:
//   0 to 3  the normals of the sides of the beam (left, right, lower, upper), which point inwards
//   4, 5    the view axis backwards and forwards, to find the nearest and the farthest point of a
//           box along the axis
//   6, 7    unused (0)
typedef struct {
  float8 x;
  float8 y;
  float8 z;
  float4 eye_low;   // the eye minus its rounding error
  float4 eye_high;  // the eye plus its rounding error
  float slack_share;
} Beam;

TRI_FN Beam open_beam(const Particles* u, const Tile* tile) {
  // The sides lie 1/64 pixel outside of the outermost rays, like the margin of sprites.
  float low_x = tile->column[0] - 0.015625f * u->plane.z;
  float high_x = tile->column[tile->last_x] + 0.015625f * u->plane.z;
  float low_y = tile->row[tile->last_y] - 0.015625f * u->plane.w;
  float high_y = tile->row[0] + 0.015625f * u->plane.w;
  float4 f = u->forward;
  float4 left = u->right - low_x * f;
  float4 right = high_x * f - u->right;
  float4 lower = u->up - low_y * f;
  float4 upper = high_y * f - u->up;
  float widest = max(max(fabs(low_x), fabs(high_x)), max(fabs(low_y), fabs(high_y)));
  Beam beam;
  beam.x = (float8)(left.x, right.x, lower.x, upper.x, -f.x, f.x, 0.0f, 0.0f);
  beam.y = (float8)(left.y, right.y, lower.y, upper.y, -f.y, f.y, 0.0f, 0.0f);
  beam.z = (float8)(left.z, right.z, lower.z, upper.z, -f.z, f.z, 0.0f, 0.0f);
  float4 around = 2.4e-7f * fabs(u->eye);
  beam.eye_low = u->eye - around;
  beam.eye_high = u->eye + around;
  beam.slack_share = 3.8e-6f * (1.0f + widest);
  return beam;
}

TRI_FN float8 greater_of(float8 a, float8 b) { return a > b ? a : b; }

// Returns whether the beam intersects the box (lower corner, upper corner) and something in it may
// be visible. `nearest` is the smallest distance of the box along the view axis. The effects of
// rounding are derived in bvh.comp.glsl.
TRI_FN bool may_show(const Beam* beam, const Tile* tile, float8 box, float* nearest) {
  float4 lo = box.lo - beam->eye_high;
  float4 hi = box.hi - beam->eye_low;
  float slack = beam->slack_share * tri_box_reach(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
  float8 highest = greater_of(beam->x * lo.x, beam->x * hi.x) + greater_of(beam->y * lo.y, beam->y * hi.y) +
                   greater_of(beam->z * lo.z, beam->z * hi.z);
  *nearest = 0.0f - highest.s4 - slack;
  float front = TRI_WRONG_SENSE ? highest.s5 : *nearest;
  bool outside = any(highest.lo < -slack);
  return !outside && (TRI_REVERSED_DEPTH || !(front > tile->farthest));
}

typedef struct {
  uint nodes;
  uint boxes;
  uint intersections;
} Passed;

TRI_FN void draw_sphere(const Particles* u, float4 s, uint particle, Tile* tile, Passed* passed) {
  float4 c = (float4)(camera_x(u, s.x, s.y, s.z), camera_y(u, s.x, s.y, s.z), camera_z(u, s.x, s.y, s.z), s.w);
  float2 wide = covered(c.x, c.z, c.w, u->plane.z, 1.0f);
  float2 high = covered(0.0f - c.y, c.z, c.w, u->plane.w, 1.0f);
  int x0 = max(first_pixel(wide.x, u->plane.x, u->plane.z, u->viewport.x) - tile->x, 0);
  int x1 = min(last_pixel(wide.y, u->plane.x, u->plane.z, u->viewport.x) - tile->x, tile->last_x);
  int y0 = max(first_pixel(high.x, u->plane.y, u->plane.w, u->viewport.y) - tile->y, 0);
  int y1 = min(last_pixel(high.y, u->plane.y, u->plane.w, u->viewport.y) - tile->y, tile->last_y);
  if (x0 > x1 || y0 > y1) return;
  uint kept = 0;
  for (int y = y0; y <= y1; ++y) draw_row(u->eye.w, x0, x1, y, c, particle, 0, tile, &kept);
#if TRI_COUNT
  passed->intersections += (uint)((x1 - x0 + 1) * (y1 - y0 + 1));
#endif
  if (++tile->drawn >= TRI_LOOK_EVERY) look_for_farthest(u->eye.w, tile);
}

TRI_FN void trace_tile(const Particles* u, uint4 shape, __global const float* restrict boxes,
                       __global const float* restrict tree_spheres,
                       __global const uint* restrict tree_order, Tile* tile, Passed* passed) {
  Beam beam = open_beam(u, tile);
  uint leaves = 1u << shape.y;
  uint node = 1;
  uint trail = 0;
  while (node != 0) {
    bool descends = false;
    if (node >= leaves) {
      uint end = leaf_begin(shape, node - leaves + 1);
      for (uint i = leaf_begin(shape, node - leaves); i < end; ++i) {
        float4 sphere = vload4(i, tree_spheres);
        float nearest;
#if TRI_COUNT
        ++passed->boxes;
#endif
        if (may_show(&beam, tile, sphere_box(sphere), &nearest)) {
          draw_sphere(u, sphere, tree_order[i], tile, passed);
        }
      }
    } else {
      float nearest_a;
      float nearest_b;
      bool a = may_show(&beam, tile, vload8(2 * (size_t)node, boxes), &nearest_a);
      bool b = may_show(&beam, tile, vload8(2 * (size_t)node + 1, boxes), &nearest_b);
#if TRI_COUNT
      ++passed->nodes;
      passed->boxes += 2;
#endif
      descends = a || b;
      if (descends) {
        bool second = b && (!a || nearest_b < nearest_a);
        node = 2 * node + (second ? 1 : 0);
        trail = 2 * trail + (a && b ? 0 : 1);
      }
    }
    if (!descends) {
      uint up = popcount((trail ^ (trail + 1)) >> 1);  // number of ones at the end of the trail
      node >>= up;
      trail = trail >> up | 1;
      node = node > 1 ? node ^ 1 : 0;
    }
  }
}

// Runs one work item per tile. Draws only every stride-th tile.
__kernel void trace_tiles(__global const Particles* restrict parameters, uint4 shape, uint stride,
                          __global const float* restrict boxes,
                          __global const float* restrict tree_spheres,
                          __global const uint* restrict tree_order, __global float* restrict depths,
                          __global uint* restrict winners, __global uint* restrict counters) {
  Particles u = *parameters;
  uint number = (uint)get_global_id(0) * stride;
  uint across = (uint)tiles_across(&u);
  Tile tile;
  open_tile(&u, (int)(number % across) << TRI_TILE_SHIFT, (int)(number / across) << TRI_TILE_SHIFT, &tile);
  Passed passed = {0, 0, 0};
  if (shape.x > 0) trace_tile(&u, shape, boxes, tree_spheres, tree_order, &tile, &passed);
  store_tile(&u, &tile, depths, winners, 0);
#if TRI_COUNT
  counters[8 * number + TRI_COUNT_NODES] += passed.nodes;
  counters[8 * number + TRI_COUNT_BOXES] += passed.boxes;
  counters[8 * number + TRI_COUNT_INTERSECTIONS] += passed.intersections;
#endif
}
