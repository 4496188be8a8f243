// A walk through the bricks along a ray (3D DDA, Amanatides & Woo 1987). Crossings are computed from the brick's
// index and not accumulated, so that they do not drift: along axis a, the ray leaves brick b at
// first[a] + b[a]·spacing[a].
struct Walk {
  ivec3 brick;
  ivec3 direction;  // −1 or +1 per axis
  real3 first;      // in steps
  real3 spacing;    // in steps; 0 if the ray never crosses a face of this axis
  real3 at;         // distances, in steps, at which the ray crosses the brick's far face of each axis
  real leave;       // distance at which the ray leaves the brick: the smallest component of `at`
  bool visible;     // also true outside the grid, so that the rest of the ray is sampled if rounding leads there
  int kind;         // technique::BrickKind of a visible brick, with TRI_ADAPT
  bool outside;
  ivec3 size;       // bricks per axis
};

void enter(inout Walk walk) {
  ivec3 size = walk.size;
  walk.at = walk.first + real3(walk.brick) * walk.spacing;
  walk.leave = min(walk.at.x, min(walk.at.y, walk.at.z));
  // Negative indices, read as unsigned numbers, also exceed the size.
  walk.outside = any(greaterThanEqual(uvec3(walk.brick), uvec3(size)));
  int index = walk.brick.x + size.x * (walk.brick.y + size.y * walk.brick.z);
  int kind = walk.outside ? 1 : brick_at(walk.outside ? 0 : index);
  walk.visible = kind != 0;
  walk.kind = TRI_ADAPT == 1 ? kind : 1;
}

Walk start_walk(Ray ray) {
  real edge = real(u.brick_grid.w);
  Walk walk;
  walk.size = u.brick_grid.xyz;
  walk.brick = clamp(ivec3(floor(ray.p0 / edge)), ivec3(0), walk.size - 1);
  walk.direction = ivec3(ray.g.x < 0.0 ? -1 : 1, ray.g.y < 0.0 ? -1 : 1, ray.g.z < 0.0 ? -1 : 1);
  real3 inverse_g = 1.0 / ray.g;
  walk.spacing = edge * inverse_g;
  walk.first = (edge * real3(max(walk.direction, ivec3(0))) - ray.p0) * inverse_g;
  bvec3 parallel = equal(ray.g, real3(0.0));
  walk.spacing = mix(walk.spacing, real3(0.0), parallel);
  walk.first = mix(walk.first, real3(3.0e38), parallel);
  enter(walk);
  return walk;
}

void next_brick(inout Walk walk) {
  bool x = walk.at.x <= walk.leave;
  bool y = !x && walk.at.y <= walk.leave;
  walk.brick += walk.direction * ivec3(x, y, !x && !y);
  enter(walk);
}

// Returns the first sample beyond the brick, but at most `limit`. A sample within rounding error of a face may be
// assigned to either side, because the brick's border of one voxel covers an error of half a voxel.
int samples_before(Walk walk, int limit) {
  return walk.outside || !(walk.leave < real(limit)) ? limit : clamp(int(ceil(walk.leave - 0.5)), 0, limit);
}

// Narrows the range of samples [begin, end) to its first run of samples in visible bricks of one kind
// (technique::BrickKind). The result is empty at the end of the ray. `merged` is set if the run is to be taken as one
// sample. Each brick of kind 2 (BrickKind::merged) forms its own run.
ivec2 next_run(inout Walk walk, int begin, int end, out bool merged) {
  while (begin < end && !walk.visible) {
    begin = max(begin, samples_before(walk, end));
    next_brick(walk);
    if (TRI_COUNT == 1) { count_bricks_visited++; count_bricks_skipped++; }
  }
  int stop = begin;
  int kind = walk.kind;
  merged = kind >= 2;
  while (stop < end && walk.visible && walk.kind == kind && !(kind == 2 && stop > begin)) {
    stop = max(stop, samples_before(walk, end));
    next_brick(walk);
    if (TRI_COUNT == 1) count_bricks_visited++;
  }
  return ivec2(begin, stop);
}

