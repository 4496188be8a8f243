// Rays, and the runs of samples along them that lie in visible bricks.
//
// Brick skipping (skip=bricks) walks from brick to brick. Distance skipping (skip=distance,
// TRI_LEAPS) leaps over whole cubes of bricks that are all visible or all invisible. Because of
// rounding, a sample close to a face may be assigned to either side. That does not affect the
// image, because invisible bricks add nothing to it: the images with leaps, with a walk and without
// bricks are bit-identical.
//
// brick_map is the result of technique::brick_map. For leaps, n > 0 means that all bricks fewer
// than n bricks away (the largest distance along any axis) are visible, and n < 0 means that all
// bricks fewer than −n bricks away are invisible.

typedef struct {
  real3 p0;    // where the ray enters the box, in voxels
  real3 g;     // one step, in voxels
  real3 d;     // unit direction in world space
  real steps;  // length inside the box, in steps
#if TRI_TRACE
  __global uint* trace;  // where the ray's records are written; null unless the pixel is traced
#endif
} Ray;

TRI_FN Ray make_ray(__constant Parameters* u, int2 pixel) {
  real2 ndc = (2.0f * (TRI_REAL2(pixel) + 0.5f)) / TRI_REAL2(u->viewport.xy) - 1.0f;
  real3 d = u->ray_centre.xyz + ndc.x * u->ray_right.xyz - ndc.y * u->ray_up.xyz;
  d = d / sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  real3 v = d * u->inverse_spacing.xyz;
  // If the eye is far away, the ray begins on a plane between the eye and the box; otherwise it
  // begins at the eye.
  real3 origin = u->eye.xyz + (u->value_map.z * (ndc.x * u->ray_right.xyz - ndc.y * u->ray_up.xyz)) *
                                   u->inverse_spacing.xyz;
  real2 x = tri_slab(origin.x, v.x, (real)u->volume_size.x);
  real2 y = tri_slab(origin.y, v.y, (real)u->volume_size.y);
  real2 z = tri_slab(origin.z, v.z, (real)u->volume_size.z);
  real t0 = max(max(x.x, y.x), max(z.x, TRI_TO_REAL(0)));
  real t1 = min(min(x.y, y.y), z.y);
  Ray ray;
  ray.d = d;
  ray.g = v * u->eye.w;
  ray.p0 = origin + t0 * v;
  ray.steps = t1 > t0 ? (t1 - t0) / u->eye.w : 0.0f;
  return ray;
}

#if TRI_PARTS
TRI_FN int cell_is_here(__constant Parameters* u, int cell) {
  return cell >= u->part.x && cell < u->part.y;
}

// Returns whether this part contains the voxels that fetch() reads for the position `along` steps
// from the beginning of the ray.
TRI_FN int is_here(__constant Parameters* u, const Ray* ray, real along) {
  real z = ray->p0.z + along * ray->g.z;
  return cell_is_here(u, (int)clamp_coordinate(z + 0.5f, (real)u->volume_size.z));
}
#endif

// Returns whether there is anything to skip. With leaps, the first entry of the map is enough to
// recognize a volume without empty bricks.
TRI_FN int skips(__constant Parameters* u, __global const int* brick_map) {
  int4 grid = u->brick_grid;
  int full = max(grid.x, max(grid.y, grid.z));  // what the map contains for a volume without empty bricks
  return TRI_LEAPS == 1 ? grid.w > 0 && brick_map[0] < full : grid.w > 0;
}

// The counts along a ray in a counting build. Other builds discard them.
typedef struct {
  uint samples;
  uint nonzero;
  uint bricks_visited;
  uint bricks_skipped;
  uint terminated;
} Counts;

// Writes the counts of a pixel, in the order of technique::raycast_counters.
TRI_FN void store_counts(__global uint* to, const Counts* counts, int hit, uint saved) {
  to[0] = (uint)hit;
  to[1] = counts->samples;
  to[2] = counts->nonzero;
  to[3] = counts->bricks_visited;
  to[4] = counts->bricks_skipped;
  to[5] = counts->terminated;
  to[6] = saved;
}

// The light that a ray has gathered so far.
typedef struct {
  real4 sum;  // premultiplied colour; w is not used
  real transmittance;
} Gathered;

