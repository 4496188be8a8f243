#pragma once
#include <span>
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
  // Sums by TRI_COUNT_… number; the device has finished counting.
  [[nodiscard]] std::vector<std::uint64_t> sums(const Api& gl) const;

 private:
  Buffer rows_;
};

// The numbers of the counters in parameters.glsl.
enum class Counted : std::uint8_t {
  sprites,
  vertices,
  fragments,
  discarded,
  bin_entries,
  submitted,
  cells_culled
};

// Those of technique::particle_counters that every technique tells, and visible_ids; `sums` as
// from ParticleCounters.
[[nodiscard]] record::Counts common_counts(const technique::ParticleOptions& options,
                                           std::uint64_t cells, std::uint64_t particles,
                                           const std::vector<std::uint64_t>& sums,
                                           std::span<const std::uint32_t> ids);

}  // namespace triptych::gl_backend
