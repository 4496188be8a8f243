#include "reference/volume.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "reference/cell_rule.hpp"
#include "reference/composite.hpp"
#include "reference/drawing.hpp"
#include "reference/field.hpp"
#include "reference/opacity.hpp"
#include "reference/preintegrated.hpp"
#include "reference/ray.hpp"
#include "reference/ray_history.hpp"
#include "reference/shading.hpp"
#include "reference/table.hpp"

namespace triptych::reference {

namespace {

// Draws the pixels of one scene. Each thread has its own object.
template <typename Stored>
class Raycaster {
 public:
  Raycaster(const scene::VolumeScene& scene, const ErrorModel& model, const Field<Stored>& field,
            const Table& table)
      : scene_(scene),
        model_(model),
        field_(field),
        table_(table),
        rays_(scene, model.position_error_voxels),
        compositor_(model, scene.background),
        segments_(table, model),
        cells_(scene, model, field, table),
        smallest_spacing_(scene.smallest_spacing()),
        gradient_scale_(gradient_scale(*scene.grid)) {}

  [[nodiscard]] Pixel operator()(int x, int y) {
    compositor_.start();
    const std::optional<Ray> ray = rays_(x, y);
    if (ray) walk(*ray, scene_.quadrature);
    return compositor_.finish();
  }

  // Returns the samples of the pixel, which are taken by the same loops as for the image.
  [[nodiscard]] RayHistory history(int x, int y) {
    RayHistory history;
    history_ = &history;
    compositor_.start();
    if (const std::optional<Ray> ray = rays_(x, y)) {
      history.entry = ray->entry;
      history.stride = ray->voxels_per_unit * scene_.step_world();
      walk(*ray, scene_.quadrature);
    }
    history_ = nullptr;
    return history;
  }

 private:
  void walk(const Ray& ray, scene::Quadrature quadrature) {
    switch (quadrature) {
      case scene::Quadrature::midpoint:
        return walk_samples(ray);
      case scene::Quadrature::preintegrated:
        return walk_segments(ray);
      case scene::Quadrature::cells:
        return cells_.walk(ray, [&](const TableLookup& lookup, const StepOpacity& opacity) {
          return compositor_.add(lookup, opacity);
        });
    }
  }

  // All lengths below are in voxel lengths, so that they can be used as exponents in the opacity
  // correction.
  void walk_samples(const Ray& ray) {
    const double step = scene_.step_voxels;
    const StepLength chord{ray.length / smallest_spacing_, ray.shortest / smallest_spacing_,
                           ray.longest / smallest_spacing_};
    const glm::dvec3 stride = ray.voxels_per_unit * scene_.step_world();
    const auto count = static_cast<std::int64_t>(std::ceil(chord.longest / step));
    for (std::int64_t i = 0; i < count; ++i) {
      const double index = static_cast<double>(i);
      const glm::dvec3 p = ray.entry + (index + 0.5) * stride;
      const Bounded value = field_.at(p, ray.position_error);
      const Span span = Table::span_of(value);
      if (history_ == nullptr && table_.transparent(span)) continue;
      const StepLength length{std::clamp(chord.nominal - index * step, 0.0, step),
                              std::clamp(chord.shortest - index * step, 0.0, step),
                              std::clamp(chord.longest - index * step, 0.0, step)};
      if (history_ != nullptr) {
        history_->samples.push_back({i, p, ray.position_error, {}, value, {}, length, {}});
      }
      if (!add(ray, p, span, length)) return;
    }
  }

