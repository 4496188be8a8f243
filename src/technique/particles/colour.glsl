// Converts the stored colour of a particle to the colour of a pixel. If TRI_COLOUR is 2, the first component of a
// stored colour is the intensity.

// The transfer function is linear between the centres of its entries, and constant beyond the first and the last
// centre.
vec4 transfer_colour(float intensity) {
  float position = tri_table_position(intensity);
  int lower = min(int(position), 254);
  float share = position - float(lower);
  vec4 a = transfer_entries[lower];
  vec4 b = transfer_entries[lower + 1];
  return a + share * (b - a);
}

vec4 colour_at_vertex(vec4 stored) {
  return TRI_COLOUR == 2 && TRI_TRANSFER_AT_PIXEL == 0 ? transfer_colour(stored.x) : stored;
}

vec4 colour_at_pixel(vec4 passed) {
  return TRI_COLOUR == 2 && TRI_TRANSFER_AT_PIXEL == 1 ? transfer_colour(passed.x) : passed;
}
