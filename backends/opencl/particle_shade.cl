// One work item per row of pixels shades what it shows.

// Linear between entry centres, constant outside them.
TRI_FN float4 transfer_colour(__global const float4* table, float intensity) {
  float position = tri_table_position(intensity);
  int lower = min((int)position, 254);
  float share = position - (float)lower;
  float4 a = table[lower];
  float4 b = table[lower + 1];
  return a + share * (b - a);
}

// A particle's colour as stored; intensity in the first component.
TRI_FN float4 stored_colour(__global const uint* colours, uint particle) {
#if TRI_COLOUR == 0
  uint word = colours[particle];
  return (float4)((float)(word & 255u), (float)(word >> 8 & 255u), (float)(word >> 16 & 255u),
                  (float)(word >> 24)) / 255.0f;
#elif TRI_COLOUR == 1
  return vload4(particle, (__global const float*)colours);
#else
  return (float4)(as_float(colours[particle]), 0.0f, 0.0f, 1.0f);
#endif
}

__kernel void shade(__global const Particles* restrict parameters,
                    __global const float* restrict camera, __global const uint* restrict ids,
                    __global const uint* restrict colours, __global const float4* restrict table,
                    __global const uint* restrict winners, __global float4* restrict image,
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
    float4 c = vload4(particle, camera);
    float sx = pixel_ray_x(&u, x);
    float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, sx, sy);
    float light = u.shading.x + u.shading.y * tri_sphere_cosine(c.w, sx, sy, discriminant);
    float4 colour = stored_colour(colours, particle);
#if TRI_COLOUR == 2
    colour = transfer_colour(table, colour.x);
#endif
    image[pixel] = (float4)(light * colour.xyz, 1.0f);
    shown[pixel] = ids[particle];
  }
}
