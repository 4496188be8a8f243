// Applies headlight shading (scene::Shading) to the colour at p. `d` is the direction of the ray in
// world space.
TRI_FN real4 shade(__constant Parameters* u, TRI_VOLUME volume, real4 colour, real3 p,
                    real3 d) {
  Positions at;
  real value[TRI_LANES];
  int lanes = TRI_WHOLE_VECTORS(6);
  for (int k = 0; k < lanes; ++k) {
    real side = (k & 1) == 0 ? 1.0f : -1.0f;
    at.x[k] = p.x + (k >> 1 == 0 ? side : 0.0f);
    at.y[k] = p.y + (k >> 1 == 1 ? side : 0.0f);
    at.z[k] = p.z + (k >> 1 == 2 ? side : 0.0f);
  }
  fetch(u, volume, &at, lanes, value);
  real3 g = (real3)(value[0] - value[1], value[2] - value[3], value[4] - value[5]);
  g *= 0.5f * u->inverse_spacing.w * u->inverse_spacing.xyz;
  real cosine = fabs(g.x * d.x + g.y * d.y + g.z * d.z) /
                 max(sqrt(g.x * g.x + g.y * g.y + g.z * g.z), u->ray_up.w);
  real highlight = cosine;
  for (int i = 0; i < u->volume_size.w; ++i) highlight *= highlight;
  colour.xyz = colour.xyz * (u->shading.x + u->shading.y * cosine) + u->shading.z * highlight;
  return colour;
}

