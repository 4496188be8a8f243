// Each invocation traces a beam, the bundle of the rays of 4×2 pixels, through the hierarchy and visits the nearer
// child of each node first. It tests each sphere whose box the beam crosses, unless every pixel of the beam has already
// found a surface in front of the box. A block consists of 8×8 beams. Eight consecutive invocations cover a square of
// 8×8 pixels, because software devices run eight invocations at once.
//
// The traversal needs no stack. `trail` has one bit for each level from the current node up to the children of the
// root. A bit is 1 if the sibling at that level needs no visit, because it has been visited or because the beam
// misses it. These bits and the number of the current node determine where the traversal continues (Laine, Restart
// trail for stackless BVH traversal, 2010).
//
// Components of TRI_STEP:
//   x  stride: only every x-th beam is traced
//   y  number of blocks per row
//   z  number of beams
//   w  flags: 1 resumes traversals that an earlier dispatch did not finish; 2 stores where traversals stop
//
// Mesa's software devices run 8 invocations in lockstep. After 65,535 iterations of all loops together, they end
// the loops without an error. An invocation therefore visits at most s = TRI_MOST_STEPS nodes per dispatch. At most
// s/2 of these nodes (plus one per level) are leaves, because a traversal does not visit more leaves than inner
// nodes. A leaf takes 11 iterations: 1 of the outer loop, 1 to end the inner loop, and 9 for up to 8 spheres. All
// leaves together take 11·s/2 iterations. Inner nodes take at most 8·s/2 iterations; this maximum occurs if no two
// invocations are ever at an inner node at the same time. The total of 9.5s plus a few hundred is less than 65,535
// for s = 6,800.
layout(local_size_x = 64) in;

TRI_BINDING(13) uniform samplerBuffer box_texels;
TRI_BINDING(14) uniform samplerBuffer tree_sphere_texels;
TRI_BINDING(15) uniform usamplerBuffer tree_order_texels;

#define TRI_BEAM_X 4
#define TRI_BEAM_Y 2
#define TRI_BEAM_PIXELS 8
#define TRI_MOST_STEPS 6800u

// The normals of the planes through the eye that bound the beam (the bundle of the rays of 4×2 pixels). The beam is on
// the positive side of each plane.
vec3 left_side;
vec3 right_side;
vec3 upper_side;
vec3 lower_side;
float slack_share;
ivec2 first_pixel;
uint depth_keys[TRI_BEAM_PIXELS];
uint particle_keys[TRI_BEAM_PIXELS];
uint lowest_key;
#if TRI_COUNT
uint nodes_visited = 0u;
uint boxes_tested = 0u;
uint intersections_tested = 0u;
#endif

ivec2 beam_pixel(int k) { return first_pixel + ivec2(k % TRI_BEAM_X, k / TRI_BEAM_X); }
bool in_picture(ivec2 pixel) { return pixel.x < u.viewport.x && pixel.y < u.viewport.y; }

// Computes the planes that bound a beam, which is the bundle of the rays of 4×2 pixels. The planes lie 1/64 pixel
// outside its outermost rays, because a silhouette computed in single precision may exceed the exact silhouette, by
// less than 1/64 pixel. (Sprites have the same margin.)
void open_beam(uint beam) {
  uint block = beam / 64u;
  uint n = beam % 64u;
  uvec2 place = uvec2((n & 1u) + (n >> 2 & 6u), (n >> 1 & 3u) + (n >> 3 & 4u));
  place += 8u * uvec2(block % TRI_STEP.y, block / TRI_STEP.y);
  first_pixel = ivec2(place) * ivec2(TRI_BEAM_X, TRI_BEAM_Y);
  vec2 upper_left = pixel_ray(first_pixel);
  vec2 lower_right = pixel_ray(first_pixel + ivec2(TRI_BEAM_X - 1, TRI_BEAM_Y - 1));
  TRI_PRECISE vec2 margin = 0.015625 * u.plane.zw;
  TRI_PRECISE vec2 low = vec2(upper_left.x, lower_right.y) - margin;
  TRI_PRECISE vec2 high = vec2(lower_right.x, upper_left.y) + margin;
  TRI_PRECISE vec3 left = u.right.xyz - low.x * u.forward.xyz;
  TRI_PRECISE vec3 right = high.x * u.forward.xyz - u.right.xyz;
  TRI_PRECISE vec3 lower = u.up.xyz - low.y * u.forward.xyz;
  TRI_PRECISE vec3 upper = high.y * u.forward.xyz - u.up.xyz;
  left_side = left;
  right_side = right;
  lower_side = lower;
  upper_side = upper;
  vec2 widest = max(abs(low), abs(high));
  TRI_PRECISE float share = 3.8e-6 * (1.0 + max(widest.x, widest.y));
  slack_share = share;
}

