// Front-to-back raycasting, with one ray per work item. The algorithm is the same as in
// src/technique/volume/raycast/raycast.glsl. Positions are in voxels, lengths along the ray in
// steps: sample i is at p0 + (i+½)·g.
//
// A batch of samples is fetched and classified as a whole, and then composited sample by sample. A
// ray may therefore fetch a few samples beyond its end, but the composited and counted samples do
// not depend on the batch size.
//
// Compile-time constants: TRI_SHADING, TRI_COUNT, TRI_SPEED_OF_LIGHT, TRI_PREINTEGRATED
// (technique::preintegration_form), TRI_LEAPS, TRI_ADAPT, and those of volume.cl.
//
// With TRI_PARTS, a pass processes only the part of the volume that the device stores, and
// continues rays where the previous pass stopped.

// Computes the colours, and the opacities per voxel length, of n values. They are linear between
// the 256 entries of the table.
TRI_FN void classify(__constant float4* table, const real* value, int n, real4* colour,
                     real* alpha) {
  int entry[TRI_BATCH];
  real weight[TRI_BATCH];
  for (int k = 0; k < n; ++k) {
    real position = tri_table_position(value[k]);
    int below = (int)position;
    entry[k] = below < 254 ? below : 254;
    weight[k] = position - (real)entry[k];
  }
  for (int k = 0; k < n; ++k) {
    real4 a = TRI_ENTRY(table[entry[k]]);
    real4 b = TRI_ENTRY(table[entry[k] + 1]);
    colour[k] = a + weight[k] * (b - a);
    alpha[k] = colour[k].w;
  }
}

// Composites the first n samples of a batch that begins with sample i. Returns 1 if the ray ends
// among them.
TRI_FN int composite(__constant Parameters* u, TRI_VOLUME volume, const Ray* ray, int i, int n,
#if TRI_TRACE
                     const real* value,
#endif
                     const real4* colour, const real* alpha, Gathered* gathered,
                     Counts* counts) {
  int lanes = TRI_WHOLE_VECTORS(n);
  real most = 0.0f;
  for (int k = 0; k < lanes; ++k) most = alpha[k] > most ? alpha[k] : most;
#if TRI_TRACE
  if (!(most > 0.0f)) {
    for (int k = 0; k < n; ++k) {
      trace(ray, TRI_TRACED_SAMPLE, ray->p0 + ((real)(i + k) + 0.5f) * ray->g, (real2)(value[k]), colour[k],
            u->ray_centre.w * tri_step_share(ray->steps, i + k), 0.0f, gathered);
    }
  }
#endif
  if (!(most > 0.0f)) {
    counts->samples += (uint)n;
    return 0;
  }
  real step_voxels = TRI_FAULT == FAULT_UNCORRECTED_OPACITY ? 1.0f : u->ray_centre.w;
  real opacity[TRI_BATCH];
  for (int k = 0; k < lanes; ++k) {
    opacity[k] = tri_opacity(alpha[k], step_voxels * tri_step_share(ray->steps, i + k));
  }
  for (int k = 0; k < n; ++k) {
    real4 c = colour[k];
#if TRI_COUNT
    counts->samples++;
    if (alpha[k] > 0.0f) counts->nonzero++;
#endif
#if TRI_SHADING
    if (alpha[k] > 0.0f) {
      c = shade(u, volume, c, ray->p0 + ((real)(i + k) + 0.5f) * ray->g, ray->d);
    }
#endif
    real weight = gathered->transmittance * opacity[k];
    gathered->sum += weight * c;
    gathered->transmittance -= weight;
#if TRI_TRACE
    trace(ray, TRI_TRACED_SAMPLE, ray->p0 + ((real)(i + k) + 0.5f) * ray->g, (real2)(value[k]),
          (real4)(c.xyz, alpha[k]), step_voxels * tri_step_share(ray->steps, i + k), opacity[k], gathered);
#endif
    if (gathered->transmittance < u->ray_right.w) {
      counts->terminated = 1u;
      return 1;
    }
  }
  return 0;
}

// Processes n samples beginning with sample i. Returns 1 if the ray ends among them.
TRI_FN int take_batch(__constant Parameters* u, TRI_VOLUME volume, __constant float4* table,
                      const Ray* ray, int i, int n, Gathered* gathered, Counts* counts) {
  int lanes = TRI_WHOLE_VECTORS(n);
  Positions p;
  real value[TRI_BATCH];
  real4 colour[TRI_BATCH];
  real alpha[TRI_BATCH];
  for (int k = 0; k < lanes; ++k) {
    real along = (real)(i + k) + 0.5f;
    p.x[k] = ray->p0.x + along * ray->g.x;
    p.y[k] = ray->p0.y + along * ray->g.y;
    p.z[k] = ray->p0.z + along * ray->g.z;
  }
  fetch(u, volume, &p, lanes, value);
  classify(table, value, lanes, colour, alpha);
#if TRI_SPEED_OF_LIGHT
  for (int k = 0; k < n; ++k) gathered->sum += colour[k];
  counts->samples += (uint)n;
  return 0;
#else
  return composite(u, volume, ray, i, n,
#if TRI_TRACE
                   value,
#endif
                   colour, alpha, gathered, counts);
#endif
}

