// A work group of 32 invocations processes each tile that tiles_place has listed. There are eight invocations for each
// quarter of the tile, and each of them processes a column of eight pixels. They find the nearest entry (large sphere)
// at each pixel, and then the farthest depth among the tile's pixels.
layout(local_size_x = 32) in;

struct Column {  // eight pixels; each vector holds two, as a texel of large_pixels does
  uvec4 a;
  uvec4 b;
  uvec4 c;
  uvec4 d;
};

ivec2 pair_place(ivec2 pixel, int n) { return ivec2(pixel.x, pixel.y / 2 + n); }

uvec4 load_pair(ivec2 pixel, int n, bool fresh) {
  uvec4 pair = imageLoad(large_pixels, pair_place(pixel, n));
  return fresh ? uvec4(0u, TRI_NO_PARTICLE, 0u, TRI_NO_PARTICLE) : pair;
}

uvec4 with_sphere(uvec4 pair, vec4 sphere, uint particle, float right, float upper, float lower) {
  uint above = sphere_key(sphere, vec2(right, upper));
  uint below = sphere_key(sphere, vec2(right, lower));
  bool wins = above > pair.x || (above == pair.x && particle < pair.y);
  bool wins_below = below > pair.z || (below == pair.z && particle < pair.w);
  return uvec4(wins ? above : pair.x, wins ? particle : pair.y,
               wins_below ? below : pair.z, wins_below ? particle : pair.w);
}

// Returns the next entry (large sphere) of the tile that reaches this quarter of it, or 0 if there is none. A separate
// loop is necessary because lanes that run in lockstep can skip work only in a loop. The condition is at the end of the
// loop, because a condition at the beginning would cost the lanes one more idle iteration.
uint next_entry(inout uint at, uint end, uint quarter) {
  uint found = 0u;
  do {
    uint entry = at < end ? texelFetch(entry_texels, int(at)).x : 0u;
    found = (entry & quarter) != 0u ? entry : 0u;
    ++at;
  } while (at < end && found == 0u);
  return found;
}

void draw_entries(uint at, uint end, uint quarter, ivec2 pixel, inout Column column) {
  float right = pixel_ray(pixel).x;
  vec4 upper;
  vec4 lower;
  for (int k = 0; k < 4; ++k) {
    upper[k] = pixel_ray(pixel + ivec2(0, 2 * k)).y;
    lower[k] = pixel_ray(pixel + ivec2(0, 2 * k + 1)).y;
  }
  uint entry = next_entry(at, end, quarter);
  do {
    uint particle = particle_of(entry);
    vec4 sphere = texelFetch(camera_texels, int(particle));
    if (entry == 0u) sphere = vec4(0.0, 0.0, -1.0, 0.0);  // without an entry, use a sphere that is not visible
    particle = particle_key(particle);
    column.a = with_sphere(column.a, sphere, particle, right, upper.x, lower.x);
    column.b = with_sphere(column.b, sphere, particle, right, upper.y, lower.y);
    column.c = with_sphere(column.c, sphere, particle, right, upper.z, lower.z);
    column.d = with_sphere(column.d, sphere, particle, right, upper.w, lower.w);
    entry = next_entry(at, end, quarter);
  } while (entry != 0u);
}

// Returns the depth key of the nearest sphere drawn at a pixel so far, or the largest key if the pixel is
// outside the image.
uint shown_key(ivec2 pixel, uint large) {
  bool inside = pixel.x < u.viewport.x && pixel.y < u.viewport.y;
  uint small = (TRI_SPHERES & TRI_SMALL) != 0 ? depth_seen(pixel) : 0u;
  return inside ? max(small, large) : TRI_LARGEST_KEY;
}

uint farthest_of_pair(uvec4 pair, ivec2 pixel) {
  return min(shown_key(pixel, pair.x), shown_key(pixel + ivec2(0, 1), pair.z));
}

void resolve(int index) {
  ivec2 grid = tile_grid();
  int lane = int(gl_LocalInvocationIndex);
  int quarter = lane / 8;
  ivec2 pixel = TRI_TILE * ivec2(index % grid.x, index / grid.x) + 8 * ivec2(quarter % 2, quarter / 2);
  pixel.x += lane % 8;
  uvec4 state = tile_state(index);
  Column column = Column(uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u));
  if ((TRI_SPHERES & TRI_RESOLVED) != 0) {
    bool fresh = (state.w & TRI_HAS_LARGE) == 0u;
    column = Column(load_pair(pixel, 0, fresh), load_pair(pixel, 1, fresh), load_pair(pixel, 2, fresh),
                    load_pair(pixel, 3, fresh));
    draw_entries(state.y - state.x, state.y, 1u << (TRI_PARTICLE_BITS + quarter), pixel, column);
    if (state.x > 0u) {
      imageStore(large_pixels, pair_place(pixel, 0), column.a);
      imageStore(large_pixels, pair_place(pixel, 1), column.b);
      imageStore(large_pixels, pair_place(pixel, 2), column.c);
      imageStore(large_pixels, pair_place(pixel, 3), column.d);
    }
  }
  uint farthest = min(min(farthest_of_pair(column.a, pixel), farthest_of_pair(column.b, pixel + ivec2(0, 2))),
                      min(farthest_of_pair(column.c, pixel + ivec2(0, 4)),
                          farthest_of_pair(column.d, pixel + ivec2(0, 6))));
  atomicMin(tiles[index].coming, farthest);
}

void main() {
  uint n = gl_WorkGroupID.y * TRI_MOST_GROUPS + gl_WorkGroupID.x;
  if (n < tiles_listed) resolve(int(tiles[n].listed));
}
