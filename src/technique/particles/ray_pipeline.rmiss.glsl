layout(location = 0) rayPayloadInEXT uvec2 best;

void main() { best = uvec2(0u, TRI_NO_PARTICLE); }
