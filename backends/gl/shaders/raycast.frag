// One ray per fragment. Row 0 of the target is the picture's top row.
out vec4 colour;

void main() { colour = raycast(ivec2(gl_FragCoord.xy)); }
