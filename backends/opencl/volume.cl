// Fetches normalised values from the volume, for up to TRI_BATCH positions at a time.
//
// The work is arranged as plain loops over small arrays, with one simple operation per loop. A
// compiler for CPUs turns each loop into vector instructions, up to 16 samples wide. GPUs use a
// TRI_BATCH of 1, with which the loops disappear.
//
// Compile-time constants: TRI_MANUAL_SAMPLER, TRI_VOXEL (the stored type), TRI_FAULT, TRI_BATCH,
// TRI_PARTS (technique::Part).

// Room for one batch, or for the six neighbours that shading reads.
#define TRI_LANES (TRI_BATCH > 8 ? TRI_BATCH : 8)
// Rounds n up to whole vectors. Results beyond n are not used.
#define TRI_WHOLE_VECTORS(n) (TRI_BATCH > 1 ? (((n) + 7) & ~7) : (n))

#define FAULT_HALF_VOXEL_SHIFT 1
#define FAULT_FLIPPED_AXIS 2
#define FAULT_EXTRA_SAMPLE 3
#define FAULT_UNCORRECTED_OPACITY 4
#define FAULT_COARSE_FILTER 5

#if TRI_MANUAL_SAMPLER
// The voxels, with a border on every side that repeats the outermost layer once. The eight voxels
// around any position are therefore four pairs of adjacent voxels at fixed offsets.
#define TRI_VOLUME __global const TRI_VOXEL*
#define TRI_FOUR_(type) type##4
#define TRI_FOUR(type) TRI_FOUR_(type)
#if TRI_HALVES
#define TRI_VOXEL4 float4
#define TRI_LOAD2(v) load_halves(v)
// Converts half floats that are neither negative nor subnormal: shifted, their bits are those of a
// float that is smaller by a factor of 2¹¹². PoCL's vload_half branches for each voxel, and a
// kernel that uses it executes 1.5 times as many instructions.
TRI_FN float2 load_halves(__global const ushort* v) {
  return as_float2(convert_uint2(vload2(0, v)) << 13) * 0x1p112f;
}
#else
#define TRI_VOXEL4 TRI_FOUR(TRI_VOXEL)
#define TRI_LOAD2(v) vload2(0, v)
#endif
#else
#define TRI_VOLUME __read_only image3d_t
__constant sampler_t linear_sampler =
    CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP_TO_EDGE | CLK_FILTER_LINEAR;
#endif

// Positions in voxels. Voxel centres are at i+½.
typedef struct {
  real x[TRI_LANES];
  real y[TRI_LANES];
  real z[TRI_LANES];
} Positions;

TRI_FN real clamp_coordinate(real q, real most) {
  return q > 0.0f ? (q < most ? q : most) : 0.0f;
}

TRI_FN real rounded_weight(real f) {
#if TRI_FAULT == FAULT_COARSE_FILTER
  return tri_floor(f * 256.0f + 0.5f) / 256.0f;
#else
  return f;
#endif
}

#if TRI_MANUAL_SAMPLER
// Interpolates trilinearly between the eight voxels that begin at `v`.
TRI_FN real trilinear(TRI_VOLUME v, int row, int slice, real fx, real fy, real fz) {
  TRI_VOXEL4 near_pairs = (TRI_VOXEL4)(TRI_LOAD2(v), TRI_LOAD2(v + row));
  TRI_VOXEL4 far_pairs = (TRI_VOXEL4)(TRI_LOAD2(v + slice), TRI_LOAD2(v + slice + row));
  real4 lo = TRI_REAL4(near_pairs);
  real4 hi = TRI_REAL4(far_pairs);
  real4 z = lo + fz * (hi - lo);
  real2 y = z.xy + fy * (z.zw - z.xy);
  return y.x + fx * (y.y - y.x);
}
#endif

// Returns the index of the layer that stores a cell on the device. `cell` is the cell's index along
// z (technique::Part). If another part of the volume contains the cell, the result is clamped, and
// the values that are read there are not used.
TRI_FN int held_layer(__constant Parameters* u, int cell) {
#if TRI_PARTS
  return clamp(cell - u->part.z, 0, u->part.w - 1);
#else
  return cell;
#endif
}

// Fetches the normalised values at the first n positions.
TRI_FN void fetch(__constant Parameters* u, TRI_VOLUME volume, Positions* p, int n, real* value) {
#if TRI_FAULT == FAULT_HALF_VOXEL_SHIFT
  for (int k = 0; k < n; ++k) p->x[k] += 0.5f;
#endif
#if TRI_FAULT == FAULT_FLIPPED_AXIS
  for (int k = 0; k < n; ++k) p->y[k] = (real)u->volume_size.y - p->y[k];
#endif
  real scale = u->value_map.x;
  real offset = u->value_map.y;
#if TRI_MANUAL_SAMPLER
  // Because of the border, q = p + ½ is not negative, so truncation equals floor. Clamping q clamps
  // to the edge.
  real sx = (real)u->volume_size.x;
  real sy = (real)u->volume_size.y;
  real sz = (real)u->volume_size.z;
  int row = u->volume_size.x + 2;
  int slice = row * (u->volume_size.y + 2);
  int first[TRI_LANES];
  for (int k = 0; k < n; ++k) {
    real qx = clamp_coordinate(p->x[k] + 0.5f, sx);
    real qy = clamp_coordinate(p->y[k] + 0.5f, sy);
    real qz = clamp_coordinate(p->z[k] + 0.5f, sz);
    int ix = (int)qx;
    int iy = (int)qy;
    int iz = (int)qz;
    first[k] = ix + row * iy + slice * held_layer(u, iz);
    p->x[k] = rounded_weight(qx - (real)ix);
    p->y[k] = rounded_weight(qy - (real)iy);
    p->z[k] = rounded_weight(qz - (real)iz);
  }
  for (int k = 0; k < n; ++k) {
    value[k] = trilinear(volume + first[k], row, slice, p->x[k], p->y[k], p->z[k]) * scale + offset;
  }
#else
  for (int k = 0; k < n; ++k) {
    real4 q = (real4)(p->x[k], p->y[k], p->z[k], 0.0f);
#if TRI_FAULT == FAULT_COARSE_FILTER
    q = floor((q - 0.5f) * 256.0f + 0.5f) / 256.0f + 0.5f;
#endif
    value[k] = read_imagef(volume, linear_sampler, q).x * scale + offset;
  }
#endif
}