  // The counterpart of walk_samples() for quadrature=preintegrated, which uses the values at the
  // ends of the steps. The last step ends where the ray ends, so its end is as uncertain as the
  // length of the ray.
  void walk_segments(const Ray& ray) {
    const double step = scene_.step_voxels;
    const double length = ray.length / smallest_spacing_;
    const double shortest = ray.shortest / smallest_spacing_;
    const double longest = ray.longest / smallest_spacing_;
    const glm::dvec3 stride = ray.voxels_per_unit * scene_.step_world();
    const auto count = static_cast<std::int64_t>(std::ceil(longest / step));
    Bounded front = field_.at(ray.entry, ray.position_error);
    for (std::int64_t i = 0; i < count; ++i) {
      const double begin = static_cast<double>(i);
      const double end = std::min(begin + 1.0, std::max(length / step, begin));
      const bool last = (begin + 1.0) * step > shortest;
      const Bounded back =
          field_.at(ray.entry + end * stride, ray.position_error_within(last ? ray.slack() : 0.0));
      const StepLength part{std::clamp(length - begin * step, 0.0, step),
                            std::clamp(shortest - begin * step, 0.0, step),
                            std::clamp(longest - begin * step, 0.0, step)};
      const glm::dvec3 middle = ray.entry + 0.5 * (begin + end) * stride;
      if (history_ != nullptr) {
        const glm::dvec3 error = ray.position_error_within(last ? 0.5 * ray.slack() : 0.0);
        history_->samples.push_back({i, middle, error, front, back, {}, part, {}});
      }
      if (!segments_.transparent(front, back)) {
        const Segment segment = segments_(front, back, part);
        if (!add(ray, middle, segment.lookup, segment.opacity)) return;
      }
      front = back;
    }
  }

  bool add(const Ray& ray, const glm::dvec3& p, const Span& span, const StepLength& length) {
    const TableLookup lookup = table_.look_up(span);
    return add(ray, p, lookup, step_opacity(lookup, length, model_.opacity_error));
  }

  bool add(const Ray& ray, const glm::dvec3& p, TableLookup lookup, const StepOpacity& opacity) {
    if (scene_.shading.enabled) {
      const double rounding = model_.compositing_error;
      shade(lookup,
            headlight_cosine(field_, ray, p, gradient_scale_, scene_.shading.gradient_floor,
                             rounding),
            scene_.shading, rounding);
    }
    if (history_ != nullptr) {
      history_->samples.back().lookup = lookup;
      history_->samples.back().opacity = opacity;
      return true;  // a history continues to the end of the ray
    }
    return compositor_.add(lookup, opacity);
  }

  const scene::VolumeScene& scene_;
  const ErrorModel& model_;
  const Field<Stored>& field_;
  const Table& table_;
  RayMaker rays_;
  Compositor compositor_;
  Preintegration segments_;
  CellRule<Stored> cells_;
  double smallest_spacing_;
  glm::dvec3 gradient_scale_;
  RayHistory* history_ = nullptr;  // receives the samples, if they are requested
};

}  // namespace

RayHistory ray_history(const scene::VolumeScene& scene, const ErrorModel& model, int x, int y) {
  check(scene);
  return with_stored_type(scene.grid->format, [&]<typename Stored>(Stored) {
    const Field<Stored> field(*scene.grid, model);
    const Table table(scene.transfer_function, model.table_error);
    return Raycaster<Stored>(scene, model, field, table).history(x, y);
  });
}

Truth render_volume(const scene::VolumeScene& scene, const ErrorModel& model, int threads,
                    const OnRows& on_rows) {
  check(scene);
  return with_stored_type(scene.grid->format, [&]<typename Stored>(Stored) {
    const Field<Stored> field(*scene.grid, model);
    const Table table(scene.transfer_function, model.table_error);
    return draw(
        scene, threads, [&] { return Raycaster<Stored>(scene, model, field, table); }, on_rows);
  });
}

core::Image Truth::image() const {
  core::Image image(width, height);
  std::transform(rgba.begin(), rgba.end(), image.rgba.begin(),
                 [](double value) { return static_cast<float>(value); });
  return image;
}

core::Image Truth::bound_image() const {
  core::Image image(width, height);
  for (std::size_t i = 0; i < bound.size(); ++i) {
    auto rounded = static_cast<float>(bound[i]);
    if (static_cast<double>(rounded) < bound[i]) {
      rounded = std::nextafter(rounded, std::numeric_limits<float>::infinity());
    }
    std::fill_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, rounded);
  }
  return image;
}

}  // namespace triptych::reference
