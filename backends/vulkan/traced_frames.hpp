#pragma once
// The techniques that find the sphere of each pixel with a ray. They differ in the structure that
// the rays traverse.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/instance.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/particle_target.hpp"

namespace triptych::vulkan_backend {

// The bindings of technique/particles/traced.glsl and traced_texels.glsl.
enum TracedBinding : std::uint32_t {
  traced_pixels_binding = 11,
  traced_pixel_texels_binding = 16,
  traced_sphere_texels_binding,
  traced_colour_texels_binding,
  traced_id_texels_binding
};

// The structure on the device that rays traverse, and the passes that trace the rays.
class Tracer {
 public:
  Tracer() = default;
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;
  virtual ~Tracer() = default;

  // bindings() returns the bindings of the structure itself, and push_bytes() returns the size of
  // the push constants for its compute passes.
  [[nodiscard]] virtual std::vector<vk::DescriptorSetLayoutBinding> bindings() const = 0;
  [[nodiscard]] virtual std::uint32_t push_bytes() const = 0;
  // Returns the shader stages of the passes.
  [[nodiscard]] virtual vk::ShaderStageFlags stages() const {
    return vk::ShaderStageFlagBits::eCompute;
  }
  [[nodiscard]] virtual vk::QueryPipelineStatisticFlags statistics() const {
    return vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations;
  }
  // Returns true if Triptych's own kernels traverse the structure, so that every driver visits the
  // same nodes.
  [[nodiscard]] virtual bool counts_nodes() const = 0;
  virtual void bind(vk::DescriptorSet set) const = 0;
  // Called once after bind(). Creates the structure, and the pipelines that are used for timing.
  virtual void prepare(const Layout& layout, vk::DescriptorSet set) = 0;
  // Creates the pipelines whose shaders also count their work.
  virtual void prepare_counting(const Layout& layout) = 0;
  // Records a frame up to the point where each pixel has the keys of its nearest sphere, which
  // encode the depth and the particle (keys.glsl). The descriptor set must be bound.
  virtual void record(const vk::raii::CommandBuffer& commands, const Layout& layout,
                      bool counting) const = 0;
  // Returns the device code that is used for timing.
  [[nodiscard]] virtual std::vector<std::string_view> codes() const = 0;
};

class TracedFrames final : public measure::Prepared {
 public:
  using MakeTracer = std::unique_ptr<Tracer> (*)(const Gpu& gpu, const measure::ParticleWork& work,
                                                 const technique::Arrangement& arrangement,
                                                 const ParticleData& data);
  TracedFrames(const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement, MakeTracer make_tracer);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override;

 private:
  struct Texels {
    std::uint32_t binding;
    vk::raii::BufferView view;
  };
  [[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> bindings() const;
  void prepare();
  void record(const vk::raii::CommandBuffer& commands, bool counting) const;

  const Gpu& gpu_;
  const Instance& instance_;
  technique::ParticleOptions options_;
  Specialization constants_;
  ParticleData data_;
  ParticleTarget target_;
  Buffer pixels_;
  std::vector<Texels> texels_;
  std::unique_ptr<Tracer> tracer_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;  // freed with the pool
  vk::Pipeline show_;
  Frames frames_;
};

// Arranges the scene and prepares it.
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_traced(
    const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work,
    TracedFrames::MakeTracer make_tracer);

// Allocates 32-bit words that compute passes write and read, also as texels. The buffer is not
// empty even if `count` is 0.
[[nodiscard]] Buffer device_words(const Gpu& gpu, std::uint64_t count);

}  // namespace triptych::vulkan_backend
