// Maths for the boxes around spheres, and for the Hilbert curve along which spheres are sorted. Like sphere_math.h,
// it is written in the common subset of C++, GLSL and OpenCL C. It uses only sums, products and comparisons. Each sum
// and product is rounded exactly once, so every API builds the same hierarchy.

// These functions return the lower and upper bounds of a sphere along one axis in world space. The two roundings of
// c ± r have a total error of less than 2u·(|c| + r), with u = 2⁻²⁴. The box extends 4u·(|c| + r) beyond the sphere
// on each side.
TRI_FN float tri_box_low(float c, float r) {
  TRI_PRECISE float size = (c < 0.0f ? 0.0f - c : c) + r;
  TRI_PRECISE float low = (c - r) - 2.4e-7f * size;
  return low;
}
TRI_FN float tri_box_high(float c, float r) {
  TRI_PRECISE float size = (c < 0.0f ? 0.0f - c : c) + r;
  TRI_PRECISE float high = (c + r) + 2.4e-7f * size;
  return high;
}

// Returns the largest value of n·p over all points p of a box.
TRI_FN float tri_box_highest(float nx, float ny, float nz, float lx, float ly, float lz, float hx, float hy, float hz) {
  TRI_PRECISE float ax = nx * lx;
  TRI_PRECISE float bx = nx * hx;
  TRI_PRECISE float ay = ny * ly;
  TRI_PRECISE float by = ny * hy;
  TRI_PRECISE float az = nz * lz;
  TRI_PRECISE float bz = nz * hz;
  TRI_PRECISE float highest = (ax > bx ? ax : bx) + (ay > by ? ay : by) + (az > bz ? az : bz);
  return highest;
}

// Returns Σ max(|l|, |h|) over the three axes. No point of the box is farther from the origin than this.
TRI_FN float tri_box_reach(float lx, float ly, float lz, float hx, float hy, float hz) {
  float x = 0.0f - lx > hx ? 0.0f - lx : hx;
  float y = 0.0f - ly > hy ? 0.0f - ly : hy;
  float z = 0.0f - lz > hz ? 0.0f - lz : hz;
  TRI_PRECISE float reach = x + y + z;
  return reach;
}

// Returns the index, from 0 to 1023, of the grid cell that contains a coordinate. The grid begins at `low` and has
// `scale` cells per unit length.
TRI_FN int tri_grid_cell(float c, float low, float scale) {
  TRI_PRECISE float at = (c - low) * scale;
  return TRI_INT(at > 0.0f ? (at < 1023.0f ? at : 1023.0f) : 0.0f);
}

// Moves bit i of the lowest ten bits to position 3·i.
TRI_FN int tri_every_third_bit(int x) {
  int spread = (x | (x << 16)) & 0x030000FF;
  spread = (spread | (spread << 8)) & 0x0300F00F;
  spread = (spread | (spread << 4)) & 0x030C30C3;
  return (spread | (spread << 2)) & 0x09249249;
}

// Returns the position of a cell of the 1024³ grid along the Hilbert curve (Skilling, Programming the Hilbert curve,
// 2004). Consecutive cells on this curve are neighbours, so every run of cells has a small bounding box. On a Morton
// curve, consecutive cells can be far apart.
TRI_FN int tri_hilbert_place(int x, int y, int z) {
  int a = x;
  int b = y;
  int c = z;
  for (int q = 512; q > 1; q = q >> 1) {
    int p = q - 1;
    a = (a & q) != 0 ? a ^ p : a;
    int swapped = (a ^ b) & p;
    int turned = b & q;
    a = turned != 0 ? a ^ p : a ^ swapped;
    b = turned != 0 ? b : b ^ swapped;
    swapped = (a ^ c) & p;
    turned = c & q;
    a = turned != 0 ? a ^ p : a ^ swapped;
    c = turned != 0 ? c : c ^ swapped;
  }
  b = b ^ a;
  c = c ^ b;
  int flip = 0;
  for (int q = 512; q > 1; q = q >> 1) flip = (c & q) != 0 ? flip ^ (q - 1) : flip;
  return tri_every_third_bit(a ^ flip) * 4 + tri_every_third_bit(b ^ flip) * 2 + tri_every_third_bit(c ^ flip);
}
