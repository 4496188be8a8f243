// An any-hit shader is necessary, because if several hits have equal distances, the driver reports only one of them
// as the closest hit.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {
  if (comes_first(found, best)) best = found;
}
