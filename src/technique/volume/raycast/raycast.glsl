// Front-to-back raycasting of one pixel: the body shared by Vulkan and GL, by compute and fragment.
// Positions are in voxels, lengths along the ray in steps: sample i stands at p0 + (i+½)·g.

const int fault_half_voxel_shift = 1;
const int fault_flipped_axis = 2;
const int fault_extra_sample = 3;
const int fault_uncorrected_opacity = 4;
const int fault_coarse_filter = 5;

// Counted only where TRI_COUNT is 1; the timed build drops it.
uint count_samples = 0u;
uint count_nonzero = 0u;
uint count_bricks_visited = 0u;
uint count_bricks_skipped = 0u;
uint count_terminated = 0u;

// What every sample needs of the parameters, loaded once per ray: a uniform named inside the loop is
// loaded again for every sample by compilers that do not move loads out of loops.
struct Grid {
  real3 inverse_size;
  ivec3 last;           // largest index per axis
  real2 value_map;
  real stored_maximum;  // in double precision, of voxels that are integers; else 0
};

Grid load_grid() {
  Grid grid;
  grid.inverse_size = 1.0 / real3(u.volume_size.xyz);
  grid.last = u.volume_size.xyz - 1;
  grid.value_map = u.value_map.xy;
  grid.stored_maximum = u.value_map.w;
  return grid;
}

// What is stored. A texel of u8 or u16 is its integer over the largest one, rounded to float: doubles get
// the integer itself.
real voxel(Grid grid, ivec3 at) {
  float texel = texelFetch(volume_texture, at, 0).r;
#if TRI_PRECISION == 64
  if (grid.stored_maximum > 0.0) return floor(real(texel) * grid.stored_maximum + 0.5);
#endif
  return texel;
}

// Trilinear by hand: texels floor(q), floor(q)+1 with q = p − ½, clamped to the edge.
real fetch_manual(Grid grid, real3 p) {
  real3 q = p - 0.5;
  real3 base = floor(q);
  real3 f = q - base;
  if (TRI_FAULT == fault_coarse_filter) f = floor(f * 256.0 + 0.5) / 256.0;
  ivec3 a = clamp(ivec3(base), ivec3(0), grid.last);
  ivec3 b = clamp(ivec3(base) + 1, ivec3(0), grid.last);
  real v000 = voxel(grid, ivec3(a.x, a.y, a.z));
  real v100 = voxel(grid, ivec3(b.x, a.y, a.z));
  real v010 = voxel(grid, ivec3(a.x, b.y, a.z));
  real v110 = voxel(grid, ivec3(b.x, b.y, a.z));
  real v001 = voxel(grid, ivec3(a.x, a.y, b.z));
  real v101 = voxel(grid, ivec3(b.x, a.y, b.z));
  real v011 = voxel(grid, ivec3(a.x, b.y, b.z));
  real v111 = voxel(grid, ivec3(b.x, b.y, b.z));
  real4 x0 = real4(v000, v010, v001, v011);
  real4 x1 = real4(v100, v110, v101, v111);
  real4 x = x0 + f.x * (x1 - x0);
  real2 y = x.xz + f.y * (x.yw - x.xz);
  return y.x + f.z * (y.y - y.x);
}

real fetch_hardware(Grid grid, real3 p) {
  if (TRI_FAULT == fault_coarse_filter) {
    real3 q = p - 0.5;
    p = floor(q) + floor(fract(q) * 256.0 + 0.5) / 256.0 + 0.5;
  }
  return textureLod(volume_texture, vec3(p * grid.inverse_size), 0.0).r;
}

// Normalised value at p.
real field(Grid grid, real3 p) {
  if (TRI_FAULT == fault_half_voxel_shift) p.x += 0.5;
  if (TRI_FAULT == fault_flipped_axis) p.y = real(grid.last.y + 1) - p.y;
  real stored = TRI_MANUAL_SAMPLER == 1 ? fetch_manual(grid, p) : fetch_hardware(grid, p);
  return stored * grid.value_map.x + grid.value_map.y;
}

