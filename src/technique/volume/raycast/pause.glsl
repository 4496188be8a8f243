// The state of a ray between two passes over the parts of a volume, of which the device stores one at a time
// (technique::Part). A run consists of consecutive samples in visible bricks.

struct Pause {
  real4 light;   // premultiplied colour, transmittance
  ivec4 where;   // the brick or the cell where the ray continues; w: 1 if the run is to be taken as one sample
  ivec4 run;     // the next sample, the end of its run, and 1 if the ray has been terminated early
  // Only for quadrature=cells: the positions on the ray, in steps, at which it continues, at which the visible bricks
  // end, and at which the ray ends.
  vec4 times;
  uvec4 counts;  // samples, samples_nonzero, bricks_visited, bricks_skipped
};
layout(std430) TRI_BINDING(7) buffer Pauses { Pause pauses[]; };

bool cell_is_here(int cell) { return cell >= u.part.x && cell < u.part.y; }

void resume_counts(Pause pause) {
  count_samples = pause.counts.x;
  count_nonzero = pause.counts.y;
  count_bricks_visited = pause.counts.z;
  count_bricks_skipped = pause.counts.w;
  count_terminated = uint(pause.run.z);
}

uvec4 counts_so_far() {
  return uvec4(count_samples, count_nonzero, count_bricks_visited, count_bricks_skipped);
}
