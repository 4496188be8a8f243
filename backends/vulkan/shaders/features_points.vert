#version 450
// Draws a point on the pixel whose number is the vertex number plus the instance number.
layout(push_constant) uniform Push { uint width; uint height; };
layout(location = 0) flat out uint number;

void main() {
  number = uint(gl_VertexIndex) + uint(gl_InstanceIndex);
  vec2 pixel = vec2(float(number % width), float(number / width)) + 0.5;
  gl_Position = vec4(2.0 * pixel / vec2(float(width), float(height)) - 1.0, 0.0, 1.0);
  gl_PointSize = 1.0;
}
