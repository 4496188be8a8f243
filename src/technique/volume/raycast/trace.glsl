// Records the history of one pixel. Only a special build contains this code (technique/volume/ray_trace.hpp).

uint trace_place = 0xFFFFFFFFu;
real traced_value = 0.0;
real traced_front = 0.0;
real traced_opacity = 0.0;

// The pixel is clamped to the image, because devices also run helper invocations outside the triangle.
void begin_trace(ivec2 pixel) {
  ivec2 inside = min(pixel, u.viewport.xy - 1);
  trace_place = counters[8 * (inside.y * u.viewport.x + inside.x) + 7];
}

// Records a sample. `kind` is technique::TracedKind. traced_value, traced_front and traced_opacity must have been
// set before.
void trace(uint kind, real3 place, real4 colour, real steps, Light light) {
  real opacity = traced_opacity;
  traced_opacity = 0.0;
  if (trace_place == 0xFFFFFFFFu) return;
  uint n = counters[trace_place + 1u];
  counters[trace_place + 1u] = n + 1u;
  if (n >= counters[trace_place]) return;
  uint at = trace_place + 2u + 16u * n;
  vec3 where = vec3(place);
  vec3 gathered = vec3(light.colour);
  vec4 looked = vec4(colour);
  counters[at] = kind;
  counters[at + 1u] = floatBitsToUint(where.x);
  counters[at + 2u] = floatBitsToUint(where.y);
  counters[at + 3u] = floatBitsToUint(where.z);
  counters[at + 4u] = floatBitsToUint(float(traced_value));
  counters[at + 5u] = floatBitsToUint(float(traced_front));
  counters[at + 6u] = floatBitsToUint(looked.r);
  counters[at + 7u] = floatBitsToUint(looked.g);
  counters[at + 8u] = floatBitsToUint(looked.b);
  counters[at + 9u] = floatBitsToUint(looked.a);
  counters[at + 10u] = floatBitsToUint(float(steps));
  counters[at + 11u] = floatBitsToUint(float(opacity));
  counters[at + 12u] = floatBitsToUint(float(light.transmittance));
  counters[at + 13u] = floatBitsToUint(gathered.r);
  counters[at + 14u] = floatBitsToUint(gathered.g);
  counters[at + 15u] = floatBitsToUint(gathered.b);
}
