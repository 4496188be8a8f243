#pragma once
// The stages of a particle frame as kernel launches, and the data that they share on the device:
//
//   cull_cells                      finds the cells (ranges of neighbouring particles) in view
//   expand_sprites; control_patches, evaluate_patches; project_points
//                                   compute the vertices of some techniques, in each pass
//   list_cells, count_bins, place_chunks, place_bins, fill_bins, draw_tiles
//                                   draw the listed cells; together they are one pass
//   test_cells, and a second pass   draw the cells that came into sight, for occlusion culling
//   shade                           computes the image from the nearest particle of each pixel

#include <array>
#include <vector>

#include "backends/opencl/launches.hpp"
#include "backends/opencl/particle_data.hpp"
#include "backends/opencl/particle_limits.hpp"
#include "backends/opencl/particle_programs.hpp"

namespace triptych::opencl_backend {

// The counters have one row for each work item, with one column for each of the kernels'
// TRI_COUNT_… constants.
inline constexpr std::size_t particle_counter_stride = 8;

// The data of one pass, which sorts the particles of the listed cells into bins (tiles of pixels)
// and draws the bins.
struct Pass {
  cl_uint stride = 1;  // draws only every stride-th cell
  cl::Buffer list;
  cl::Buffer counts;
  cl::Buffer totals;
  cl::Buffer begins;
  cl::Buffer entries;
  cl::Buffer depths;  // reversed depths; 0 where there is no particle
  cl::Buffer winners;
};

class ParticleStages {
 public:
  ParticleStages(const Session& session, ParticleData data, const measure::ParticleWork& work,
                 const ParticleConstants& constants);

  // Creates a pass with space for all entries (pairs of a bin and a particle) that its bins can
  // ever have. Because the camera does not move, a single round of binning determines that number.
  // Throws core::NotSupported if the entries need more memory than a buffer may have.
  [[nodiscard]] Pass make_pass(const ParticlePrograms& programs, cl_uint stride);
  // Returns the launches of a frame.
  [[nodiscard]] std::vector<Launch> frame_launches(const ParticlePrograms& programs,
                                                   const Pass& pass) const;
  // Returns the launches that draw the cells of a pass a second time.
  [[nodiscard]] std::vector<Launch> extra_launches(const ParticlePrograms& programs,
                                                   const Pass& pass) const;
  // Overwrites everything that the frames of a pass write: the image, and the data that kernels
  // exchange.
  void poison(const Pass& pass) const;
  // Clears the record of hidden cells, so that all cells count as visible.
  void mark_all_visible() const;

  [[nodiscard]] const ParticleData& data() const { return data_; }
  [[nodiscard]] const cl::Buffer& image() const { return image_; }
  [[nodiscard]] const cl::Buffer& ids() const { return ids_; }
  [[nodiscard]] const cl::Buffer& counters() const { return counters_; }
  [[nodiscard]] std::size_t counter_rows() const { return counter_rows_; }

 private:
  [[nodiscard]] cl::Buffer make_buffer(std::size_t words) const;
  [[nodiscard]] cl::NDRange cell_range() const;
  [[nodiscard]] Launch cull(const ParticlePrograms& programs) const;
  [[nodiscard]] Launch test(const ParticlePrograms& programs) const;
  // Adds the launches that compute the vertices of the sprites, if the technique needs separate
  // passes for that.
  void add_expansion(const ParticlePrograms& programs, const Pass& pass,
                     std::vector<Launch>& to) const;
  // If the passes of add_expansion() stored vertices or points, sets them (`stored_`) as the last
  // argument of a kernel that reads them.
  void add_stored(Launch& launch) const;
  [[nodiscard]] Launch shade(const ParticlePrograms& programs, const Pass& pass) const;
  void add_binning(const ParticlePrograms& programs, const Pass& pass, cl_uint state,
                   std::vector<Launch>& to) const;
  void add_drawing(const ParticlePrograms& programs, const Pass& pass, cl_uint state,
                   std::vector<Launch>& to) const;

  Session session_;
  technique::Culling culling_;
  bool colours_sprites_;
  Sprite sprite_;
  std::size_t height_;
  std::size_t pixels_;
  std::array<std::size_t, 2> tiles_;
  BinTable table_;
  ParticleData data_;
  std::size_t counter_rows_;
  cl::Buffer stored_;  // vertices, or points
  cl::Buffer patches_;
  cl::Buffer camera_;          // spheres in camera space
  cl::Buffer rectangles_;      // the rectangles of pixels that sprites cover
  cl::Buffer sprite_colours_;  // used if the transfer function is evaluated for each sprite
  cl::Buffer cosines_;         // used if rays are computed for each sprite
  cl::Buffer visible_before_;  // 1 for each cell that was visible in the previous frame
  cl::Buffer states_;          // the state of each cell in the current frame
  cl::Buffer farthest_;        // the farthest depth of each tile
  cl::Buffer image_;
  cl::Buffer ids_;
  cl::Buffer counters_;
};

}  // namespace triptych::opencl_backend
