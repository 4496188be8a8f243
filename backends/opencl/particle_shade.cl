// Computes the colours of the particles, and of the pixels that show them.

// Looks up the transfer function: linear between the centres of table entries, constant beyond
// them.
TRI_FN float4 transfer_colour(__global const float4* table, float intensity) {
  float position = tri_table_position(intensity);
  int lower = min((int)position, 254);
  float share = position - (float)lower;
  float4 a = table[lower];
  float4 b = table[lower + 1];
  return a + share * (b - a);
}

#if TRI_COLOUR != 2
TRI_FN float4 stored_colour(__global const uint* colours, uint particle) {
#if TRI_COLOUR == 0
  uint word = colours[particle];
  return (float4)((float)(word & 255u), (float)(word >> 8 & 255u), (float)(word >> 16 & 255u),
                  (float)(word >> 24)) * 0.0039215686274509803f;
#else
  return vload4(particle, (__global const float*)colours);
#endif
}
#endif

#if TRI_COLOUR == 2
// Runs one work item per chunk, which evaluates the transfer function once for each sprite.
__kernel void colour_sprites(__global const Cell* restrict cells,
                             __global const uint* restrict list,
                             __global const float* restrict intensities,
                             __global const float4* restrict table,
                             __global float4* restrict sprite_colours) {
  uint chunk = (uint)get_global_id(0);
  uint chunks = (uint)get_global_size(0);
  uint end = chunk_begin(list[0], chunk + 1, chunks);
  for (uint at = chunk_begin(list[0], chunk, chunks); at < end; ++at) {
    uint begin = cells[list[1 + at]].begin;
    uint stop = begin + cells[list[1 + at]].count;
    for (uint i = begin; i < stop; ++i) {
      sprite_colours[i] = transfer_colour(table, intensities[i]);
    }
  }
}
#endif

// Runs one work item per row of pixels. `camera` contains the spheres in camera space or, with
// TRI_TRACED, in world space.
__kernel void shade(__global const Particles* restrict parameters,
                    __global const float* restrict camera, __global const uint* restrict ids,
                    __global const uint* restrict colours, __global const float4* restrict table,
                    __global const float* restrict sprite_colours,
                    __global const uint* restrict winners,
                    __global const float* restrict cosines, __global float4* restrict image,
                    __global uint* restrict shown) {
  Particles u = *parameters;
  int y = (int)get_global_id(0);
  float sy = pixel_ray_y(&u, y);
  for (int x = 0; x < u.viewport.x; ++x) {
    size_t pixel = (size_t)y * (size_t)u.viewport.x + (size_t)x;
    uint particle = winners[pixel];
    if (particle == TRI_NONE) {
      image[pixel] = u.background;
      shown[pixel] = TRI_NONE;
      continue;
    }
#if TRI_RAY_AT_VERTEX
    float cosine = cosines[pixel];
#else
    float4 c = vload4(particle, camera);
#if TRI_TRACED
    c.xyz = (float3)(camera_x(&u, c.x, c.y, c.z), camera_y(&u, c.x, c.y, c.z), camera_z(&u, c.x, c.y, c.z));
#endif
    float sx = pixel_ray_x(&u, x);
    float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, sx, sy);
    float cosine = tri_sphere_cosine(c.w, sx, sy, discriminant);
#endif
    float light = u.shading.x + u.shading.y * cosine;
#if TRI_COLOUR == 2 && TRI_TRANSFER_AT_PIXEL
    float4 colour = transfer_colour(table, as_float(colours[particle]));
#elif TRI_COLOUR == 2
    float4 colour = vload4(particle, sprite_colours);
#else
    float4 colour = stored_colour(colours, particle);
#endif
    image[pixel] = (float4)(light * colour.xyz, 1.0f);
    shown[pixel] = ids[particle];
  }
}
