// The quadrature `cells`, which integrates each ray cell by cell, with one ray per work item. A
// cell is the space between eight voxel centres. The algorithm is explained in
// src/technique/volume/raycast/raycast_cells.glsl.
//
// Compile-time constants: TRI_SHADING, TRI_COUNT, and those of volume.cl.

typedef struct {
  float3 p0;         // where the ray enters, relative to the centre of the first voxel
  float3 g;          // one step, in voxels
  float3 inverse_g;
  int3 forward;      // 1 if the ray runs towards higher indices, else 0
} Way;

TRI_FN float inverse_of(float g) { return 1.0f / (fabs(g) < 1.0e-20f ? 1.0e-20f : g); }

TRI_FN Way make_way(const Ray* ray) {
  Way way;
  way.p0 = ray->p0 - 0.5f;
  way.g = ray->g;
  way.inverse_g = (float3)(inverse_of(ray->g.x), inverse_of(ray->g.y), inverse_of(ray->g.z));
  way.forward = -(way.inverse_g > 0.0f);
  return way;
}

TRI_FN float3 crossings(const Way* way, int3 planes) {
  return (convert_float3(planes) - way->p0) * way->inverse_g;
}
TRI_FN float3 entries(const Way* way, int3 cell) { return crossings(way, cell + 1 - way->forward); }
TRI_FN float3 exits(const Way* way, int3 cell) { return crossings(way, cell + way->forward); }
TRI_FN float least(float3 v) {
  float two = v.x < v.y ? v.x : v.y;
  return two < v.z ? two : v.z;
}

// Returns, for each component of `a`, 1 if it is at most t, and 0 otherwise.
TRI_FN int3 not_after(float3 a, float t) { return -(a <= (float3)(t)); }

TRI_FN int3 cell_behind(const Way* way, int3 planes, float3 at) {
  float t = least(at);
  int3 direction = 2 * way->forward - 1;
  float3 p = way->p0 + t * way->g;
  int3 cell = (int3)((int)tri_floor(p.x), (int)tri_floor(p.y), (int)tri_floor(p.z));
  cell += direction * not_after(exits(way, cell), t);
  cell -= direction * (1 - not_after(entries(way, cell), t));
  int3 crossed = not_after(at, t);
  return crossed * (planes - 1 + way->forward) + (1 - crossed) * cell;
}

// Evaluates c.x + c.y·s + c.z·s² + c.w·s³.
TRI_FN float cubic(float4 c, float s) { return c.x + s * (c.y + s * (c.z + s * c.w)); }

// Returns the position in the transfer function's table as a cubic polynomial along the ray's path
// through a cell.
TRI_FN float4 cubic_of_cell(__constant Parameters* u, TRI_VOLUME volume, int3 cell, float3 a, float3 b) {
#if TRI_FAULT == FAULT_HALF_VOXEL_SHIFT
  a.x += 0.5f;
#endif
#if TRI_FAULT == FAULT_COARSE_FILTER
  a = floor(a * 256.0f + 0.5f) / 256.0f;
#endif
  // Because of the border of the voxel buffer, the first voxel of a cell has the cell's index plus
  // one along each axis.
  int row = u->volume_size.x + 2;
  int slice = row * (u->volume_size.y + 2);
#if TRI_FAULT == FAULT_FLIPPED_AXIS
  int near_row = u->volume_size.y - cell.y;
  int far_row = near_row - 1;
#else
  int near_row = cell.y + 1;
  int far_row = near_row + 1;
#endif
  TRI_VOLUME first = volume + (cell.x + 1 + slice * held_layer(u, cell.z + 1));
  TRI_VOXEL4 low =
      (TRI_VOXEL4)(TRI_LOAD2(first + row * near_row), TRI_LOAD2(first + row * far_row));
  TRI_VOXEL4 high = (TRI_VOXEL4)(TRI_LOAD2(first + slice + row * near_row),
                                 TRI_LOAD2(first + slice + row * far_row));
  float4 v0 = (float4)(convert_float4(low).xz, convert_float4(high).xz);
  float4 v1 = (float4)(convert_float4(low).yw, convert_float4(high).yw);
  // interpolation along x on the four edges: the constant terms, …
  float4 x0 = v0 + a.x * (v1 - v0);
  float4 x1 = b.x * (v1 - v0);       // … and the terms that are linear in s
  float2 rise0 = x0.yw - x0.xz;
  float2 rise1 = x1.yw - x1.xz;
  float2 y0 = x0.xz + a.y * rise0;
  float2 y1 = x1.xz + a.y * rise1 + b.y * rise0;
  float2 y2 = b.y * rise1;
  float z0 = y0.y - y0.x;
  float z1 = y1.y - y1.x;
  float z2 = y2.y - y2.x;
  float4 c = (float4)(y0.x + a.z * z0, y1.x + a.z * z1 + b.z * z0, y2.x + a.z * z2 + b.z * z1, b.z * z2);
  c *= 256.0f * u->value_map.x;
  c.x += 256.0f * u->value_map.y - 0.5f;
  return c;
}

