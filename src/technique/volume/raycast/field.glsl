// Code shared by all raycasters: rays, the field, the transfer function, shading, counters and accumulated light.
// Positions are in voxels, and lengths along the ray are in steps.

const int fault_half_voxel_shift = 1;
const int fault_flipped_axis = 2;
const int fault_extra_sample = 3;
const int fault_uncorrected_opacity = 4;
const int fault_coarse_filter = 5;

// The counters of the ray. They are used only if TRI_COUNT is 1. Timed frames use a build in which TRI_COUNT is 0, and
// from which the compiler removes these variables.
uint count_samples = 0u;
uint count_nonzero = 0u;
uint count_bricks_visited = 0u;
uint count_bricks_skipped = 0u;
uint count_terminated = 0u;

#if TRI_COUNT
// Writes the pixel's counters (technique::raycast_counters). `saved` is the number of samples that the ray did not
// have to take.
void store_counts(ivec2 pixel, bool hit, uint saved) {
  int at = 8 * (pixel.y * u.viewport.x + pixel.x);
  counters[at] = hit ? 1u : 0u;
  counters[at + 1] = count_samples;
  counters[at + 2] = count_nonzero;
  counters[at + 3] = count_bricks_visited;
  counters[at + 4] = count_bricks_skipped;
  counters[at + 5] = count_terminated;
  counters[at + 6] = saved;
}
#endif

// The parameters required by every sample. They are loaded once per ray, because compilers that do not move loads
// out of loops would otherwise load the uniforms again for every sample.
struct Grid {
  real3 inverse_size;
  ivec3 last;           // largest voxel index per axis
  real2 value_map;
  real stored_maximum;  // only in double precision, for voxels that are integers; otherwise 0
};

Grid load_grid() {
  Grid grid;
  grid.inverse_size = 1.0 / real3(u.volume_size.xyz);
  grid.last = u.volume_size.xyz - 1;
  grid.value_map = u.value_map.xy;
  grid.stored_maximum = u.value_map.w;
  return grid;
}

#if TRI_PACKED

#include "volume/raycast/packed.glsl"

#else

// Returns the stored value of a voxel. A texel of u8 or u16 is its integer divided by the largest integer, rounded
// to float. In double precision, the integer itself is recovered.
real voxel(Grid grid, ivec3 at) {
#if TRI_PARTS
  at.z = clamp(at.z - max(u.part.z - 1, 0), 0, u.part.w);
#endif
  float texel = texelFetch(volume_texture, at, 0).r;
#if TRI_PRECISION == 64
  if (grid.stored_maximum > 0.0) return floor(real(texel) * grid.stored_maximum + 0.5);
#endif
  return texel;
}

// Interpolates trilinearly in the shader, between the voxels floor(q) and floor(q)+1 along each axis, where
// q = p − ½. Indices are clamped to the edge.
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

// Returns the normalised value at p.
real field(Grid grid, real3 p) {
  if (TRI_FAULT == fault_half_voxel_shift) p.x += 0.5;
  if (TRI_FAULT == fault_flipped_axis) p.y = real(grid.last.y + 1) - p.y;
  real stored = TRI_MANUAL_SAMPLER == 1 ? fetch_manual(grid, p) : fetch_hardware(grid, p);
  return stored * grid.value_map.x + grid.value_map.y;
}

// Returns central differences: for each axis, the normalised value one voxel after p minus the value one voxel
// before p.
real3 rises(Grid grid, real3 p) {
  return real3(field(grid, p + real3(1, 0, 0)) - field(grid, p - real3(1, 0, 0)),
               field(grid, p + real3(0, 1, 0)) - field(grid, p - real3(0, 1, 0)),
               field(grid, p + real3(0, 0, 1)) - field(grid, p - real3(0, 0, 1)));
}

#endif

real4 transfer(real x) {
  real position = tri_table_position(x);
  int k = min(int(position), 254);
  real4 a = real4(transfer_entry(k));
  real4 b = real4(transfer_entry(k + 1));
  return a + (position - real(k)) * (b - a);
}

// Returns the colour after headlight shading (scene::Shading). d is the direction of the ray in world space.
real3 shade(Grid grid, real3 colour, real3 p, real3 d) {
  real3 g = rises(grid, p) * (0.5 * u.inverse_spacing.w * u.inverse_spacing.xyz);
  real cosine = abs(dot(g, d)) / max(sqrt(dot(g, g)), u.ray_up.w);
  real highlight = cosine;
#if TRI_LONG_RAYS
  // Compilers unroll a loop of constant length, so it does not count towards the limit on iterations (see
  // raycast()).
  for (int i = 0; i < 31; ++i) highlight *= i < u.volume_size.w ? highlight : 1.0;
#else
  // min(0, int(cosine)) is always 0 but depends on the sample, as in skips(). Without it, lavapipe (Mesa 22.3)
  // would recompile the shader in every submission because of this loop.
  int squarings = u.volume_size.w + min(0, int(cosine));
  for (int i = 0; i < squarings; ++i) highlight *= highlight;
#endif
  return colour * (u.shading.x + u.shading.y * cosine) + u.shading.z * highlight;
}

struct Ray {
  real3 p0;    // entry point of the ray into the box, in voxels
  real3 g;     // one step, in voxels
  real3 d;     // unit direction in world space
  real steps;  // length inside the box, in steps
};

Ray make_ray(ivec2 pixel) {
  real2 ndc = (2.0 * (real2(pixel) + 0.5)) / real2(u.viewport.xy) - 1.0;
  real3 d = u.ray_centre.xyz + ndc.x * u.ray_right.xyz - ndc.y * u.ray_up.xyz;
  d = d / sqrt(dot(d, d));
  real3 v = d * u.inverse_spacing.xyz;
  real3 size = real3(u.volume_size.xyz);
  // If the eye is far away, the ray begins on a plane between the eye and the box, otherwise at the eye.
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

struct Light {
  real3 colour;          // premultiplied
  real transmittance;
};

#if TRI_TRACE
#include "volume/raycast/trace.glsl"
#endif