#if TRI_ADAPT
// Processes the samples from i up to but not including `stop` as one sample in the middle of their
// path (technique::brick_kinds). The sample is not placed before the position of sample i, which
// may be the last, partial sample of the ray. Returns 1 if the ray ends there.
TRI_FN int take_merged(__constant Parameters* u, TRI_VOLUME volume, __constant float4* table,
                       const Ray* ray, int i, int stop, Gathered* gathered, Counts* counts) {
  real begin = (real)i;
  real end = (real)stop < ray->steps ? (real)stop : ray->steps;
  real along = max(0.5f * (begin + end), begin + 0.5f);
  real3 middle = ray->p0 + along * ray->g;
  Positions p;
  real value[TRI_LANES];
  real4 colour[TRI_BATCH];
  real alpha[TRI_BATCH];
  p.x[0] = middle.x;
  p.y[0] = middle.y;
  p.z[0] = middle.z;
  fetch(u, volume, &p, 1, value);
  classify(table, value, 1, colour, alpha);
  counts->samples++;
  if (alpha[0] > 0.0f) {
    counts->nonzero++;
#if TRI_SHADING
    colour[0] = shade(u, volume, colour[0], middle, ray->d);
#endif
    real step_voxels = TRI_FAULT == FAULT_UNCORRECTED_OPACITY ? 1.0f : u->ray_centre.w;
    real weight = gathered->transmittance * tri_opacity(alpha[0], step_voxels * (end - begin));
    gathered->sum += weight * colour[0];
    gathered->transmittance -= weight;
#if TRI_TRACE
    trace(ray, TRI_TRACED_SAMPLE, middle, (real2)(value[0]), (real4)(colour[0].xyz, alpha[0]),
          step_voxels * (end - begin), tri_opacity(alpha[0], step_voxels * (end - begin)), gathered);
#endif
  }
  counts->terminated = gathered->transmittance < u->ray_right.w;
  return (int)counts->terminated;
}
#endif

#if TRI_PREINTEGRATED
// The number of steps per batch. A batch fetches one more value than it has steps.
#define TRI_STEPS_PER_BATCH (TRI_BATCH > 1 ? TRI_BATCH - 1 : 1)

// Processes n steps beginning with step i. Returns 1 if the ray ends among them.
TRI_FN int take_steps(__constant Parameters* u, TRI_VOLUME volume, __constant float4* table,
                      __global const float4* pairs, const Ray* ray, int i, int n,
                      Gathered* gathered, Counts* counts) {
  int lanes = TRI_WHOLE_VECTORS(n + 1);
  Positions p;
  real value[TRI_LANES];
  real4 step[TRI_BATCH];
  for (int k = 0; k < lanes; ++k) {
    real along = (real)(i + k);
    along = along < ray->steps ? along : ray->steps;
    p.x[k] = ray->p0.x + along * ray->g.x;
    p.y[k] = ray->p0.y + along * ray->g.y;
    p.z[k] = ray->p0.z + along * ray->g.z;
  }
  fetch(u, volume, &p, lanes, value);
  real step_voxels = TRI_FAULT == FAULT_UNCORRECTED_OPACITY ? 1.0f : u->ray_centre.w;
  for (int k = 0; k < n; ++k) {
    step[k] = preintegrated(table, pairs, value[k], value[k + 1],
                            step_voxels * tri_step_share(ray->steps, i + k));
  }
  for (int k = 0; k < n; ++k) {
    counts->samples++;
    if (step[k].w > 0.0f) {
      counts->nonzero++;
#if TRI_SHADING
      real begin = (real)(i + k);
      real end = begin + 1.0f < ray->steps ? begin + 1.0f : ray->steps;
      real4 straight = (real4)(step[k].xyz / step[k].w, step[k].w);
      straight = shade(u, volume, straight, ray->p0 + (0.5f * (begin + end)) * ray->g, ray->d);
      step[k].xyz = step[k].w * straight.xyz;
#endif
      gathered->sum += gathered->transmittance * step[k];
      gathered->transmittance -= gathered->transmittance * step[k].w;
    }
#if TRI_TRACE
    real until = (real)(i + k) + 1.0f < ray->steps ? (real)(i + k) + 1.0f : ray->steps;
    real4 light = step[k].w > 0.0f ? (real4)(step[k].xyz / step[k].w, step[k].w) : (real4)(0.0f);
    trace(ray, TRI_TRACED_STEP, ray->p0 + (0.5f * ((real)(i + k) + until)) * ray->g,
          (real2)(value[k], value[k + 1]), light, step_voxels * tri_step_share(ray->steps, i + k), step[k].w,
          gathered);
#endif
    if (gathered->transmittance < u->ray_right.w) {
      counts->terminated = 1u;
      return 1;
    }
  }
  return 0;
}
#endif

