// Records the history of one pixel, in a build made for this purpose
// (technique/volume/ray_trace.hpp).
#define TRI_TRACED_SAMPLE 1u
#define TRI_TRACED_STEP 2u

// Returns where the records of the pixel are written; null for every pixel but the traced one.
TRI_FN __global uint* traced_records(__global uint* counters, int pixel) {
  uint place = counters[8 * pixel + 7];
  return place == 0xFFFFFFFFu ? 0 : counters + place;
}

// `values` are the values at the beginning and at the end of a step. For a sample, both are the
// value of the sample.
TRI_FN void trace(const Ray* ray, uint kind, real3 place, real2 values, real4 colour,
                  real length, real opacity, const Gathered* gathered) {
  __global uint* records = ray->trace;
  if (!records) return;
  uint n = records[1]++;
  if (n >= records[0]) return;
  __global float* to = (__global float*)(records + 2 + 16 * n);
  records[2 + 16 * n] = kind;
  to[1] = (float)place.x;
  to[2] = (float)place.y;
  to[3] = (float)place.z;
  to[4] = (float)values.y;
  to[5] = (float)values.x;
  to[6] = (float)colour.x;
  to[7] = (float)colour.y;
  to[8] = (float)colour.z;
  to[9] = (float)colour.w;
  to[10] = (float)length;
  to[11] = (float)opacity;
  to[12] = (float)gathered->transmittance;
  to[13] = (float)gathered->sum.x;
  to[14] = (float)gathered->sum.y;
  to[15] = (float)gathered->sum.z;
}
