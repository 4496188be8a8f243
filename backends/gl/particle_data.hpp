#pragma once
#include <cstdint>
#include <vector>

#include "backends/gl/objects.hpp"
#include "measure/contract/backend.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// What the shared sources of particles read (technique/particles), on the device.
class ParticleData {
 public:
  ParticleData(const Api& gl, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement);

  // Makes the data what bindings 0, 1 and 3…5 of the shared sources stand for, and the vertex
  // attributes 0…2. Attribute 3, by the instance, is its number with the base counted in, for
  // devices whose shaders are not told the base.
  void bind(const Api& gl) const;

  [[nodiscard]] const Buffer& spheres() const noexcept { return spheres_; }
  [[nodiscard]] const Buffer& colours() const noexcept { return colours_; }
  [[nodiscard]] const Buffer& ids() const noexcept { return ids_; }

  // Frames from now on are seen from this scene's camera.
  void look_from(const Api& gl, const measure::ParticleWork& work,
                 const technique::Arrangement& arrangement) const;

 private:
  void describe_vertices(const Api& gl, scene::ColourKind colour);

  Buffer parameters_;
  Buffer transfer_;
  Buffer spheres_;
  Buffer colours_;
  Buffer ids_;
  Buffer numbers_;
  VertexArray vertices_;
};

// The counters of parameters.glsl.
class ParticleCounters {
 public:
  explicit ParticleCounters(const Api& gl);
  // Sets all to zero and makes them binding 2.
  void start(const Api& gl) const;
  // All rows; the device has finished counting.
  [[nodiscard]] std::vector<std::uint32_t> read(const Api& gl) const;

 private:
  Buffer rows_;
};

}  // namespace triptych::gl_backend
