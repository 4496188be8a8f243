// Any hit and not only the closest one, because of several hits with equal distances the driver keeps whichever
// came first.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {
  if (comes_first(found, best)) best = found;
}
