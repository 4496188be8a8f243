// One ray per fragment. Row 0 of the target is the picture's top row; row y is image row y·stride: 1 for
// the picture, more for planted extra work.
out vec4 colour;

void main() { colour = raycast(ivec2(gl_FragCoord.xy) * ivec2(1, u.viewport.z)); }
