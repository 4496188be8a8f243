#pragma once
// Frames of the particle techniques: cells are culled, particles binned into tiles, tiles drawn,
// pixels shaded.

#include <array>
#include <string>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/particle_data.hpp"
#include "backends/opencl/particle_programs.hpp"
#include "backends/opencl/programs.hpp"
#include "measure/backend.hpp"

namespace triptych::opencl_backend {

class ParticleFrames final : public measure::Prepared {
 public:
  // Compiles the timed and the counting build, uploads everything and finds how many entries the
  // bins will hold. Throws core::NotSupported where they take more memory than a buffer may.
  ParticleFrames(const Session& session, Programs& programs, const measure::ParticleWork& work,
                 Sprite sprite);

  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return hash_; }

 private:
  // One pass over the listed cells: what it sorts into bins, and what it draws.
  struct Pass {
    cl_uint stride = 1;  // of the cells in view every stride-th
    cl::Buffer list;
    cl::Buffer counts;
    cl::Buffer totals;
    cl::Buffer begins;
    cl::Buffer entries;
    cl::Buffer depths;
    cl::Buffer winners;
  };

  [[nodiscard]] cl::Buffer make_buffer(std::size_t words) const;
  [[nodiscard]] Pass make_pass(const cl::Program& program, cl_uint stride);
  [[nodiscard]] Launch cull(const cl::Program& program) const;
  void add_binning(const cl::Program& program, const Pass& pass, std::vector<Launch>& to) const;
  void add_drawing(const cl::Program& program, const Pass& pass, std::vector<Launch>& to) const;
  [[nodiscard]] Launch shade(const cl::Program& program, const Pass& pass) const;
  [[nodiscard]] record::Counts read_counters();

  Session session_;
  int width_;
  int height_;
  double near_;
  std::string hash_;
  std::array<std::size_t, 2> tiles_;
  std::size_t bins_;
  std::size_t chunks_;
  ParticleData data_;
  cl::Buffer camera_;          // spheres in camera space
  cl::Buffer rectangles_;      // of pixels
  cl::Buffer sprite_colours_;  // where the transfer function is looked up for sprites
  cl::Buffer cosines_;         // where rays are those of sprites
  cl::Buffer visible_;         // per cell
  cl::Buffer image_;
  cl::Buffer ids_;
  cl::Buffer counters_;
  std::size_t counter_rows_;
  Pass picture_;
  Pass extra_;  // the planted slowdown
  std::vector<Launch> timed_;
  std::vector<Launch> counting_;
  std::vector<cl::Event> events_;
};

}  // namespace triptych::opencl_backend
