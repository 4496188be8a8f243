// Draws a point on the pixel whose number is the vertex number plus the instance number.
layout(location = 0) in uint instance;
uniform uvec2 size;
flat out uint number;

void main() {
  number = uint(gl_VertexID) + instance;
  vec2 pixel = vec2(float(number % size.x), float(number / size.x)) + 0.5;
  gl_Position = vec4(2.0 * pixel / vec2(size) - 1.0, 0.0, 1.0);
  gl_PointSize = 1.0;
}
