// Draws one triangle that covers the whole image.
void main() {
  gl_Position = vec4(TRI_CORNER == 1 ? 3.0 : -1.0, TRI_CORNER == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
