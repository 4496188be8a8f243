// Vertex stage of the techniques that read a vertex buffer, with one vertex per particle.
layout(location = 0) in vec4 sphere;
layout(location = 1) in vec4 colour;  // any colour format; the vertex fetch expands it to four components
layout(location = 2) in uint id;

TRI_LINK(0) out vec4 particle_sphere;
TRI_LINK(1) out vec4 particle_colour;
TRI_LINK(2) flat out uint particle_id;

void main() {
  particle_sphere = camera_space(sphere);
  particle_colour = colour_at_vertex(colour);
  particle_id = id;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