#if !TRI_LEAPS

// A walk through the bricks along a ray (3D DDA, Amanatides & Woo 1987). Crossings are computed
// from the index of the brick instead of being accumulated, so that they do not drift.
typedef struct {
  int3 brick;
  int3 direction;  // −1 or +1 per axis
  real3 inverse_g;
  real leave;  // where the ray leaves the brick, in steps
  int axis;     // the axis of the face where the ray leaves the brick
  int outside;  // round-off led out of the grid, so the rest of the ray counts as visible
  int merged;   // whether the samples of the last run are to be merged
} Walk;

TRI_FN void aim(__constant Parameters* u, Walk* walk, const Ray* ray) {
  real3 face = TRI_REAL3((walk->brick + max(walk->direction, (int3)(0))) * u->brick_grid.w);
  real3 at = (face - ray->p0) * walk->inverse_g;
  at.x = ray->g.x == 0.0f ? 3.0e38f : at.x;
  at.y = ray->g.y == 0.0f ? 3.0e38f : at.y;
  at.z = ray->g.z == 0.0f ? 3.0e38f : at.z;
  walk->axis = at.x <= at.y ? (at.x <= at.z ? 0 : 2) : (at.y <= at.z ? 1 : 2);
  walk->leave = min(at.x, min(at.y, at.z));
}

TRI_FN Walk start_walk(__constant Parameters* u, const Ray* ray) {
  Walk walk;
  walk.brick = clamp(convert_int3(ray->p0 / (real)u->brick_grid.w), (int3)(0),
                     u->brick_grid.xyz - 1);
  walk.direction = (int3)(ray->g.x < 0.0f ? -1 : 1, ray->g.y < 0.0f ? -1 : 1,
                          ray->g.z < 0.0f ? -1 : 1);
  walk.inverse_g = 1.0f / ray->g;
  walk.outside = 0;
  walk.merged = 0;
  aim(u, &walk, ray);
  return walk;
}

TRI_FN void next_brick(__constant Parameters* u, Walk* walk, const Ray* ray) {
  walk->brick.x += walk->axis == 0 ? walk->direction.x : 0;
  walk->brick.y += walk->axis == 1 ? walk->direction.y : 0;
  walk->brick.z += walk->axis == 2 ? walk->direction.z : 0;
  walk->outside = any(walk->brick < (int3)(0)) || any(walk->brick >= u->brick_grid.xyz);
  aim(u, walk, ray);
}

// The technique::BrickKind of the brick that the walk has reached.
#define KIND_INVISIBLE 0
#define KIND_SAMPLED 1
#define KIND_MERGED 2  // this and all larger numbers
TRI_FN int kind(__constant Parameters* u, __global const int* brick_map, const Walk* walk) {
  if (walk->outside) return KIND_SAMPLED;
  int index = walk->brick.x +
              u->brick_grid.x * (walk->brick.y + u->brick_grid.y * walk->brick.z);
  return brick_map[index];
}

// Returns the first sample that is beyond the brick, but at most `limit`. A sample close to the
// face may be assigned to either side, because the brick's border of one voxel allows for an error
// of half a voxel.
TRI_FN int samples_before(const Walk* walk, int limit) {
  if (walk->outside || !(walk->leave < (real)limit)) return limit;
  return clamp((int)tri_ceil(walk->leave - 0.5f), 0, limit);
}

// Narrows [begin, end) to the next run of samples, at or after `begin`, that lie in visible bricks
// of the same kind. The result is empty at the end of the ray. A brick of kind KIND_MERGED is
// always a run of its own.
TRI_FN int2 next_run(__constant Parameters* u, __global const int* brick_map, Walk* walk,
                     const Ray* ray, int begin, int end, Counts* counts) {
  int here = kind(u, brick_map, walk);
  while (begin < end && here == KIND_INVISIBLE) {
    begin = max(begin, samples_before(walk, end));
    next_brick(u, walk, ray);
    here = kind(u, brick_map, walk);
    counts->bricks_visited++;
    counts->bricks_skipped++;
  }
  int stop = begin;
  int first = here;
  walk->merged = first >= KIND_MERGED;
  while (stop < end && here == first && !(first == KIND_MERGED && stop > begin)) {
    stop = max(stop, samples_before(walk, end));
    next_brick(u, walk, ray);
    here = kind(u, brick_map, walk);
    counts->bricks_visited++;
  }
  return (int2)(begin, stop);
}

