// After all depths are known, this pass finds the particle with the lowest index among the small spheres at each
// pixel's depth.
layout(local_size_x = 64) in;

void main() {
  uint stride = 64u * gl_NumWorkGroups.x;
  for (uint n = gl_GlobalInvocationID.x; n < small_kept; n += stride) {
    uint particle = kept[n];
    vec4 sphere = texelFetch(camera_texels, int(particle));
    ivec4 rectangle = pixel_rectangle(sphere);
    int count = front_key(sphere) >= farthest_around(rectangle) ? rectangle.z * rectangle.w : 0;
    ivec2 pixel = rectangle.xy;
    int right = rectangle.x + rectangle.z;
    for (int i = 0; i < count; ++i) {
      uint key = sphere_key(sphere, pixel_ray(pixel));
      if (key > 0u && key == depth_seen(pixel)) {
        atomicMin(pixels[plane_size() + pixel_index(pixel)], particle_key(particle));
      }
      ++pixel.x;
      if (pixel.x == right) pixel = ivec2(rectangle.x, pixel.y + 1);
    }
  }
}