float highest(vec3 n, vec3 lo, vec3 hi) {
  return tri_box_highest(n.x, n.y, n.z, lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
}

// Returns whether the beam crosses the box and something in the box may be visible. `nearest` receives the smallest
// distance from the eye to the box along the view axis. The tolerance for rounding is 2⁻¹⁸ of the distance from the eye
// to the farthest point of the box. With u = 2⁻²⁴, it covers the rounding of products and sums (8u), the rounding of
// the camera's axes (u) and, for `nearest`, the error in the distance of a sphere's surface. For a sphere of radius r
// whose centre is at C relative to the eye, this error is 24u·(|C| + r). Enlarging the box by 2.4e-7 of the eye's
// coordinates covers the rounding of the eye.
bool may_show(vec3 world_lo, vec3 world_hi, out float nearest) {
  TRI_PRECISE vec3 around = 2.4e-7 * abs(u.eye.xyz);
  TRI_PRECISE vec3 lo = (world_lo - u.eye.xyz) - around;
  TRI_PRECISE vec3 hi = (world_hi - u.eye.xyz) + around;
  TRI_PRECISE float slack = slack_share * tri_box_reach(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
  TRI_PRECISE float before = -highest(-u.forward.xyz, lo, hi) - slack;
  bool outside = highest(left_side, lo, hi) < -slack || highest(right_side, lo, hi) < -slack ||
                 highest(upper_side, lo, hi) < -slack || highest(lower_side, lo, hi) < -slack;
  nearest = before;
  float front = TRI_FAULT == 4 ? highest(u.forward.xyz, lo, hi) : before;
  TRI_PRECISE float deepest = front * (TRI_FAULT == 3 ? 0.0 : uintBitsToFloat(lowest_key));
#if TRI_COUNT
  ++boxes_tested;
#endif
  return !outside && !(deepest > u.eye.w);
}

void test_sphere(vec4 sphere, uint particle) {
  vec4 c = camera_space(sphere);
  uint key = particle_key(particle);
  uint lowest = TRI_LARGEST_KEY;
  for (int k = 0; k < TRI_BEAM_PIXELS; ++k) {
    ivec2 pixel = beam_pixel(k);
    uint depth = sphere_key(c, pixel_ray(pixel));
    bool wins = depth > depth_keys[k] || (depth > 0u && depth == depth_keys[k] && key < particle_keys[k]);
    depth_keys[k] = wins ? depth : depth_keys[k];
    particle_keys[k] = wins ? key : particle_keys[k];
    lowest = in_picture(pixel) ? min(lowest, depth_keys[k]) : lowest;
#if TRI_COUNT
    intersections_tested += in_picture(pixel) ? 1u : 0u;
#endif
  }
  lowest_key = lowest;
}

void test_leaf(uint leaf) {
  uint end = leaf_begin(leaf + 1u);
  for (uint i = leaf_begin(leaf); i < end; ++i) {
    vec4 sphere = texelFetch(tree_sphere_texels, int(i));
    vec3 lo;
    vec3 hi;
    sphere_box(sphere, lo, hi);
    float nearest;
    if (may_show(lo, hi, nearest)) test_sphere(sphere, texelFetch(tree_order_texels, int(i)).x);
  }
}

// Moves to the next node to visit, which is the sibling of this node or of its nearest ancestor whose sibling still
// has to be visited. Sets `node` to 0 if there is none.
void go_on(inout uint node, inout uint trail) {
  int up = findLSB(~trail);
  node >>= up;
  trail = trail >> up | 1u;
  node = node > 1u ? node ^ 1u : 0u;
}

// Traverses the hierarchy from a node to the end (node 0), but stops after TRI_MOST_STEPS nodes. The inner loop
// visits inner nodes until it reaches a leaf. Devices that run several invocations in lockstep execute the code for
// leaves whenever any of the invocations is at a leaf. With these nested loops, the invocations tend to reach their
// leaves together (Aila and Laine, Understanding the efficiency of ray traversal on GPUs, 2009).
void trace(inout uint node, inout uint trail) {
  uint leaves = 1u << TRI_TREE_SHAPE.y;
  uint step = 0u;
  while (node != 0u && step < TRI_MOST_STEPS) {
    while (node != 0u && node < leaves && step < TRI_MOST_STEPS) {
      int at = 4 * int(node);
      float nearest_a;
      float nearest_b;
      bool a = may_show(texelFetch(box_texels, at).xyz, texelFetch(box_texels, at + 1).xyz, nearest_a);
      bool b = may_show(texelFetch(box_texels, at + 2).xyz, texelFetch(box_texels, at + 3).xyz, nearest_b);
#if TRI_COUNT
      ++nodes_visited;
#endif
      if (a || b) {
        bool second = b && (!a || nearest_b < nearest_a);
        node = 2u * node + (second ? 1u : 0u);
        trail = 2u * trail + (a && b ? 0u : 1u);
      } else {
        go_on(node, trail);
      }
      ++step;
    }
    if (node >= leaves) {
      test_leaf(node - leaves);
      go_on(node, trail);
      ++step;
    }
  }
}

void main() {
  uint n = 64u * (gl_WorkGroupID.y * TRI_GROUP_COLUMNS + gl_WorkGroupID.x) + gl_LocalInvocationIndex;
  uint beam = n * TRI_STEP.x;
  if (beam >= TRI_STEP.z) return;
  bool continues = (TRI_STEP.w & 1u) != 0u;
  uint node = continues ? scratch[2u * beam] : 1u;
  uint trail = continues ? scratch[2u * beam + 1u] : 0u;
  open_beam(beam);
  if (!in_picture(first_pixel)) node = 0u;
  if (node == 0u) {
    if ((TRI_STEP.w & 2u) != 0u) scratch[2u * beam] = 0u;
    return;
  }
  lowest_key = continues ? TRI_LARGEST_KEY : 0u;
  for (int k = 0; k < TRI_BEAM_PIXELS; ++k) {
    depth_keys[k] = 0u;
    particle_keys[k] = TRI_NO_PARTICLE;
    if (!continues || !in_picture(beam_pixel(k))) continue;
    int at = pixel_index(beam_pixel(k));
    depth_keys[k] = pixels[at];
    particle_keys[k] = pixels[plane_size() + at];
    lowest_key = min(lowest_key, depth_keys[k]);
  }
  trace(node, trail);
  if ((TRI_STEP.w & 2u) != 0u) {
    scratch[2u * beam] = node;
    scratch[2u * beam + 1u] = trail;
  }
  for (int k = 0; k < TRI_BEAM_PIXELS; ++k) {
    if (!in_picture(beam_pixel(k))) continue;
    int at = pixel_index(beam_pixel(k));
    pixels[at] = depth_keys[k];
    pixels[plane_size() + at] = particle_keys[k];
  }
#if TRI_COUNT
  add_count(TRI_COUNT_NODES, beam, nodes_visited);
  add_count(TRI_COUNT_BOXES, beam, boxes_tested);
  add_count(TRI_COUNT_INTERSECTIONS, beam, intersections_tested);
#endif
}
