#version 450
// The same colour everywhere, from nothing.
layout(location = 0) out vec4 colour;
void main() {
  colour = vec4(1.0);
}