#else

// The data of a ray that are needed for leaps.
typedef struct {
  real3 p0;  // where the ray enters, relative to the corner of the brick grid (technique::BrickLayout::of_cells)
  real3 inverse_g;
  real edge;  // edge of a brick, in voxels
  real inverse_edge;
} Walk;

// Returns 1/g. For a ray parallel to a face, returns ±10²⁰ instead of dividing by zero, so that the
// ray never reaches the next face.
TRI_FN real inverse_step(real g) {
  return 1.0f / (fabs(g) > 1.0e-20f ? g : 1.0e-20f);
}

TRI_FN Walk start_walk(__constant Parameters* u, const Ray* ray) {
  Walk walk;
  walk.inverse_g =
      (real3)(inverse_step(ray->g.x), inverse_step(ray->g.y), inverse_step(ray->g.z));
  walk.p0 = ray->p0 - 0.5f;
  walk.edge = (real)u->brick_grid.w;
  walk.inverse_edge = 1.0f / walk.edge;
  return walk;
}

TRI_FN int brick_at(real p, real inverse_edge, int bricks) {
  int brick = (int)(p * inverse_edge);
  return brick < 0 ? 0 : (brick < bricks ? brick : bricks - 1);
}

// Returns the distance, in steps, at which a ray leaves the range of bricks that are fewer than
// `reach` bricks away from `brick` along one axis.
TRI_FN real crossing(real p0, real inverse_g, real edge, int brick, int reach) {
  int face = inverse_g < 0.0f ? brick - reach + 1 : brick + reach;
  return ((real)face * edge - p0) * inverse_g;
}

// Returns the first sample after sample i that is beyond the cube of bricks of the same kind, but
// at most `end`. Each leap starts from the position of its sample, so rounding errors do not
// accumulate.
TRI_FN int leap(__constant Parameters* u, __global const int* brick_map, const Walk* walk,
                const Ray* ray, int i, int end, int* visible) {
  real along = (real)i + 0.5f;
  int4 grid = u->brick_grid;
  int x = brick_at(walk->p0.x + along * ray->g.x, walk->inverse_edge, grid.x);
  int y = brick_at(walk->p0.y + along * ray->g.y, walk->inverse_edge, grid.y);
  int z = brick_at(walk->p0.z + along * ray->g.z, walk->inverse_edge, grid.z);
  int signed_reach = brick_map[x + grid.x * (y + grid.y * z)];
  *visible = signed_reach > 0;
  int reach = *visible ? signed_reach : -signed_reach;
  real at_x = crossing(walk->p0.x, walk->inverse_g.x, walk->edge, x, reach);
  real at_y = crossing(walk->p0.y, walk->inverse_g.y, walk->edge, y, reach);
  real at_z = crossing(walk->p0.z, walk->inverse_g.z, walk->edge, z, reach);
  real leave = at_x < at_y ? at_x : at_y;
  leave = at_z < leave ? at_z : leave;
  if (!(leave < (real)end)) return end;
  int next = (int)tri_ceil(leave - 0.5f);
  next = next > i ? next : i + 1;
  return next < end ? next : end;
}

// Narrows [begin, end) to the next run of visible bricks at or after `begin`. The result is empty
// at the end of the ray.
TRI_FN int2 next_run(__constant Parameters* u, __global const int* brick_map, Walk* walk,
                     const Ray* ray, int begin, int end, Counts* counts) {
  int visible = 0;
  int stop = begin;
  while (!visible && stop < end) {
    begin = stop;
    stop = leap(u, brick_map, walk, ray, begin, end, &visible);
    counts->bricks_visited++;
    counts->bricks_skipped += !visible;
  }
  if (!visible) return (int2)(end, end);
  // Extends the run to the next invisible brick, so that no count depends on the batch size.
  while (visible && stop < end) {
    int beyond = leap(u, brick_map, walk, ray, stop, end, &visible);
    counts->bricks_visited += visible;
    stop = visible ? beyond : stop;
  }
  return (int2)(begin, stop);
}

#endif

