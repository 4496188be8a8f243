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

#include "volume/raycast/walk.glsl"

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
