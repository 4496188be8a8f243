// One triangle that covers the whole viewport: (-1, -1), (3, -1), (-1, 3).
void main() {
  gl_Position = vec4(float((gl_VertexID & 1) * 4 - 1), float((gl_VertexID & 2) * 2 - 1), 0.0, 1.0);
}