real4 transfer(real x) {
  real position = tri_table_position(x);
  int k = min(int(position), 254);
  real4 a = real4(texelFetch(transfer_texture, k, 0));
  real4 b = real4(texelFetch(transfer_texture, k + 1, 0));
  return a + (position - real(k)) * (b - a);
}

// Headlight shading (scene::Shading): d is the world direction of the ray.
real3 shade(Grid grid, real3 colour, real3 p, real3 d) {
  real3 g = real3(field(grid, p + real3(1, 0, 0)) - field(grid, p - real3(1, 0, 0)),
                  field(grid, p + real3(0, 1, 0)) - field(grid, p - real3(0, 1, 0)),
                  field(grid, p + real3(0, 0, 1)) - field(grid, p - real3(0, 0, 1)));
  g *= 0.5 * u.inverse_spacing.w * u.inverse_spacing.xyz;
  real cosine = abs(dot(g, d)) / max(sqrt(dot(g, g)), u.ray_up.w);
  real highlight = cosine;
#if TRI_LONG_RAYS
  // Of constant length, hence written out by compilers: no pass of a loop (raycast()).
  for (int i = 0; i < 31; ++i) highlight *= i < u.volume_size.w ? highlight : 1.0;
#else
  for (int i = 0; i < u.volume_size.w; ++i) highlight *= highlight;
#endif
  return colour * (u.shading.x + u.shading.y * cosine) + u.shading.z * highlight;
}

struct Ray {
  real3 p0;    // where the ray enters the box, voxels
  real3 g;     // one step, voxels
  real3 d;     // unit direction, world
  real steps;  // length inside the box, steps
};

Ray make_ray(ivec2 pixel) {
  real2 ndc = (2.0 * (real2(pixel) + 0.5)) / real2(u.viewport.xy) - 1.0;
  real3 d = u.ray_centre.xyz + ndc.x * u.ray_right.xyz - ndc.y * u.ray_up.xyz;
  d = d / sqrt(dot(d, d));
  real3 v = d * u.inverse_spacing.xyz;
  real3 size = real3(u.volume_size.xyz);
  // Where the ray begins: on a plane between eye and box where that is far away, else at the eye.
  real3 origin = u.eye.xyz +
                 (u.value_map.z * (ndc.x * u.ray_right.xyz - ndc.y * u.ray_up.xyz)) * u.inverse_spacing.xyz;
  real2 x = tri_slab(origin.x, v.x, size.x);
  real2 y = tri_slab(origin.y, v.y, size.y);
  real2 z = tri_slab(origin.z, v.z, size.z);
  real t0 = max(max(x.x, y.x), max(z.x, 0.0));
  real t1 = min(min(x.y, y.y), z.y);
  Ray ray;
  ray.d = d;
  ray.g = v * u.eye.w;
  ray.p0 = origin + t0 * v;
  ray.steps = t1 > t0 ? (t1 - t0) / u.eye.w : 0.0;
  return ray;
}

// A walk through the bricks along a ray (3D DDA, Amanatides & Woo 1987). Crossings are computed from the
// brick's index, not accumulated, so that they do not drift: the ray leaves brick b through a face of
// axis a at first[a] + b[a]·spacing[a].
struct Walk {
  ivec3 brick;
  ivec3 direction;  // −1 or +1 per axis
  real3 first;      // steps
  real3 spacing;    // steps; 0 where the ray never crosses
  real3 at;         // where the ray crosses the brick's far face of each axis, steps
  real leave;       // where it leaves the brick: the least of them
  bool visible;     // also true outside the grid, where rounding can lead: that rest of a ray is sampled
  int kind;         // technique::BrickKind of a visible brick, with TRI_ADAPT
  bool outside;
  ivec3 size;       // bricks per axis
};

