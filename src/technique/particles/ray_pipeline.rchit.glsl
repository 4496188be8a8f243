// The closest hit is one of those that the any-hit stage has seen: nothing is left to do.
hitAttributeEXT uvec2 found;
layout(location = 0) rayPayloadInEXT uvec2 best;

void main() {}
