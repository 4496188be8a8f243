// Front-to-back raycasting of one pixel. This code is shared by Vulkan and OpenGL, and by compute and fragment
// shaders. Positions are in voxels, and lengths along the ray are in steps: sample i is at p0 + (i+½)·g.

#include "volume/raycast/field.glsl"
#include "volume/raycast/walk.glsl"

// Adds one sample at p with the colour and opacity c. The sample covers `steps` voxel lengths, which is a whole step
// if `whole` is true.
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
#if TRI_TRACE
    traced_opacity = opacity;
#endif
  }
#if TRI_TRACE
  trace(1u, p, c, steps, light);
#endif
}

void add_sample(inout Light light, Grid grid, Ray ray, real3 p, bool whole, real steps) {
#if TRI_TRACE
  real value = field(grid, p);
  traced_value = value;
  add_classified(light, grid, ray, transfer(value), p, whole, steps);
#else
  add_classified(light, grid, ray, transfer(field(grid, p)), p, whole, steps);
#endif
}

// The state of a ray.
struct March {
  Light light;
  real front;         // value at the point where the next step begins or continues; only with TRI_PREINTEGRATED
  int i;              // index of the next sample
  int stop;           // end of the run of visible samples
  int count;          // end of the ray; 0, like `stop`, once the ray has ended
  bool last_visible;  // whether the ray's last sample is in the run
};

#if TRI_PRECISION == 32
// Takes the next step, or the next part of it. The field is assumed to be linear along the step.
void advance_segment(inout March m, inout Cut cut, Grid grid, Ray ray, real step_voxels) {
  real end = min(real(m.i + 1), ray.steps);
  real back = field(grid, ray.p0 + end * ray.g);
  // With an injected fault, this can differ from the distance between the two ends of the step.
  real length = step_voxels * tri_step_share(ray.steps, m.i);
  bool fresh = TRI_PREINTEGRATED != 2 || cut.per_cell == 0.0;
  if (TRI_PREINTEGRATED == 2 && m.light.transmittance == 0.0) cut.left = 0.0;  // the remainder is hidden and becomes one chunk
#if TRI_TRACE
  traced_front = m.front;
#endif
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
#if TRI_TRACE
  traced_value = m.front;  // value at the end of this step or of the processed part
  traced_opacity = segment.a;
  real4 straight = vec4(segment.a > 0.0 ? segment.rgb / segment.a : vec3(0.0), segment.a);
  trace(2u, ray.p0 + (0.5 * (real(m.i) + end)) * ray.g, straight, length, m.light);
#endif
}
#endif

// Ends the ray if nothing behind this point can be visible any more.
void end_in_the_dark(inout March m, real enough) {
  if (TRI_SPEED_OF_LIGHT == 0 && m.light.transmittance < enough) {
    if (TRI_COUNT == 1) count_terminated = 1u;
    m.last_visible = false;
    m.stop = 0;
    m.count = 0;
  }
}

// Takes sample m.i or, with TRI_PREINTEGRATED, the next step or part of a step.
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
// Takes the next two samples, or one if only one is left in the current run of visible samples. Both loads are issued
// before the first result is used.
void advance_two(inout March m, Grid grid, Ray ray, real step_voxels, real enough) {
  real3 p = ray.p0 + (real(m.i) + 0.5) * ray.g;
  real3 q = ray.p0 + (real(m.i + 1) + 0.5) * ray.g;
  real x = field(grid, p);
  real y = field(grid, q);
  real4 a = transfer(x);
  real4 b = transfer(y);
#if TRI_TRACE
  traced_value = x;
#endif
  add_classified(m.light, grid, ray, a, p, true, step_voxels);
  end_in_the_dark(m, enough);
  m.i += 1;
  if (m.i < m.stop) {
#if TRI_TRACE
    traced_value = y;
#endif
    add_classified(m.light, grid, ray, b, q, true, step_voxels);
    end_in_the_dark(m, enough);
    m.i += 1;
  }
}
#endif

// Takes all samples of the run (consecutive samples in visible bricks) as a single sample in the middle of their chord
// (technique::brick_kinds), but never before the first sample of the run, which may be the ray's last and partial
// sample.
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

// Returns the premultiplied RGBA of the pixel. Three properties of compilers that target CPUs determine the structure
// of these loops.
//
// First, these compilers execute both sides of a condition for a block of rays. The opacity of the partial last step
// should therefore not be computed next to that of a whole step, so the last sample is taken after the loops. Second,
// llvmpipe of Mesa 22.3 continues to compute the values of a ray that has left a loop as long as neighbouring rays
// have not, with loads that return 0. A loop may therefore be left only at its head, where every variable still has
// the value of the last iteration. Third, llvmpipe limits each invocation to 65,535 iterations across all its loops,
// however they are nested. If rays may need more iterations (technique::has_long_rays), one iteration takes sixteen
// samples.
vec4 raycast(ivec2 pixel) {
#if TRI_TRACE
  begin_trace(pixel);
#endif
  Ray ray = make_ray(pixel);
  Grid grid = load_grid();
  March m = March(Light(real3(0.0), 1.0), 0.0, 0, 0, tri_sample_count(ray.steps), false);
  if (TRI_FAULT == fault_extra_sample && m.count > 0) { m.count += 1; ray.steps = real(m.count); }
  Cut cut = Cut(0.0, 1.0);
  int last = m.count - 1;  // the sample that may be partial; it is taken after the loops
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
    // With TRI_PREINTEGRATED, a partial step requires the same work as a whole step, so it needs no special
    // treatment.
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