// Reads a row of technique::kink_table.
TRI_FN float4 kink_row(__global const float4* kinks, float i) {
  return kinks[(int)(i > 0.0f ? (i < 256.0f ? i : 256.0f) : 0.0f)];
}

TRI_FN float table_end(float position) { return position > 0.0f ? (position < 255.0f ? position : 255.0f) : 0.0f; }

// Returns whether any position along the path may have opacity. The Bernstein coefficients of the
// cubic bound the positions in the table.
TRI_FN int shows(__global const float4* kinks, float4 c) {
  float b1 = c.x + c.y / 3.0f;
  float b2 = c.x + (2.0f * c.y + c.z) / 3.0f;
  float b3 = c.x + c.y + c.z + c.w;
  float lowest = table_end(min(min(c.x, b1), min(b2, b3)));
  float highest = table_end(max(max(c.x, b1), max(b2, b3)));
  return kink_row(kinks, tri_floor(lowest)).z <= tri_ceil(highest);
}

TRI_FN float2 extrema(float4 c) {
  float discriminant = c.z * c.z - 3.0f * c.w * c.y;
  if (!(discriminant > 0.0f)) return (float2)(2.0f);
  float q = 0.0f - (c.z + (c.z < 0.0f ? -1.0f : 1.0f) * sqrt(discriminant));
  float e = c.w == 0.0f ? 2.0f : q / (3.0f * c.w);
  float f = q == 0.0f ? 2.0f : c.y / q;
  return e < f ? (float2)(e, f) : (float2)(f, e);
}

TRI_FN float where_it_is(float4 c, float value, float from, float to, float at_from, float at_to) {
  int rising = at_to > at_from;
  float r = (value - at_from) / (at_to - at_from);
  float slope = (c.y + from * (2.0f * c.z + from * (3.0f * c.w))) * (to - from) / (at_to - at_from);
  float square = slope * slope + 4.0f * (1.0f - slope) * r;
  float share = 2.0f * r / (slope + sqrt(square > 0.0f ? square : 0.0f));
  float s = from + (to - from) * (share > 0.0f ? (share < 1.0f ? share : 1.0f) : 0.0f);
  for (int i = 0; i < 4; ++i) {
    float error = cubic(c, s) - value;
    int before = (error < 0.0f) == rising;
    from = before ? s : from;
    to = before ? to : s;
    float newton = s - error / (c.y + s * (2.0f * c.z + s * (3.0f * c.w)));
    s = newton >= from && newton <= to ? newton : 0.5f * (from + to);
  }
  return s;
}

TRI_FN float4 transfer(__constant float4* table, float position) {
  float place = table_end(position);
  int below = (int)place;
  below = below < 254 ? below : 254;
  return table[below] + (place - (float)below) * (table[below + 1] - table[below]);
}

// Returns −log2(1 − alpha). An opacity of 1 gives 8192.
TRI_FN float extinction(float alpha) { return alpha < 1.0f ? 0.0f - tri_log2_1m(alpha) : 8192.0f; }

