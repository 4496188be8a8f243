// The counterpart of raycast() for a volume drawn in parts (technique::Part). It processes the samples in the part
// that the device currently stores, one by one and with the same expressions as raycast(), so the result is
// bit-identical.
#include "volume/raycast/pause.glsl"

// Returns whether the part contains the voxels around the ray at the position `along`, in steps from the ray's
// beginning.
bool is_here(Grid grid, Ray ray, real along) {
  real z = ray.p0.z + along * ray.g.z;
  return cell_is_here(int(clamp(z + 0.5, 0.0, real(grid.last.z + 1))));
}

// Returns the position of the next sample or step on the ray.
real next_along(March m, Ray ray, bool merged) {
  real begin = real(m.i);
  if (TRI_PREINTEGRATED != 0) return begin;
  real middle = max(0.5 * (begin + min(real(m.stop), ray.steps)), begin + 0.5);
  return TRI_ADAPT == 1 && merged ? middle : begin + 0.5;
}

// Restores the state in which the previous pass left the ray.
void resume(inout March m, inout Walk walk, inout bool merged, bool walks, int place) {
  Pause pause = pauses[place];
  m.light = Light(pause.light.xyz, pause.light.w);
  m.i = pause.run.x;
  m.stop = pause.run.y;
  if (pause.run.z == 1) m.count = 0;
  merged = pause.where.w == 1;
  walk.brick = pause.where.xyz;
  if (walks) enter(walk);
  resume_counts(pause);
}

void pause_here(March m, Walk walk, bool merged, bool walks, bool dark, int place) {
  ivec3 brick = walks ? walk.brick : ivec3(0);
  pauses[place] = Pause(real4(m.light.colour, m.light.transmittance), ivec4(brick, merged ? 1 : 0),
                        ivec4(m.i, m.stop, dark ? 1 : 0, 0), vec4(0.0), counts_so_far());
}

// Takes the next sample or step of the run (consecutive samples in visible bricks), or the whole run as one sample if
// `merged` is true.
void take_next(inout March m, inout Cut cut, inout bool fresh, bool merged, int last, Grid grid, Ray ray,
               real step_voxels, real enough) {
  if (TRI_ADAPT == 1 && merged) {
    advance_merged(m, grid, ray, step_voxels, enough);
  } else if (TRI_PREINTEGRATED == 0 && m.i == last) {
    real steps = step_voxels * tri_step_share(ray.steps, last);
    add_sample(m.light, grid, ray, ray.p0 + (real(last) + 0.5) * ray.g, false, steps);
    m.i += 1;
    end_in_the_dark(m, enough);
  } else {
    if (TRI_PREINTEGRATED != 0 && fresh) m.front = field(grid, ray.p0 + real(m.i) * ray.g);
    fresh = false;
    advance(m, cut, grid, ray, step_voxels, enough);
  }
}

// Returns the premultiplied RGBA of the pixel, including only the light gathered so far. `place` is the index of
// the pixel's Pause.
vec4 raycast_part(ivec2 pixel, int place) {
#if TRI_TRACE
  begin_trace(pixel);
#endif
  Ray ray = make_ray(pixel);
  Grid grid = load_grid();
  March m = March(Light(real3(0.0), 1.0), 0.0, 0, 0, tri_sample_count(ray.steps), false);
  if (TRI_FAULT == fault_extra_sample && m.count > 0) { m.count += 1; ray.steps = real(m.count); }
  Cut cut = Cut(0.0, 1.0);
  int total = m.count;
  real step_voxels = TRI_FAULT == fault_uncorrected_opacity ? 1.0 : u.ray_centre.w;
  bool skipping = skips(ray);
  bool walks = skipping && TRI_LEAPS == 0;
  bool merged = false;
  Walk walk;
  Leaps leaps;
  if (walks) walk = start_walk(ray);
  if (skipping && TRI_LEAPS == 1) leaps = make_leaps(ray);
  if (u.pass.x > 0) resume(m, walk, merged, walks, place);
  bool fresh = true;  // the value at the front of the step has not been read yet
  bool here = true;
  while (m.i < m.count && here) {
    if (m.i >= m.stop) {
      ivec2 run = ivec2(m.i, m.count);
      if (skipping) {
        run = TRI_LEAPS == 1 ? next_run_by_leaps(leaps, ray, m.i, m.count) : next_run(walk, m.i, m.count, merged);
      }
      m.i = run.x;
      m.stop = run.y;
      fresh = true;
    }
    bool begun = TRI_PREINTEGRATED == 2 && cut.per_cell > 0.0;
    here = m.i >= m.stop || begun || is_here(grid, ray, next_along(m, ray, merged));
    if (m.i < m.stop && here) {
      take_next(m, cut, fresh, merged, total - 1, grid, ray, step_voxels, u.ray_right.w);
    }
  }
  pause_here(m, walk, merged, walks, m.count < total, place);
#if TRI_COUNT
  store_counts(pixel, total > 0, uint(total) - count_samples);
#endif
  return vec4(real4(m.light.colour, 1.0 - m.light.transmittance) + m.light.transmittance * u.background);
}
