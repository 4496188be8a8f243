// Returns the centre of a sphere in camera space (xyz), and its radius (w).
vec4 camera_space(vec4 s) {
  return vec4(
      tri_along_axis(s.x, s.y, s.z, u.eye.x, u.eye.y, u.eye.z, u.eye_rest.x, u.eye_rest.y, u.eye_rest.z,
                     u.right.x, u.right.y, u.right.z, u.right_rest.x, u.right_rest.y, u.right_rest.z),
      tri_along_axis(s.x, s.y, s.z, u.eye.x, u.eye.y, u.eye.z, u.eye_rest.x, u.eye_rest.y, u.eye_rest.z,
                     u.up.x, u.up.y, u.up.z, u.up_rest.x, u.up_rest.y, u.up_rest.z),
      tri_along_axis(s.x, s.y, s.z, u.eye.x, u.eye.y, u.eye.z, u.eye_rest.x, u.eye_rest.y, u.eye_rest.z,
                     u.forward.x, u.forward.y, u.forward.z, u.forward_rest.x, u.forward_rest.y,
                     u.forward_rest.z),
      s.w);
}

// Returns the point where the ray through the centre of pixel (x, y) intersects the image plane. Row 0 is the top
// row.
vec2 pixel_ray(ivec2 pixel) {
  TRI_PRECISE float sx = (float(pixel.x) + 0.5) * u.plane.z - u.plane.x;
  TRI_PRECISE float sy = u.plane.y - (float(pixel.y) + 0.5) * u.plane.w;
  return vec2(sx, sy);
}
