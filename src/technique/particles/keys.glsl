// The depth key and the particle key that are stored for each pixel. The nearest depth has the largest depth key,
// and 0 means that no sphere was found. The first particle in the drawing order has the smallest particle key.
// The injected fault 2 reverses the order of particle keys, and fault 3 the order of depth keys.

#define TRI_LARGEST_KEY 0xFFFFFFFFu
#define TRI_NO_PARTICLE 0xFFFFFFFFu

uint depth_key(float depth) {
  uint bits = floatBitsToUint(depth);
  return TRI_FAULT == 3 ? ~bits : bits;
}
float depth_of_key(uint key) { return uintBitsToFloat(TRI_FAULT == 3 ? ~key : key); }
uint particle_key(uint particle) { return TRI_FAULT == 2 ? ~particle & 0x7FFFFFFFu : particle; }
uint particle_of_key(uint key) { return TRI_FAULT == 2 ? ~key & 0x7FFFFFFFu : key; }

// Returns the depth key of the sphere on the ray through this point of the image plane, or 0 if the ray misses
// the sphere. Nearer surfaces have larger depth keys.
uint sphere_key(vec4 c, vec2 s) {
  float discriminant = tri_sphere_discriminant(c.x, c.y, c.z, c.w, s.x, s.y);
  float distance = tri_sphere_distance(c.x, c.y, c.z, s.x, s.y, max(discriminant, 0.0));
  return discriminant >= 0.0 && distance > 0.0 ? depth_key(tri_depth(u.eye.w, distance)) : 0u;
}
