#include "report/words/requested_error.hpp"

#include <fmt/format.h>

namespace triptych::report::words {

std::string text_of(const measure::Rendering& rendering) {
  const bool limit = rendering.image == measure::Rendering::Image::limit;
  const bool square = rendering.viewport.find('x') == std::string::npos;
  return fmt::format("computing the {} image of {}{} pixels", limit ? "limit" : "reference",
                     rendering.viewport, square ? "x" + rendering.viewport : "");
}

std::string text_of(const measure::ErrorProgress& progress) {
  using Phase = measure::ErrorProgress::Phase;
  switch (progress.phase) {
    case Phase::begin:
      return fmt::format(
          "searching for the fastest settings in {} scene{}: for each, compute the limit image "
          "(viewport={}) and small images on the host; then draw trial images with different steps "
          "on the devices; then time the best settings",
          progress.scenes, progress.scenes == 1 ? "" : "s", progress.viewport);
    case Phase::step_search:
      return fmt::format("scene {} of {}: estimating the step for quadrature={} with images of {}",
                         progress.scene_number, progress.scenes, progress.quadrature,
                         progress.viewport);
    case Phase::step_found:
      return fmt::format(
          "{}: with quadrature={}, {} step={:.4g} (estimated error {:.2g}, {})", progress.scene,
          progress.quadrature,
          progress.meets_share ? "the trials begin at" : "the error is too large even at",
          progress.step.step, progress.step.error, name_of(progress.metric));
    case Phase::trials:
      break;
  }
  return fmt::format("trial round {}: each device draws {} image{}", progress.round,
                     progress.settings, progress.settings == 1 ? "" : "s");
}

std::string text_of(const measure::Unreachable& unreachable,
                    const accuracy::RequestedError& request) {
  using Why = measure::Unreachable::Why;
  switch (unreachable.why) {
    case Why::no_limit_image:
      return unreachable.scene +
             ": a stress scene has no limit image, so no error can be computed; choose other data";
    case Why::empty_image:
      return fmt::format(
          "{}: an empty image already meets the error limit {}, because its error is {:.3g} and "
          "only {} of {} pixels differ from the background; request a smaller error, another "
          "metric, or a scene that covers more pixels",
          unreachable.scene, text_of(request), unreachable.error, unreachable.covered,
          unreachable.pixels);
    case Why::step:
      break;
  }
  return fmt::format(
      "{}: the error caused by the step size is too large with every step: the smallest error is "
      "{:.3g} (estimated at viewport={}), but the step may cause only about {:.3g} of the "
      "requested error {}; request a larger error",
      unreachable.scene, unreachable.error, unreachable.viewport, unreachable.allowed,
      text_of(request));
}

std::string text_of_missed(const measure::ErrorAnswer& answer,
                           const accuracy::RequestedError& request) {
  const bool drawn = answer.empty_image.of(request.metric) > 0;
  return fmt::format(
      "{} {}: no candidate meets the error limit {}; {}", answer.device, answer.scene,
      text_of(request),
      drawn ? fmt::format("the smallest error is {:.3g}", answer.errors.of(request.metric))
            : std::string("no image was drawn"));
}

std::string text_of_errors(const measure::ErrorAnswer& answer,
                           const accuracy::RequestedError& request) {
  const double error = answer.errors.of(request.metric);
  std::string text =
      fmt::format("error {:.3g} (limit {}), {:.2g} % of the error of an empty image", error,
                  text_of(request), 100 * error / answer.empty_image.of(request.metric));
  for (const accuracy::Metric metric : accuracy::all_metrics) {
    if (metric == request.metric) continue;
    text += fmt::format(", {} {:.3g}", name_of(metric), answer.errors.of(metric));
  }
  return text;
}

}  // namespace triptych::report::words
