// Rectangles of pixels, and the rectangle around a sphere's silhouette.

// A rectangle of pixels is stored in two words: its first and its last pixel, both inclusive. The
// lower half of a word is x and the upper half is y.
#define TRI_EMPTY_FIRST 0x00000001u
#define TRI_EMPTY_LAST 0u
TRI_FN bool is_empty(uint first, uint last) {
  return first == TRI_EMPTY_FIRST && last == TRI_EMPTY_LAST;
}
TRI_FN uint packed(int x, int y) { return (uint)x | (uint)y << 16; }
TRI_FN int unpacked_x(uint corner) { return (int)(corner & 0xFFFFu); }
TRI_FN int unpacked_y(uint corner) { return (int)(corner >> 16); }

// Returns the first and the last pixel whose centres lie in [low, high] on one axis of the image
// plane, counted from the lower edge of the plane; first > last if there are none. The plane has
// `n` pixels of size `pixel` and extends from -half_extent to half_extent.
TRI_FN int first_pixel(float low, float half_extent, float pixel, int n) {
  float at = (low + half_extent) / pixel - 0.5f;
  at = at > 0.0f ? at : 0.0f;
  at = at < (float)n ? at : (float)n;
  return (int)tri_ceil(at);
}
TRI_FN int last_pixel(float high, float half_extent, float pixel, int n) {
  float at = (high + half_extent) / pixel - 0.5f;
  at = at > -1.0f ? at : -1.0f;
  at = at < (float)(n - 1) ? at : (float)(n - 1);
  return (int)tri_floor(at);
}

// Returns the interval that a sphere covers along one axis, with a margin of 1/64 pixel. The
// injected fault removes 1 % of the interval.
TRI_FN float2 covered(float a, float z, float r, float pixel, float scale) {
  float2 bounds = tri_sphere_interval(a, z, r);
  float low = bounds.x - 0.015625f * pixel;
  float high = bounds.y + 0.015625f * pixel;
  float shrink = scale < 1.0f ? 0.5f * (1.0f - scale) * (high - low) : 0.0f;
  return (float2)(low + shrink, high - shrink);
}

TRI_FN int tiles_across(const Particles* u) {
  return (u->viewport.x + TRI_TILE - 1) >> TRI_TILE_SHIFT;
}
TRI_FN int tiles_down(const Particles* u) {
  return (u->viewport.y + TRI_TILE - 1) >> TRI_TILE_SHIFT;
}
