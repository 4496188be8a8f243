// Any hit, not only the closest: of equal distances the driver keeps whichever came first.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {
  if (comes_first(found, best)) best = found;
}
