#pragma once
// The anchors that compute: launches of one program over words of storage.

#include <optional>
#include <string>
#include <string_view>

#include "backends/gl/prepared.hpp"
#include "backends/gl/program.hpp"
#include "technique/anchors/anchor_work.hpp"

namespace triptych::gl_backend {

// Why this context cannot do a compute anchor at this size.
[[nodiscard]] std::optional<std::string> anchor_unsupported(const Api& gl,
                                                            std::string_view technique,
                                                            const measure::AnchorWork& work);

// The device code is technique/anchors/TECHNIQUE.comp.glsl. A frame that counts begins with cleared
// results, so that what is summed was made by it.
class AnchorDrawing final : public Drawing {
 public:
  AnchorDrawing(const Api& gl, std::string_view technique, const measure::AnchorWork& work);

  [[nodiscard]] std::span<const Statistic> statistics() const override;
  void bind(const Api& gl, measure::Purpose purpose) override;
  void submit(const Api& gl, measure::Purpose purpose) override;
  [[nodiscard]] record::Counts counters(const Api& gl) const override;
  [[nodiscard]] core::Image read(const Api&) const override { return {}; }
  [[nodiscard]] std::string kernel_hash() const override { return hash_; }

 private:
  technique::AnchorFrame shape_;
  Program program_;
  std::string hash_;
  Buffer parameters_;
  Buffer results_;
  Buffer source_;
  Texture volume_;
};

}  // namespace triptych::gl_backend
