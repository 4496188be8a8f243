// One work group per tile, four pixels per invocation: the tile's entries in batches that the group loads
// together, then the farthest of what its pixels show.
layout(local_size_x = 64) in;

const int pixels_each = TRI_TILE * TRI_TILE / 64;

shared vec4 batch_spheres[64];
shared uint batch_particles[64];
shared uint shared_farthest;

void wait() {
  if (TRI_FAULT != 7) barrier();
}

ivec2 pixel_of(int k) {
  int i = 64 * k + int(gl_LocalInvocationIndex);
  return TRI_TILE * ivec2(gl_WorkGroupID.xy) + ivec2(i % TRI_TILE, i / TRI_TILE);
}

bool in_view(ivec2 pixel) { return pixel.x < u.viewport.x && pixel.y < u.viewport.y; }

void load_batch(uint first, uint end) {
  uint lane = gl_LocalInvocationIndex;
  if (first + lane < end) {
    uint place = entries[first + lane];
    batch_spheres[lane] = kept_spheres[place];
    batch_particles[lane] = particle_key(kept[place]);
  }
}

// Depth key and particle key of the nearest large sphere in each of this invocation's pixels.
void draw_entries(uint first, uint end, inout uint depths[pixels_each], inout uint particles[pixels_each]) {
  for (; first < end; first += 64u) {
    wait();
    load_batch(first, end);
    wait();
    int count = int(min(64u, end - first));
    for (int j = 0; j < count; ++j) {
      vec4 sphere = batch_spheres[j];
      uint particle = batch_particles[j];
      for (int k = 0; k < pixels_each; ++k) {
        uint key = sphere_key(sphere, pixel_of(k));
        bool nearer = key > depths[k] || (key == depths[k] && particle < particles[k]);
        depths[k] = nearer ? key : depths[k];
        particles[k] = nearer ? particle : particles[k];
      }
    }
  }
}

void main() {
  uint index = tile_index(ivec2(gl_WorkGroupID.xy));
  uint count = tiles[index].entries;
  uint end = tiles[index].next;
  uint large = 2u * plane_size();
  if (gl_LocalInvocationIndex == 0u) shared_farthest = TRI_LARGEST_KEY;
  uint depths[pixels_each];
  uint particles[pixels_each];
  for (int k = 0; k < pixels_each; ++k) {
    bool inside = in_view(pixel_of(k));
    uint place = pixel_index(pixel_of(k));
    depths[k] = inside ? pixels[large + place] : TRI_LARGEST_KEY;
    particles[k] = inside ? pixels[large + plane_size() + place] : 0u;
  }
  if (count > 0u) draw_entries(end - count, end, depths, particles);
  uint farthest = TRI_LARGEST_KEY;
  for (int k = 0; k < pixels_each; ++k) {
    if (in_view(pixel_of(k))) {
      uint place = pixel_index(pixel_of(k));
      uint nearest = max(pixels[place], depths[k]);
      farthest = min(farthest, nearest);
      if (count > 0u) {
        pixels[place] = nearest;
        pixels[large + place] = depths[k];
        pixels[large + plane_size() + place] = particles[k];
      }
    }
  }
  wait();
  atomicMin(shared_farthest, farthest);
  wait();
  if (gl_LocalInvocationIndex == 0u) {
    tiles[index].farthest = shared_farthest;
    tiles[index].entries = 0u;
  }
}
