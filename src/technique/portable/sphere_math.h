// Sphere maths in the common subset of C++, GLSL and OpenCL C, like volume_math.h. All coordinates are in camera
// space: x to the right, y up, z the distance along the view axis. A ray passes through the point (sx, sy) of the
// image plane z = 1, so its direction is (sx, sy, 1).

// ---- From world to camera space -------------------------------------------------------------------
// The camera coordinate of a centre P along an axis of the camera is axis·(P − eye). If it were computed with plain
// float arithmetic, it would have the rounding error of the *largest* product, which exceeds a pixel if the field of
// view is narrow. Here, the rounding errors of all products and sums are also computed, and added at the end (Dekker
// 1971; Ogita, Rump, Oishi 2005: Dot2). The result is as accurate as if it had been computed in twice the precision and
// then rounded. Each coordinate of the axis and the eye consists of two floats: the nearest float and the remainder.

// Returns the rounding error of sum = a + b.
TRI_FN float tri_sum_error(float a, float b, float sum) {
  TRI_PRECISE float part = sum - a;
  TRI_PRECISE float whole = sum - part;
  TRI_PRECISE float error = (a - whole) + (b - part);
  return error;
}

// Returns the upper 12 bits of a's significand, for |a| < 2^115.
TRI_FN float tri_upper_half(float a) {
  TRI_PRECISE float wide = a * 4097.0f;
  TRI_PRECISE float rest = wide - a;
  TRI_PRECISE float upper = wide - rest;
  return upper;
}

// Returns the rounding error of product = a·b.
TRI_FN float tri_product_error(float a, float b, float product) {
  TRI_PRECISE float a_hi = tri_upper_half(a);
  TRI_PRECISE float b_hi = tri_upper_half(b);
  TRI_PRECISE float a_lo = a - a_hi;
  TRI_PRECISE float b_lo = b - b_hi;
  TRI_PRECISE float error = ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
  return error;
}

// Returns (axis + axis_rest)·(P − eye − eye_rest). All vectors are passed as components.
TRI_FN float tri_along_axis(float px, float py, float pz, float ex, float ey, float ez, float ex_rest,
                            float ey_rest, float ez_rest, float ax, float ay, float az, float ax_rest,
                            float ay_rest, float az_rest) {
  TRI_PRECISE float dx = px - ex;
  TRI_PRECISE float dy = py - ey;
  TRI_PRECISE float dz = pz - ez;
  TRI_PRECISE float dx_rest = tri_sum_error(px, 0.0f - ex, dx) - ex_rest;
  TRI_PRECISE float dy_rest = tri_sum_error(py, 0.0f - ey, dy) - ey_rest;
  TRI_PRECISE float dz_rest = tri_sum_error(pz, 0.0f - ez, dz) - ez_rest;
  TRI_PRECISE float x = ax * dx;
  TRI_PRECISE float y = ay * dy;
  TRI_PRECISE float z = az * dz;
  TRI_PRECISE float xy = x + y;
  TRI_PRECISE float xyz = xy + z;
  TRI_PRECISE float rest = tri_sum_error(x, y, xy) + tri_sum_error(xy, z, xyz) +
                           tri_product_error(ax, dx, x) + tri_product_error(ay, dy, y) +
                           tri_product_error(az, dz, z);
  TRI_PRECISE float small = (ax * dx_rest + ay * dy_rest + az * dz_rest) +
                            (ax_rest * dx + ay_rest * dy + az_rest * dz);
  TRI_PRECISE float result = xyz + (rest + small);
  return result;
}

// ---- Ray and sphere -------------------------------------------------------------------------------
// A sphere with centre c and radius r is intersected with the ray in direction d = (sx, sy, 1). With q = |d|² and
// m = c × d, the distance between the ray and the centre is |m|/√q. The usual formula b² − |c|² + r² with b = c·d/|d|
// would lose precision for distant spheres, because b² and |c|² are much larger than their difference. The terms of m
// are smaller: they grow only with the distances of the centre and the ray from the view axis.

TRI_FN float tri_ray_square(float sx, float sy) {
  TRI_PRECISE float q = sx * sx + sy * sy + 1.0f;
  return q;
}

