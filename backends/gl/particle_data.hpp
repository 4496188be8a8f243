#pragma once
#include <cstdint>
#include <vector>

#include "backends/gl/objects.hpp"
#include "measure/contract/backend.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::gl_backend {

// The data on the device that the shared particle shaders read (technique/particles).
class ParticleData {
 public:
  ParticleData(const Api& gl, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement);

  // Binds the data to bindings 0, 1 and 3…5 of the shared shaders, and to the vertex attributes
  // 0…2. Attribute 3 advances once per instance and contains the instance number including the base
  // instance, for devices whose shaders cannot read the base instance.
  void bind(const Api& gl) const;

  [[nodiscard]] const Buffer& spheres() const noexcept { return spheres_; }
  [[nodiscard]] const Buffer& colours() const noexcept { return colours_; }
  [[nodiscard]] const Buffer& ids() const noexcept { return ids_; }

  // Uses the camera of this scene for all later frames.
  void upload_camera(const Api& gl, const measure::ParticleWork& work,
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
  // Sets all counters to zero and binds them to binding 2.
  void start(const Api& gl) const;
  // Returns all rows of counters; the value of a counter is the sum of its column. The device must
  // have finished counting.
  [[nodiscard]] std::vector<std::uint32_t> read(const Api& gl) const;

 private:
  Buffer rows_;
};

}  // namespace triptych::gl_backend
