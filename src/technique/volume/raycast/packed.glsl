// Fetches from the buffer that technique::fill_packed_cells fills. One or two loads return the eight voxels around
// a position.

struct Corners {
  real4 lower, upper;  // for the lower and the upper z: (x, y), (x+1, y), (x, y+1), (x+1, y+1)
};

// A position, given by its cell and the position within the cell.
struct Place {
  ivec3 cell;
  real3 f;
};

// For positions up to half a voxel beyond the outermost voxel centres, p + ½ is not negative, so truncation equals
// floor. Positions beyond the volume are clamped to the far end of the last cell, so that they read inside the
// buffer.
Place place_of(Grid grid, real3 p) {
  if (TRI_FAULT == fault_half_voxel_shift) p.x += 0.5;
  if (TRI_FAULT == fault_flipped_axis) p.y = real(grid.last.y + 1) - p.y;
  real3 q = clamp(p + 0.5, real3(0.0), real3(grid.last) + 1.9375);
  Place place;
  place.cell = ivec3(q);
  place.f = q - real3(place.cell);
  if (TRI_FAULT == fault_coarse_filter) place.f = floor(place.f * 256.0 + 0.5) / 256.0;
  return place;
}

ivec3 cell_strides(Grid grid) {
  int row = grid.last.x + 2;
  return ivec3(1, row, row * (grid.last.y + 2));
}

int cell_index(Grid grid, ivec3 cell) {
#if TRI_PARTS
  cell.z = clamp(cell.z - u.part.z, 0, u.part.w - 1);
#endif
  ivec3 strides = cell_strides(grid);
  return cell.x + strides.y * cell.y + strides.z * cell.z;
}

ivec4 bytes_of(uint word) { return ivec4(word & 255u, word >> 8 & 255u, word >> 16 & 255u, word >> 24); }
ivec4 halves_of(uvec2 words) {
  return ivec4(words.x & 65535u, words.x >> 16, words.y & 65535u, words.y >> 16);
}

// Converts half floats that are neither negative nor subnormal. Their bits, shifted into a float, represent a
// number that is too small by a factor of 2¹¹². The multiplication is `precise`, because a compiler that applied
// the factor later would interpolate denormals.
vec4 floats_of(uvec2 words) {
  precise vec4 floats = uintBitsToFloat(uvec4(halves_of(words)) << 13) * 5192296858534827628530496329220096.0;
  return floats;
}

Corners corners_of(Grid grid, int index) {
  uvec4 texel = texelFetch(cell_texels, index);
  if (TRI_VOXEL_BITS == 8) return Corners(real4(bytes_of(texel.x)), real4(bytes_of(texel.y)));
  if (TRI_VOXEL_BITS == 16) return Corners(real4(halves_of(texel.xy)), real4(halves_of(texel.zw)));
  if (TRI_VOXEL_BITS == -16) return Corners(real4(floats_of(texel.xy)), real4(floats_of(texel.zw)));
  uvec4 above = texelFetch(cell_texels, index + cell_strides(grid).z);
  return Corners(real4(uintBitsToFloat(texel)), real4(uintBitsToFloat(above)));
}

// Returns the differences between the corners of the cells `front` and `back`. For integer voxels, the differences
// are exact.
Corners corners_between(Grid grid, int back, int front) {
  if (TRI_VOXEL_BITS == 8 || TRI_VOXEL_BITS == 16) {
    uvec4 a = texelFetch(cell_texels, back);
    uvec4 b = texelFetch(cell_texels, front);
    if (TRI_VOXEL_BITS == 8) {
      return Corners(real4(bytes_of(b.x) - bytes_of(a.x)), real4(bytes_of(b.y) - bytes_of(a.y)));
    }
    return Corners(real4(halves_of(b.xy) - halves_of(a.xy)), real4(halves_of(b.zw) - halves_of(a.zw)));
  }
  Corners a = corners_of(grid, back);
  Corners b = corners_of(grid, front);
  return Corners(b.lower - a.lower, b.upper - a.upper);
}

real trilinear(Corners corners, real3 f) {
  real4 z = corners.lower + f.z * (corners.upper - corners.lower);
  real2 y = z.xy + f.y * (z.zw - z.xy);
  return y.x + f.x * (y.y - y.x);
}

// Returns the normalised value at p.
real field(Grid grid, real3 p) {
  Place place = place_of(grid, p);
  real stored = trilinear(corners_of(grid, cell_index(grid, place.cell)), place.f);
  return stored * grid.value_map.x + grid.value_map.y;
}

// Returns central differences: for each axis, the normalised value one voxel after p minus the value one voxel
// before p. Both positions have the same coordinates within their cells. Beyond the outermost cells, all values
// are constant along the axis.
real3 rises(Grid grid, real3 p) {
  Place place = place_of(grid, p);
  // If a step is longer than a voxel (TRI_OPACITY_FORM is then not positive), the last sample may be so far beyond
  // the exit that all values are constant even one voxel before it. However, place_of() clamps the sample to a
  // position closer to the volume, so its position in the cell is computed again here.
  if (TRI_OPACITY_FORM < 1 && TRI_FAULT == 0) place.f = clamp(p + 0.5 - real3(place.cell), real3(0.0), real3(1.0));
  ivec3 strides = cell_strides(grid);
  int here = cell_index(grid, place.cell);
  ivec3 back = here - strides * ivec3(greaterThan(place.cell, ivec3(0)));
  ivec3 front = here + strides * ivec3(lessThanEqual(place.cell, grid.last));
  return grid.value_map.x * real3(trilinear(corners_between(grid, back.x, front.x), place.f),
                                  trilinear(corners_between(grid, back.y, front.y), place.f),
                                  trilinear(corners_between(grid, back.z, front.z), place.f));
}