TRI_FN void add_piece(Gathered* gathered, float4 a, float4 b, float length) {
  float first = extinction(a.w);
  float second = extinction(b.w);
  float depth = 0.5f * length * (first + second);
  if (!(depth > 0.0f)) return;
  float opacity = tri_1m_exp2(-depth);
  float z = 0.3465735903f * depth;
  float langevin = z / (3.0f + tri_attenuation(z, opacity));
  float tilt = (second - first) / (first + second);
  float share = 0.5f * (1.0f + tilt - 1.7320508076f * langevin);
  share = share > 0.0f ? (share < 1.0f ? share : 1.0f) : 0.0f;
  float weight = gathered->transmittance * opacity;
  gathered->sum += weight * (a + share * (b - a));
  gathered->transmittance -= weight;
}

// The data that are the same for all cells.
typedef struct {
  __constant Parameters* u;
  TRI_VOLUME volume;
  __constant float4* table;
  __global const float4* kinks;
  const Ray* ray;
  float step_voxels;
} Surroundings;

TRI_FN void add_part(const Surroundings* in, Gathered* gathered, Counts* counts, float4 c, float s,
                     float next, float begin, float end) {
  float middle = 0.5f * (s + next);
  float apart = 0.2886751346f * (next - s);
  float4 a = transfer(in->table, cubic(c, middle - apart));
  float4 b = transfer(in->table, cubic(c, middle + apart));
  counts->samples += 2;
  if (!(a.w > 0.0f || b.w > 0.0f)) return;
  counts->nonzero += (a.w > 0.0f) + (b.w > 0.0f);
#if TRI_SHADING
  float3 at_a = in->ray->p0 + (begin + (middle - apart) * (end - begin)) * in->ray->g;
  float3 at_b = in->ray->p0 + (begin + (middle + apart) * (end - begin)) * in->ray->g;
  a = shade(in->u, in->volume, a, at_a, in->ray->d);
  b = shade(in->u, in->volume, b, at_b, in->ray->d);
#endif
  add_piece(gathered, a, b, in->step_voxels * (end - begin) * (next - s));
}

// Adds the part of a cell between `begin` and `end`.
TRI_FN void add_cell(const Surroundings* in, const Way* way, int3 cell, float begin, float end,
                     Gathered* gathered, Counts* counts) {
  if (!(end > begin)) return;
  float4 c = cubic_of_cell(in->u, in->volume, cell, way->p0 + begin * way->g - convert_float3(cell),
                           (end - begin) * way->g);
  if (!shows(in->kinks, c)) return;
  float2 turn = extrema(c);
  float part = 1.0f;
  float from = c.x;
  float start = 0.0f;
  float s = 0.0f;
  while (s < 1.0f) {
    float stop = part / in->u->shading.w;
    stop = stop < 1.0f ? stop : 1.0f;
    int whole = !(turn.x > s && turn.x < stop) && !(turn.y > s && turn.y < stop);
    if (turn.y > s && turn.y < stop) stop = turn.y;
    if (turn.x > s && turn.x < stop) stop = turn.x;
    float to = cubic(c, stop);
    float kink = to > from ? kink_row(in->kinks, tri_floor(from) + 1.0f).x
                           : kink_row(in->kinks, tri_ceil(from)).y;
    int cut = to > from ? kink < to : kink > to;
    float next = cut ? where_it_is(c, kink, s, stop, from, to) : stop;
    if (cut || whole) {
      add_part(in, gathered, counts, c, start, next, begin, end);
      start = next;
    }
    part += !cut && whole ? 1.0f : 0.0f;
    from = cut ? kink : to;
    s = next;
  }
}

// Returns whether the cell's brick is visible. Sets `planes` to the next planes along the ray, up
// to which the visibility does not change.
TRI_FN int look_around(__constant Parameters* u, __global const int* brick_map, const Way* way,
                       int3 cell, int3* planes) {
  int edge = u->brick_grid.w;
  int3 bricks = u->brick_grid.xyz;
  int3 last = u->volume_size.xyz - 1;
  int3 brick = clamp(cell, (int3)(0), bricks * edge - 1) / edge;
  int signed_reach = brick_map[brick.x + bricks.x * (brick.y + bricks.y * brick.z)];
  int reach = max(abs_diff(signed_reach, 0), 1u);
  int3 low = (brick + 1 - reach) * edge;
  int3 high = (brick + reach) * edge;
  low = low <= (int3)(0) ? (int3)(-1) : low;
  high = high >= last ? last + 1 : high;
  *planes = way->forward == 1 ? high : low;
  return signed_reach > 0;
}

