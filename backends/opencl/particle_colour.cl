// Linear between entry centres, constant outside them.
TRI_FN float4 transfer_colour(__global const float4* table, float intensity) {
  float position = tri_table_position(intensity);
  int lower = min((int)position, 254);
  float share = position - (float)lower;
  float4 a = table[lower];
  float4 b = table[lower + 1];
  return a + share * (b - a);
}