// Leaps over whole cubes of bricks that are all visible or all invisible (technique::Skip::distance). Each leap
// starts from the exact position of a sample, so errors do not accumulate.
struct Leaps {
  real3 p0;    // entry point of the ray, relative to the first voxel's centre, where the first brick begins
  real3 inverse_g;
  real edge;   // edge of a brick, in voxels
  real inverse_edge;
  ivec3 size;  // bricks per axis
};

Leaps make_leaps(Ray ray) {
  Leaps leaps;
  leaps.p0 = ray.p0 - 0.5;
  // To avoid a division by zero, a ray parallel to a face is assumed to need 10²⁰ steps to the next face.
  leaps.inverse_g = 1.0 / mix(ray.g, real3(1.0e-20), lessThan(abs(ray.g), real3(1.0e-20)));
  leaps.edge = real(u.brick_grid.w);
  leaps.inverse_edge = 1.0 / leaps.edge;
  leaps.size = u.brick_grid.xyz;
  return leaps;
}

// Whether the brick that contains sample i is visible, and the first sample beyond the cube of bricks around it that
// are all visible or all invisible (technique::brick_reach), but at most `end`. A sample within rounding error of a
// face may be assigned to either side, as in a walk.
struct Leap {
  bool visible;
  int next;
};

Leap leap(Leaps leaps, Ray ray, int i, int end) {
  real3 p = leaps.p0 + (real(i) + 0.5) * ray.g;
  ivec3 brick = clamp(ivec3(p * leaps.inverse_edge), ivec3(0), leaps.size - 1);
  int signed_reach = brick_at(brick.x + leaps.size.x * (brick.y + leaps.size.y * brick.z));
  int reach = abs(signed_reach);
  // This is computed axis by axis, because mix() on integers requires GLSL 4.50.
  int back = 1 - reach;
  ivec3 face = brick + ivec3(leaps.inverse_g.x < 0.0 ? back : reach, leaps.inverse_g.y < 0.0 ? back : reach,
                             leaps.inverse_g.z < 0.0 ? back : reach);
  real3 at = (real3(face) * leaps.edge - leaps.p0) * leaps.inverse_g;
  real leave = min(at.x, min(at.y, at.z));
  // `reach` is the distance to the nearest brick with the other visibility, which is at least 1. However, llvmpipe
  // (Mesa 22.3) also runs helper invocations outside the triangle, which read 0 from the brick map. Without the
  // condition reach > 0, they would advance by only one sample at a time, and all other invocations of the block
  // would wait for them.
  int next = reach > 0 && leave < real(end) ? int(ceil(leave - 0.5)) : end;
  return Leap(signed_reach > 0, clamp(next, i + 1, end));
}

// Returns the same run as next_run(), found by leaps.
ivec2 next_run_by_leaps(Leaps leaps, Ray ray, int begin, int end) {
  Leap ahead = Leap(false, begin);
  while (begin < end && !ahead.visible) {
    begin = ahead.next;
    if (begin < end) {
      ahead = leap(leaps, ray, begin, end);
      if (TRI_COUNT == 1) {
        count_bricks_visited++;
        if (!ahead.visible) count_bricks_skipped++;
      }
    }
  }
  int stop = begin;
  while (stop < end && ahead.visible) {
    stop = ahead.next;
    if (stop < end) {
      ahead = leap(leaps, ray, stop, end);
      if (TRI_COUNT == 1 && ahead.visible) count_bricks_visited++;
    }
  }
  return ivec2(begin, stop);
}

// Returns whether there is anything to skip. With leaps, this is not the case if all bricks are visible; the reach
// of any brick is then the length of the grid's longest edge. `nothing` is always 0 but depends on the ray. If the
// condition depended only on parameters, lavapipe (Mesa 22.3) would compile a separate shader for every submission,
// with the values of the parameters inlined, which takes up to 1.5 ms.
bool skips(Ray ray) {
  int longest = max(u.brick_grid.x, max(u.brick_grid.y, u.brick_grid.z));
  int nothing = min(0, int(ray.steps));
  return u.brick_grid.w > nothing && (TRI_LEAPS == 0 || brick_at(0) < longest);
}
