// The any-hit shader has already processed the closest hit, so nothing is left to do.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {}