#if TRI_PARTS
// The state of a ray that continues in the next part of the volume.
typedef struct {
  Gathered gathered;
  Counts counts;
  Walk walk;
  int i;     // the next sample
  int stop;  // the end of its run of samples
  int ended;
} Pause;
#define TRI_PAUSES , __global Pause* pauses

// Returns whether the next position lies in the part. The position is that of a sample, of a step,
// or of the middle of a run to be merged.
TRI_FN int next_is_here(__constant Parameters* u, const Ray* ray, const Walk* walk, int i, int stop) {
  real along = (real)i + (TRI_PREINTEGRATED ? 0.0f : 0.5f);
#if TRI_ADAPT
  real end = (real)stop < ray->steps ? (real)stop : ray->steps;
  if (walk->merged) along = max(0.5f * ((real)i + end), along);
#endif
  return is_here(u, ray, along);
}

// Returns how many of the n samples that begin with sample i lie in the part.
TRI_FN int samples_here(__constant Parameters* u, const Ray* ray, int i, int n) {
  real place = TRI_PREINTEGRATED ? 0.0f : 0.5f;
  while (n > 0 && !is_here(u, ray, (real)(i + n - 1) + place)) --n;
  return n;
}
#else
#define TRI_PAUSES
#endif

// Writes the image as premultiplied RGBA, top row first. Column x of the grid draws image column
// tri_drawn_column(x): x itself for the image, and a neighbouring column for injected extra work.
__kernel void raycast(__constant Parameters* u, TRI_VOLUME volume, __constant float4* table,
                      __global const int* brick_map, __global float4* image,
                      __global uint* counters, __global const float4* pairs TRI_PAUSES) {
  int x = (int)get_global_id(0);
  int y = (int)get_global_id(1);
  int2 pixel = (int2)(tri_drawn_column(x, y, u->viewport.w, u->viewport.z), y);
  if (pixel.x >= u->viewport.x || pixel.y >= u->viewport.y) return;
  Ray ray = make_ray(u, pixel);
  int count = tri_sample_count(ray.steps);
#if TRI_FAULT == FAULT_EXTRA_SAMPLE
  if (count > 0) ray.steps = (real)++count;
#endif
  Gathered gathered = {(real4)(0.0f), 1.0f};
  Counts counts = {0u, 0u, 0u, 0u, 0u};
#if TRI_TRACE
  ray.trace = traced_records(counters, tri_output_place(x, y, u->viewport.x, u->viewport.y, u->viewport.w,
                                                        (int)get_global_size(0)));
#endif
  int skipping = skips(u, brick_map);
  Walk walk;
  if (skipping) walk = start_walk(u, &ray);
  int i = 0;
  int ended = 0;
#if TRI_PARTS
  __global Pause* own =
      pauses + tri_output_place(x, y, u->viewport.x, u->viewport.y, u->viewport.w, (int)get_global_size(0));
  int begun = 0;  // the end of the run that an earlier pass has begun
  if (u->pass.x > 0) {
    Pause pause = *own;
    gathered = pause.gathered;
    counts = pause.counts;
    walk = pause.walk;
    i = pause.i;
    begun = pause.stop;
    ended = pause.ended;
  }
#endif
  while (i < count && !ended) {
    int stop = count;
#if TRI_PARTS
    if (i < begun) {
      stop = begun;
    } else
#endif
    if (skipping) {
      int2 run = next_run(u, brick_map, &walk, &ray, i, count, &counts);
      i = run.x;
      stop = run.y;
    }
#if TRI_PARTS
    begun = stop;
    if (i < stop && !next_is_here(u, &ray, &walk, i, stop)) break;
#endif
#if TRI_ADAPT
    if (walk.merged && i < stop) {
      ended = take_merged(u, volume, table, &ray, i, stop, &gathered, &counts);
      i = stop;
    }
#endif
    while (i < stop && !ended) {
#if TRI_PREINTEGRATED
      int n = min(stop - i, TRI_STEPS_PER_BATCH);
#if TRI_PARTS
      n = samples_here(u, &ray, i, n);
      if (n == 0) break;
#endif
      ended = take_steps(u, volume, table, pairs, &ray, i, n, &gathered, &counts);
#else
      int n = TRI_BATCH == 1 ? 1 : min(stop - i, TRI_BATCH);
#if TRI_PARTS
      n = samples_here(u, &ray, i, n);
      if (n == 0) break;
#endif
      ended = take_batch(u, volume, table, &ray, i, n, &gathered, &counts);
#endif
      i += n;
    }
  }
#if TRI_PARTS
  *own = (Pause){gathered, counts, walk, i, begun, ended};
#endif
  int at = tri_output_place(x, y, u->viewport.x, u->viewport.y, u->viewport.w, (int)get_global_size(0));
#if TRI_SPEED_OF_LIGHT
  gathered.transmittance += gathered.sum.w;
#endif
  real4 colour = (real4)(gathered.sum.xyz, 1.0f - gathered.transmittance) +
                 gathered.transmittance * u->background;
  image[at] = TRI_FLOAT4(colour);
#if TRI_COUNT
  store_counts(counters + 8 * at, &counts, count > 0, (uint)count - counts.samples);
#endif
}
