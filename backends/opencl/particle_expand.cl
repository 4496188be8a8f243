// The passes that compute vertices, for the techniques that have separate shader stages for this
// purpose with the other APIs. Each pass goes through the listed cells (ranges of neighbouring
// particles) in the same way as the binning pass (particle_bins.cl). The binning and tile passes
// then read the vertices.

TRI_FN float4 in_camera_space(const Particles* u, float4 s) {
  return (float4)(camera_x(u, s.x, s.y, s.z), camera_y(u, s.x, s.y, s.z), camera_z(u, s.x, s.y, s.z), s.w);
}

// Returns a corner in clip space, with reversed depth: z is `near` everywhere, except for a sprite
// that covers the whole viewport.
TRI_FN float4 clip_corner(const Particles* u, float3 place, float z) {
  return (float4)(place.x / u->plane.x, (0.0f - place.y) / u->plane.y, z, place.z);
}

TRI_FN float4 viewport_corner(float across, float down) { return (float4)(across, 0.0f - down, 1.0f, 1.0f); }

#if TRI_SPRITE == TRI_EXPANDED_QUAD
// Corresponds to a geometry stage: reads one point and writes four vertices.
__kernel void expand_sprites(__global const Particles* restrict parameters,
                             __global const float* restrict spheres,
                             __global const Cell* restrict cells, __global const uint* restrict list,
                             __global float* restrict stored) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint stop = begin + cells[list[1 + at]].count;
    for (uint i = begin; i < stop; ++i) {
      Frame frame = sprite_frame(&u, in_camera_space(&u, vload4(i, spheres)));
      float3 corners[4] = {frame.centre - frame.right - frame.up, frame.centre + frame.right - frame.up,
                           frame.centre + frame.right + frame.up, frame.centre - frame.right + frame.up};
      for (uint k = 0; k < 4; ++k) {
        float4 whole = viewport_corner(k == 0 || k == 3 ? -1.0f : 1.0f, k < 2 ? -1.0f : 1.0f);
        float4 corner = clip_corner(&u, corners[k], u.eye.w);
        vstore4(frame.everywhere ? whole : corner, 4 * (size_t)i + k, stored);
      }
    }
  }
}
#endif

#if TRI_SPRITE == TRI_EVALUATED_QUAD
// The number of words of a patch as written by the control stage: the centre, a flag for a sprite
// that covers the whole viewport, and the vectors to the right and to the top of the sprite.
#define TRI_PATCH_WORDS 12

// Corresponds to a tessellation control stage: writes one patch per sphere.
__kernel void control_patches(__global const Particles* restrict parameters,
                              __global const float* restrict spheres,
                              __global const Cell* restrict cells, __global const uint* restrict list,
                              __global float* restrict patches) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint stop = begin + cells[list[1 + at]].count;
    for (uint i = begin; i < stop; ++i) {
      Frame frame = sprite_frame(&u, in_camera_space(&u, vload4(i, spheres)));
      __global float* patch = patches + TRI_PATCH_WORDS * (size_t)i;
      vstore4((float4)(frame.centre, (float)frame.everywhere), 0, patch);
      vstore4((float4)(frame.right, 0.0f), 1, patch);
      vstore4((float4)(frame.up, 0.0f), 2, patch);
    }
  }
}

// The domain coordinates of an undivided quad, in the order of its outline.
__constant float2 domain_of_quad[4] = {(float2)(0.0f, 0.0f), (float2)(1.0f, 0.0f), (float2)(1.0f, 1.0f),
                                       (float2)(0.0f, 1.0f)};

// Corresponds to a tessellation evaluation stage: writes one vertex for each domain coordinate of
// each patch.
__kernel void evaluate_patches(__global const Particles* restrict parameters,
                               __global const Cell* restrict cells, __global const uint* restrict list,
                               __global const float* restrict patches, __global float* restrict stored) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint stop = begin + cells[list[1 + at]].count;
    for (uint vertex = 4 * begin; vertex < 4 * stop; ++vertex) {
      __global const float* patch = patches + TRI_PATCH_WORDS * (size_t)(vertex / 4);
      float4 centre = vload4(0, patch);
      float2 side = 2.0f * domain_of_quad[vertex % 4] - 1.0f;
      float3 place = centre.xyz + side.x * vload4(1, patch).xyz + side.y * vload4(2, patch).xyz;
      vstore4(centre.w != 0.0f ? viewport_corner(side.x, side.y) : clip_corner(&u, place, u.eye.w),
              vertex, stored);
    }
  }
}
#endif

#if TRI_SPRITE == TRI_POINT
// Corresponds to a vertex stage for points: writes the position of the square's centre on the
// image, and its size in pixels. A square larger than TRI_LARGEST_POINT is drawn as a
// screen-aligned quad, as with the other APIs.
__kernel void project_points(__global const Particles* restrict parameters,
                             __global const float* restrict spheres,
                             __global const Cell* restrict cells, __global const uint* restrict list,
                             __global float* restrict stored) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  Particles u = *parameters;
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint stop = begin + cells[list[1 + at]].count;
    for (uint i = begin; i < stop; ++i) {
      float4 c = in_camera_space(&u, vload4(i, spheres));
      float2 x = covered(c.x, c.z, c.w, u.plane.z, u.eye_rest.w);
      float2 y = covered(c.y, c.z, c.w, u.plane.w, u.eye_rest.w);
      float2 low = (float2)(max(x.x, 0.0f - u.plane.x), max(y.x, 0.0f - u.plane.y));
      float2 high = (float2)(min(x.y, u.plane.x), min(y.y, u.plane.y));
      float size = max((high.x - low.x) / u.plane.z, (high.y - low.y) / u.plane.w);
      float corners = low.x > high.x || low.y > high.y ? 0.0f : (size <= TRI_LARGEST_POINT ? 1.0f : 4.0f);
      float2 middle = low * 0.5f + high * 0.5f;
      vstore4((float4)(middle.x / u.plane.x, (0.0f - middle.y) / u.plane.y, size, corners), 2 * (size_t)i, stored);
      vstore4((float4)(low, high), 2 * (size_t)i + 1, stored);
    }
  }
}
#endif
