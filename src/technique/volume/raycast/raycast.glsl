// Front-to-back raycasting of one pixel: the body shared by Vulkan and GL, by compute and fragment.
// Positions are in voxels, lengths along the ray in steps: sample i stands at p0 + (i+½)·g.

#include "volume/raycast/field.glsl"
#include "volume/raycast/walk.glsl"

// One sample at p, of colour and opacity c. `whole`: it stands for a whole step, else for `share` of one.
void add_classified(inout Light light, Grid grid, Ray ray, real4 c, real3 p, bool whole, real steps) {
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

void add_sample(inout Light light, Grid grid, Ray ray, real3 p, bool whole, real steps) {
  add_classified(light, grid, ray, transfer(field(grid, p)), p, whole, steps);
}

// How far a ray has got.
struct March {
  Light light;
  real front;         // the value where the next step begins or goes on; with TRI_PREINTEGRATED only
  int i;              // the next sample
  int stop;           // the end of the run of visible samples
  int count;          // the end of the ray; 0 once nothing more is to be taken, as is `stop`
  bool last_visible;  // the ray's last sample lies in the run
};

#if TRI_PRECISION == 32
// The next step, or the next part of it, between whose values the field runs straight.
void advance_segment(inout March m, inout Cut cut, Grid grid, Ray ray, real step_voxels) {
  real end = min(real(m.i + 1), ray.steps);
  real back = field(grid, ray.p0 + end * ray.g);
  // Not always what begin and end say (an injected fault).
  real length = step_voxels * tri_step_share(ray.steps, m.i);
  bool fresh = TRI_PREINTEGRATED != 2 || cut.per_cell == 0.0;
  if (TRI_PREINTEGRATED == 2 && m.light.transmittance == 0.0) cut.left = 0.0;  // no passes for what nobody sees
  vec4 segment = preintegrated(m.front, back, length, cut);
  bool visible = segment.a > 0.0 || cut.per_cell > 0.0;
  if (TRI_COUNT == 1 && fresh) count_samples++;
  if (TRI_COUNT == 1 && fresh && visible) count_nonzero++;
  if (segment.a > 0.0) {
    if (TRI_SHADING == 1) {
      real3 middle = ray.p0 + (0.5 * (real(m.i) + end)) * ray.g;
      segment.rgb = segment.a * shade(grid, segment.rgb / segment.a, middle, ray.d);
    }
    m.light.colour += m.light.transmittance * segment.rgb;
    m.light.transmittance -= m.light.transmittance * segment.a;
  }
}
#endif

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
void advance(inout March m, inout Cut cut, Grid grid, Ray ray, real step_voxels, real enough) {
#if TRI_PRECISION == 32
  if (TRI_PREINTEGRATED != 0) advance_segment(m, cut, grid, ray, step_voxels);
#endif
  if (TRI_PREINTEGRATED == 0) {
    add_sample(m.light, grid, ray, ray.p0 + (real(m.i) + 0.5) * ray.g, true, step_voxels);
  }
  bool begun = TRI_PREINTEGRATED == 2 && cut.per_cell > 0.0;
  if (!begun) end_in_the_dark(m, enough);
  m.i += begun ? 0 : 1;
}

#if TRI_PACKED
// The next two samples, or the one that is left: the loads of both are under way before either is waited for.
void advance_two(inout March m, Grid grid, Ray ray, real step_voxels, real enough) {
  real3 p = ray.p0 + (real(m.i) + 0.5) * ray.g;
  real3 q = ray.p0 + (real(m.i + 1) + 0.5) * ray.g;
  real x = field(grid, p);
  real y = field(grid, q);
  real4 a = transfer(x);
  real4 b = transfer(y);
  add_classified(m.light, grid, ray, a, p, true, step_voxels);
  end_in_the_dark(m, enough);
  m.i += 1;
  if (m.i < m.stop) {
    add_classified(m.light, grid, ray, b, q, true, step_voxels);
    end_in_the_dark(m, enough);
    m.i += 1;
  }
}
#endif

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

#if TRI_PARTS

#include "volume/raycast/raycast_parts.glsl"

#else

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
  Cut cut = Cut(0.0, 1.0);
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
    if (TRI_PREINTEGRATED != 0) m.front = field(grid, ray.p0 + real(m.i) * ray.g);
    while (m.i < m.stop) {
#if TRI_PACKED && !TRI_LONG_RAYS
      if (TRI_PREINTEGRATED == 0 && TRI_SHADING == 0) advance_two(m, grid, ray, step_voxels, enough);
      else
#endif
      advance(m, cut, grid, ray, step_voxels, enough);
#if TRI_LONG_RAYS
#define TRI_THREE_MORE TRI_ONE_MORE TRI_ONE_MORE TRI_ONE_MORE
#define TRI_ONE_MORE if (m.i < m.stop) advance(m, cut, grid, ray, step_voxels, enough);
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
  store_counts(pixel, total > 0, uint(total) - count_samples);
#endif
  return vec4(real4(m.light.colour, 1.0 - m.light.transmittance) + m.light.transmittance * u.background);
}

#endif