void enter(inout Walk walk) {
  ivec3 size = walk.size;
  walk.at = walk.first + real3(walk.brick) * walk.spacing;
  walk.leave = min(walk.at.x, min(walk.at.y, walk.at.z));
  // As unsigned numbers, negative indices are beyond the end too.
  walk.outside = any(greaterThanEqual(uvec3(walk.brick), uvec3(size)));
  int index = walk.brick.x + size.x * (walk.brick.y + size.y * walk.brick.z);
  int kind = walk.outside ? 1 : brick_visible[walk.outside ? 0 : index];
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

// The first sample at or behind `limit` that lies beyond the brick. A sample within rounding of the face
// may be counted to either side: the brick's border of one voxel covers half a voxel of error.
int samples_before(Walk walk, int limit) {
  return walk.outside || !(walk.leave < real(limit)) ? limit : clamp(int(ceil(walk.leave - 0.5)), 0, limit);
}

// Narrows [begin, end) to the next run of visible bricks of one kind at or after begin; empty at the end of the
// ray. `merged`: the run is to be taken as one sample. A brick of kind 2 is a run of its own.
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

// Leaps over whole cubes of bricks of one kind (technique::Skip::distance). Each starts from its sample's
// own position, so nothing drifts.
struct Leaps {
  real3 p0;    // where the ray enters, from where the bricks begin: the first voxel's centre
  real3 inverse_g;
  real edge;   // of a brick, voxels
  real inverse_edge;
  ivec3 size;  // bricks per axis
};

Leaps make_leaps(Ray ray) {
  Leaps leaps;
  leaps.p0 = ray.p0 - 0.5;
  // A ray that runs along a face takes 10²⁰ steps to the next: never, without dividing by zero.
  leaps.inverse_g = 1.0 / mix(ray.g, real3(1.0e-20), lessThan(abs(ray.g), real3(1.0e-20)));
  leaps.edge = real(u.brick_grid.w);
  leaps.inverse_edge = 1.0 / leaps.edge;
  leaps.size = u.brick_grid.xyz;
  return leaps;
}

// brick_reach of the brick that holds sample i, and the first sample behind it that lies beyond the cube of
// bricks that are like that one; `end` at most. A sample within rounding of a face may be counted to
// either side, as by a walk.
struct Leap {
  bool visible;
  int next;
};

Leap leap(Leaps leaps, Ray ray, int i, int end) {
  real3 p = leaps.p0 + (real(i) + 0.5) * ray.g;
  ivec3 brick = clamp(ivec3(p * leaps.inverse_edge), ivec3(0), leaps.size - 1);
  int signed_reach = brick_visible[brick.x + leaps.size.x * (brick.y + leaps.size.y * brick.z)];
  int reach = abs(signed_reach);
  ivec3 face = brick + mix(ivec3(reach), ivec3(1 - reach), lessThan(leaps.inverse_g, real3(0.0)));
  real3 at = (real3(face) * leaps.edge - leaps.p0) * leaps.inverse_g;
  real leave = min(at.x, min(at.y, at.z));
  // No brick has reach 0: it is what a fragment that is drawn for its neighbours' sake reads on llvmpipe
  // (Mesa 22.3). Else that one would go from sample to sample, and all wait for it.
  int next = reach > 0 && leave < real(end) ? int(ceil(leave - 0.5)) : end;
  return Leap(signed_reach > 0, clamp(next, i + 1, end));
}

// As next_run.
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

// Whether there is anything to skip; leaps see at a glance that a volume is full. The 0 is dressed up as
// something of the ray: of a condition on parameters alone lavapipe (Mesa 22.3) makes a shader of its own,
// with their values inlined, anew in every submission. That takes up to 1.5 ms.
bool skips(Ray ray) {
  int longest = max(u.brick_grid.x, max(u.brick_grid.y, u.brick_grid.z));
  int nothing = min(0, int(ray.steps));
  return u.brick_grid.w > nothing && (TRI_LEAPS == 0 || brick_visible[0] < longest);
}

struct Light {
  real3 colour;          // premultiplied
  real transmittance;
};

// One sample at p. `whole`: it stands for a whole step, else for `share` of one.
void add_sample(inout Light light, Grid grid, Ray ray, real3 p, bool whole, real steps) {
  real4 c = transfer(field(grid, p));
  if (TRI_COUNT == 1) count_samples++;
  if (TRI_SPEED_OF_LIGHT == 1) {
    light.colour += c.rgb;
    light.transmittance += c.a;
  } else if (c.a > 0.0) {
    if (TRI_COUNT == 1) count_nonzero++;
    if (TRI_SHADING == 1) c.rgb = shade(grid, c.rgb, p, ray.d);
    real opacity = whole ? tri_opacity_by_form(c.a, steps, TRI_OPACITY_FORM) : tri_opacity(c.a, steps);
    real weight = light.transmittance * opacity;
    light.colour += weight * c.rgb;
    light.transmittance -= weight;
  }
}

#if TRI_PRECISION == 32
// The step of the ray from `begin` to `end`, in steps, between whose values the field runs straight; it is
// `length` voxels long, which is not always what `begin` and `end` say (a planted fault).
void add_segment(inout Light light, Grid grid, Ray ray, real begin, real end, real front, real back,
                 real length) {
  real4 segment = preintegrated(front, back, length);
  if (TRI_COUNT == 1) count_samples++;
  if (segment.a > 0.0) {
    if (TRI_COUNT == 1) count_nonzero++;
    if (TRI_SHADING == 1) {
      real3 middle = ray.p0 + (0.5 * (begin + end)) * ray.g;
      segment.rgb = segment.a * shade(grid, segment.rgb / segment.a, middle, ray.d);
    }
    light.colour += light.transmittance * segment.rgb;
    light.transmittance -= light.transmittance * segment.a;
  }
}
#endif

// How far a ray has got.
struct March {
  Light light;
  real front;         // the value where the next step begins; with TRI_PREINTEGRATED only
  int i;              // the next sample
  int stop;           // the end of the run of visible samples
  int count;          // the end of the ray; 0 once nothing more is to be taken, as is `stop`
  bool last_visible;  // the ray's last sample lies in the run
};

// Ends the ray where nothing behind can be seen any more.
void end_in_the_dark(inout March m, real enough) {
  if (TRI_SPEED_OF_LIGHT == 0 && m.light.transmittance < enough) {
    if (TRI_COUNT == 1) count_terminated = 1u;
    m.last_visible = false;
    m.stop = 0;
    m.count = 0;
  }
}

// The i-th sample or step.
void advance(inout March m, Grid grid, Ray ray, real step_voxels, real enough) {
#if TRI_PRECISION == 32
  if (TRI_PREINTEGRATED == 1) {
    real end = min(real(m.i + 1), ray.steps);
    real back = field(grid, ray.p0 + end * ray.g);
    real length = step_voxels * tri_step_share(ray.steps, m.i);
    add_segment(m.light, grid, ray, real(m.i), end, m.front, back, length);
    m.front = back;
  }
#endif
  if (TRI_PREINTEGRATED == 0) {
    add_sample(m.light, grid, ray, ray.p0 + (real(m.i) + 0.5) * ray.g, true, step_voxels);
  }
  end_in_the_dark(m, enough);
  ++m.i;
}

// The samples of the run as one in the middle of their way (technique::brick_kinds); not before the first of
// them, which may be the ray's last and stand for little.
void advance_merged(inout March m, Grid grid, Ray ray, real step_voxels, real enough) {
  real begin = real(m.i);
  real end = min(real(m.stop), ray.steps);
  real middle = max(0.5 * (begin + end), begin + 0.5);
  add_sample(m.light, grid, ray, ray.p0 + middle * ray.g, false, step_voxels * (end - begin));
  m.i = m.stop;
  end_in_the_dark(m, enough);
}

// Premultiplied RGBA of the pixel. Three habits of compilers for CPUs shape these loops. They run a block
// of rays through both sides of a condition, so the opacity of the partial last step must not stand beside
// that of a whole one: the last sample is taken behind the loops. Mesa 22.3's llvmpipe goes on
// computing, with loads that yield 0, the values of a ray that has left a loop while its neighbours have
// not: a loop may be left at its head only, where every variable is still what the last pass made it. And
// it lets an invocation make 65,535 passes through all its loops together, however they are nested: where
// rays may be longer (technique::has_long_rays), a pass takes sixteen samples.
vec4 raycast(ivec2 pixel) {
  Ray ray = make_ray(pixel);
  Grid grid = load_grid();
  March m = March(Light(real3(0.0), 1.0), 0.0, 0, 0, tri_sample_count(ray.steps), false);
  if (TRI_FAULT == fault_extra_sample && m.count > 0) { m.count += 1; ray.steps = real(m.count); }
  int last = m.count - 1;  // the sample that may stand for less than a step: it is taken after the loops
  real step_voxels = TRI_FAULT == fault_uncorrected_opacity ? 1.0 : u.ray_centre.w;
  real enough = u.ray_right.w;
  bool skipping = skips(ray);
  Walk walk;
  Leaps leaps;
  if (skipping && TRI_LEAPS == 0) walk = start_walk(ray);
  if (skipping && TRI_LEAPS == 1) leaps = make_leaps(ray);
  while (m.i < m.count) {
    m.stop = m.count;
    bool merged = false;
    if (skipping) {
      ivec2 run = TRI_LEAPS == 1 ? next_run_by_leaps(leaps, ray, m.i, m.count) : next_run(walk, m.i, m.count, merged);
      m.i = run.x;
      m.stop = run.y;
    }
    if (TRI_ADAPT == 1 && merged && m.i < m.stop) advance_merged(m, grid, ray, step_voxels, enough);
    m.last_visible = m.stop == m.count && m.i < m.stop;
    // A partial step of a straight line is no other work than a whole one: it needs no special place.
    if (TRI_PREINTEGRATED == 0) m.stop = min(m.stop, last);
    if (TRI_PREINTEGRATED == 1) m.front = field(grid, ray.p0 + real(m.i) * ray.g);
    while (m.i < m.stop) {
      advance(m, grid, ray, step_voxels, enough);
#if TRI_LONG_RAYS
#define TRI_THREE_MORE TRI_ONE_MORE TRI_ONE_MORE TRI_ONE_MORE
#define TRI_ONE_MORE if (m.i < m.stop) advance(m, grid, ray, step_voxels, enough);
      TRI_THREE_MORE TRI_THREE_MORE TRI_THREE_MORE TRI_THREE_MORE TRI_THREE_MORE
#endif
    }
    if (TRI_PREINTEGRATED == 0 && m.last_visible) m.count = 0;
  }
  if (TRI_PREINTEGRATED == 0 && m.last_visible) {
    real steps = step_voxels * tri_step_share(ray.steps, last);
    add_sample(m.light, grid, ray, ray.p0 + (real(last) + 0.5) * ray.g, false, steps);
    if (TRI_COUNT == 1 && TRI_SPEED_OF_LIGHT == 0 && m.light.transmittance < enough) count_terminated = 1u;
  }
#if TRI_COUNT
  int total = tri_sample_count(ray.steps);
  int at = 8 * (pixel.y * u.viewport.x + pixel.x);
  counters[at] = total > 0 ? 1u : 0u;
  counters[at + 1] = count_samples;
  counters[at + 2] = count_nonzero;
  counters[at + 3] = count_bricks_visited;
  counters[at + 4] = count_bricks_skipped;
  counters[at + 5] = count_terminated;
  counters[at + 6] = uint(total) - count_samples;
#endif
  return vec4(real4(m.light.colour, 1.0 - m.light.transmittance) + m.light.transmittance * u.background);
}