// Returns r²·q − |m|². The result is negative or NaN if the ray misses the sphere.
TRI_FN float tri_sphere_discriminant(float cx, float cy, float cz, float r, float sx, float sy) {
  TRI_PRECISE float q = sx * sx + sy * sy + 1.0f;
  TRI_PRECISE float mx = cy - cz * sy;
  TRI_PRECISE float my = cz * sx - cx;
  TRI_PRECISE float mz = cx * sy - cy * sx;
  TRI_PRECISE float discriminant = r * r * q - (mx * mx + my * my + mz * mz);
  return discriminant;
}

// Returns the distance, along the view axis, of the first surface point in front of the eye, for a
// discriminant ≥ 0. That is the point where the ray enters the sphere or, if this point is behind the eye, the
// point where it leaves the sphere. The result is not positive if the whole sphere is behind the eye.
TRI_FN float tri_sphere_distance(float cx, float cy, float cz, float sx, float sy, float discriminant) {
  TRI_PRECISE float q = sx * sx + sy * sy + 1.0f;
  TRI_PRECISE float b = cx * sx + cy * sy + cz;
  TRI_PRECISE float root = TRI_SQRT(discriminant);
  TRI_PRECISE float entry = b - root;
  TRI_PRECISE float leave = b + root;
  TRI_PRECISE float distance = (entry > 0.0f ? entry : leave) / q;
  return distance;
}

// Returns the cosine of the angle between the surface normal and the ray, |n·d|/|d|.
TRI_FN float tri_sphere_cosine(float r, float sx, float sy, float discriminant) {
  TRI_PRECISE float q = sx * sx + sy * sy + 1.0f;
  TRI_PRECISE float cosine = TRI_SQRT(discriminant / q) / r;
  return cosine < 1.0f ? cosine : 1.0f;
}

// Returns the reversed depth near/distance, or 1 for everything nearer than `near`.
TRI_FN float tri_depth(float near, float distance) {
  TRI_PRECISE float depth = near / distance;
  return depth < 1.0f ? depth : 1.0f;
}

// ---- Where a sphere lies on the image plane -------------------------------------------------------
// Returns the exact bounds (low, high) of a sphere along one axis of the image plane (Mara and McGuire 2013). `a` is
// the coordinate of the sphere's centre along that axis. The silhouette is between the two tangents in the plane of
// that axis and the view axis. Their angles are φ ± β with φ = atan2(a, z) and sin β = r/√(a² + z²). The part within
// (−90°, 90°) is in front of the eye. A bound of ±3e38 means that the sphere is unbounded in this direction, and
// low > high means that no part of it is in front of the eye. The arithmetic is `precise`, so that the kernel that
// counts tile entries and the kernel that writes them compute the same bounds.
TRI_FN TRI_FLOAT2 tri_sphere_interval(float a, float z, float r) {
  const float huge = 3.0e38f;
  float side = a < 0.0f ? 0.0f - a : a;  // by symmetry, a ≥ 0 may be assumed for the centre of the sphere
  TRI_PRECISE float k2 = side * side + z * z - r * r;
  TRI_PRECISE float low = 0.0f - huge;
  TRI_PRECISE float high = huge;
  if (k2 > 0.0f) {
    TRI_PRECISE float k = TRI_SQRT(k2);
    TRI_PRECISE float low_z = z * k + side * r;
    TRI_PRECISE float high_z = z * k - side * r;
    low = low_z > 0.0f ? (side * k - z * r) / low_z : huge;
    high = high_z > 0.0f ? (side * k + z * r) / high_z : huge;
    if (low_z <= 0.0f) high = 0.0f - huge;
  }
  // The components are selected separately, because selecting between vectors would prevent the vectorisation of
  // loops.
  float first = a < 0.0f ? 0.0f - high : low;
  float second = a < 0.0f ? 0.0f - low : high;
  return TRI_MAKE_FLOAT2(first, second);
}

