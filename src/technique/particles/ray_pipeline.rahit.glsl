// This any-hit shader is necessary because the driver reports only one closest hit, even if several hits have equal
// distances.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {
  if (comes_first(found, best)) best = found;
}