#if TRI_PARTS
// The state of a ray that continues in the next part of the volume, as in raycast.cl.
typedef struct {
  Gathered gathered;
  Counts counts;
  int3 cell;
  float begin;
  float seen;
  float end;
} Pause;
#define TRI_PAUSES , __global Pause* pauses
#else
#define TRI_PAUSES
#endif

// Writes the image, the counters and the pauses (the states of rays that continue in the next part
// of the volume) as the kernel in raycast.cl does.
__kernel void raycast(__constant Parameters* u, TRI_VOLUME volume, __constant float4* table,
                      __global const int* brick_map, __global float4* image,
                      __global uint* counters, __global const float4* kinks TRI_PAUSES) {
  int x = (int)get_global_id(0);
  int y = (int)get_global_id(1);
  int2 pixel = (int2)(tri_drawn_column(x, y, u->viewport.w, u->viewport.z), y);
  if (pixel.x >= u->viewport.x || pixel.y >= u->viewport.y) return;
  Ray ray = make_ray(u, pixel);
  Way way = make_way(&ray);
#if TRI_FAULT == FAULT_EXTRA_SAMPLE
  if (ray.steps > 0.0f) ray.steps += 1.0f;
#endif
  Surroundings in = {u, volume, table, kinks, &ray,
                     TRI_FAULT == FAULT_UNCORRECTED_OPACITY ? 1.0f : u->ray_centre.w};
  Gathered gathered = {(float4)(0.0f), 1.0f};
  Counts counts = {0u, 0u, 0u, 0u, 0u};
  int3 cell = (int3)((int)tri_floor(way.p0.x), (int)tri_floor(way.p0.y), (int)tri_floor(way.p0.z));
  cell = clamp(cell, (int3)(-1), u->volume_size.xyz - 1);
  float begin = 0.0f;
  float seen = u->brick_grid.w > 0 ? 0.0f : 3.0e38f;  // up to here, all bricks are visible
  float end = ray.steps;
#if TRI_PARTS
  __global Pause* own =
      pauses + tri_output_place(x, y, u->viewport.x, u->viewport.y, u->viewport.w, (int)get_global_size(0));
  if (u->pass.x > 0) {
    Pause pause = *own;
    gathered = pause.gathered;
    counts = pause.counts;
    cell = pause.cell;
    begin = pause.begin;
    seen = pause.seen;
    end = pause.end;
  }
#endif
  while (begin < end) {
#if TRI_PARTS
    if (!cell_is_here(u, cell.z + 1)) break;
#endif
    int visible = 1;
    int3 planes = cell + way.forward;
    if (begin >= seen) {
      visible = look_around(u, brick_map, &way, cell, &planes);
      counts.bricks_visited++;
      counts.bricks_skipped += !visible;
      if (visible) {
        seen = least(crossings(&way, planes));
        planes = cell + way.forward;
      }
    }
    float3 at = crossings(&way, planes);
    float leave = least(at);
    if (visible) {
      add_cell(&in, &way, cell, begin, leave < ray.steps ? leave : ray.steps, &gathered, &counts);
      cell += not_after(at, leave) * (2 * way.forward - 1);
    } else {
      cell = cell_behind(&way, planes, at);
    }
    begin = leave > 0.0f ? leave : 0.0f;
    if (gathered.transmittance < u->ray_right.w) end = 0.0f;
  }
  counts.terminated = gathered.transmittance < u->ray_right.w;
#if TRI_PARTS
  *own = (Pause){gathered, counts, cell, begin, seen, end};
#endif
  int at = tri_output_place(x, y, u->viewport.x, u->viewport.y, u->viewport.w, (int)get_global_size(0));
  image[at] = (float4)(gathered.sum.xyz, 1.0f - gathered.transmittance) +
              gathered.transmittance * u->background;
#if TRI_COUNT
  store_counts(counters + 8 * at, &counts, ray.steps > 0.0f, 0u);
#endif
}