// Returns −1 if the sphere is completely behind the plane through the eye that is parallel to the
// image, 1 if it reaches this plane or comes so close to it that its projection has no bounds, and
// 0 if it is in front of the plane. If it reaches the plane, the screen-aligned quad of the paper
// (docs/paper.md), a rectangle around projected tangent points, does not exist. The quad is then
// the whole viewport, which makes this technique expensive for close spheres.
TRI_FN int tri_eye_plane(float z, float r) { return z + r <= 0.0f ? 0 - 1 : (z - r > 0.001f * r ? 0 : 1); }

// ---- Sprites --------------------------------------------------------------------------------------
// d is the distance |c| of the sphere's centre from the eye, and r is the sphere's radius.
//
// A ray-aligned sprite is perpendicular to v = c/|c|. Its distance from the eye is tri_sprite_plane, so it lies just
// in front of the sphere. Every visible point of the sphere is therefore behind the sprite, as required for
// conservative depth. In the plane of the sprite, the silhouette is a circle with the radius
// tri_silhouette_on_plane ≤ r.

// Returns 1 if the eye is inside the sphere, or so close to it that the silhouette covers (almost) half of all
// directions. The sprite is then the whole viewport. d2 = |c|².
TRI_FN int tri_surrounds(float d2, float r) { return d2 > r * r * 1.001f ? 0 : 1; }

TRI_FN float tri_sprite_plane(float d, float r) { return (d - r) * 0.9990234375f; }

// Returns plane·tan α, where `plane` is the distance of the sprite from the eye, and sin α = r/d.
TRI_FN float tri_silhouette_on_plane(float d, float r, float plane) {
  return plane * r / TRI_SQRT((d - r) * (d + r));
}

// Returns half the edge length of a sprite, with a margin of 1/64 pixel. Vertices move by less than this margin
// when they are snapped to the rasterizer's grid (1/256 pixel). `pixel` is the size of a pixel on the image plane.
// A `scale` < 1 is an injected fault that makes the sprite smaller than the silhouette.
TRI_FN float tri_sprite_radius(float d, float r, float plane, float pixel, float scale) {
  return scale < 1.0f ? scale * tri_silhouette_on_plane(d, r, plane) : r + 0.015625f * pixel * d;
}

// Returns the radius of a sphere's silhouette in pixels: r divided by the size of a pixel at the sphere's distance.
// tri_adaptive_corners chooses the number of corners by this radius.
TRI_FN float tri_projected_radius(float d, float r, float pixel) { return r / (d * pixel); }

// Returns the number of corners, 4…16, that costs the least. A polygon with N corners around a disc of radius R
// covers ≈ πR²·(π/N)²/3 additional pixels (tan x ≈ x + x³/3), and a corner costs about as much as 64 fragments. The
// total cost is smallest at N³ = 2π³R²/(3·64) ≈ 0.323·R².
TRI_FN int tri_adaptive_corners(float projected_radius) {
  float cube = 0.323f * projected_radius * projected_radius;
  int corners = 4;
  for (int n = 5; n <= 16; ++n) {
    float half_way = TRI_TO_FLOAT(n) - 0.5f;
    corners = cube >= half_way * half_way * half_way ? n : corners;
  }
  return corners;
}

// Returns the cosine of an angle in turns, |turns| ≤ 1, with an error below 1e-6. The angle is reduced to a quarter
// of a turn, for which a power series is evaluated. The built-in cosine is not used, because some languages
// guarantee an accuracy of only 2⁻¹¹ for it, and others none.
TRI_FN float tri_cosine_turns(float turns) {
  float a = turns < 0.0f ? 0.0f - turns : turns;  // the cosine is even
  float b = a > 0.5f ? 1.0f - a : a;              // symmetric about half a turn, so b is in 0…½
  float c = b > 0.25f ? 0.5f - b : b;             // antisymmetric about a quarter, so c is in 0…¼
  float x = c * 6.28318530718f;
  float y = x * x;
  float value = 1.0f - y * (0.5f - y * (0.0416666667f - y * (0.00138888889f - y * (0.0000248015873f -
                y * 0.000000275573192f))));
  return b > 0.25f ? 0.0f - value : value;
}
TRI_FN float tri_sine_turns(float turns) { return tri_cosine_turns(turns - 0.25f); }
