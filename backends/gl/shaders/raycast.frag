// Traces one ray per fragment. Row 0 of the target is the top row of the image.
out vec4 colour;

void main() { colour = raycast(ivec2(gl_FragCoord.xy)); }
