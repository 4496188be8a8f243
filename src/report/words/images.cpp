// Sentences about images, including the images of stress cases (scenes on which renderers often
// fail).

#include <fmt/format.h>

#include "report/words/causes.hpp"
#include "report/words/finding.hpp"

namespace triptych::report::words {
namespace {

using judge::Observation;

// Names the pixel with the largest error and, if it is another one, the pixel with the largest
// ratio of error to bound.
std::string largest_errors(const Observation& what) {
  const auto pixel = [&](const std::string& name, const std::string& error,
                         const std::string& bound) {
    return fmt::format("{:.3g} at pixel ({:.0f}, {:.0f}), bound {:.3g}", what.number(error),
                       what.number(name + "x"), what.number(name + "y"), what.number(bound));
  };
  const std::string largest = pixel("max_error_", "max_error", "max_error_bound");
  const std::string worst = pixel("", "error", "bound");
  std::string text = "largest error " + largest;
  if (worst != largest) text += "; largest error relative to the bound " + worst;
  return text + fmt::format("; RMSE {:.3g}", what.number("rmse"));
}

std::string particle(const Observation& what, const std::string& name) {
  if (!what.numbers.contains(name)) return "no particle";
  return fmt::format("particle {:.0f}", what.number(name));
}

std::string colour(const Observation& what, const std::string& prefix) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g}, {:.9g})", what.number(prefix + "red"),
                     what.number(prefix + "green"), what.number(prefix + "blue"),
                     what.number(prefix + "alpha"));
}

// Returns "column 5" or "columns 5 to 7".
std::string lines(std::string_view name, double first, double last) {
  return first == last ? fmt::format("{} {:.0f}", name, first)
                       : fmt::format("{}s {:.0f} to {:.0f}", name, first, last);
}

// Returns where the wrong pixels are.
std::string place(const Observation& what) {
  if (!what.numbers.contains("wrong_left")) return {};
  return fmt::format("; all wrong pixels are in {} and {}",
                     lines("column", what.number("wrong_left"), what.number("wrong_right")),
                     lines("row", what.number("wrong_top"), what.number("wrong_bottom")));
}

}  // namespace

std::string within_bound(const Observation& what) {
  return fmt::format("every pixel is within the error bound of {}; {}", text_of(what.against),
                     largest_errors(what));
}

std::string pixels_over_bound(const Observation& what) {
  std::string text =
      fmt::format("{:.0f} of {:.0f} pixels exceed the error bound of {}; ",
                  what.number("pixels_over"), what.number("pixels"), text_of(what.against));
  if (what.number("pixels_of_another_particle") > 0) {
    text +=
        fmt::format("{:.0f} show the wrong particle; ", what.number("pixels_of_another_particle"));
  }
  return text + largest_errors(what) + place(what);
}

std::string not_finite(const Observation& what) {
  if (!what.numbers.contains("pixels")) return "some pixels have non-finite values";
  const double count = what.number("pixels_not_finite");
  const std::string pixels = fmt::format("{:.0f} of {:.0f} pixels", count, what.number("pixels"));
  if (what.numbers.contains("pixels_not_drawn") && what.number("pixels_not_drawn") == count) {
    return fmt::format(
        "{} were probably not drawn, because they are NaN in all channels, as before the frame{}",
        pixels, place(what));
  }
  return fmt::format("{} have non-finite values, in this image or in {}{}", pixels,
                     text_of(what.against), place(what));
}

std::string other_surface(const Observation& what) {
  return fmt::format(
             "{:.0f} of {:.0f} pixels show a different particle than {}, and {:.0f} more show the "
             "correct "
             "particle at a wrong depth; the first is pixel ({:.0f}, {:.0f}): {} at depth {:.6g}, "
             "expected {} at {:.6g} ± {:.3g}",
             what.number("pixels_of_another_particle"), what.number("pixels"),
             text_of(what.against), what.number("pixels_at_another_depth"), what.number("x"),
             what.number("y"), particle(what, "particle"), what.number("depth"),
             particle(what, "expected_particle"), what.number("expected_depth"),
             what.number("depth_bound")) +
         place(what);
}

std::string size_differs(const Observation& what) {
  return fmt::format("the image has {:.0f}x{:.0f} pixels, but {} has {:.0f}x{:.0f}",
                     what.number("width"), what.number("height"), text_of(what.against),
                     what.number("expected_width"), what.number("expected_height"));
}

std::string reference_changed(const Observation& what) {
  std::string text = "the scene or its reference image has changed since the baseline was accepted";
  if (what.because.empty()) return text + ": the hash of the reference image differs";
  return fmt::format("{}: {}", text, text_of(what.because.front()));
}

std::string devices_compared(const Observation& what) {
  const bool agree = what.cause == judge::Cause::devices_agree;
  std::string text = fmt::format(
      "of all devices, {} and {} differ the most: RMS difference {:.3g}, allowed {:.3g}",
      what.fact("device"), what.fact("other"), what.number("rms"), what.number("allowed"));
  if (agree) return text;
  return text + fmt::format(
                    "; both are within their error bounds, but {0} is farther from the reference "
                    "image (RMSE {1:.3g}, compared with {3:.3g} for {2})",
                    what.fact("device"), what.number("rmse"), what.fact("other"),
                    what.number("rmse_of_other"));
}

std::string score(const Observation& what) {
  std::string text = fmt::format("this stress case gets {:.0f} of {:.0f} points for correctness",
                                 what.number("score"), what.number("best"));
  if (what.numbers.contains("accepted")) {
    text += fmt::format(" (accepted: {:.0f})", what.number("accepted"));
  } else {
    text += " (no score is stored)";
  }
  std::string_view separator = ": ";
  for (const Observation& each : what.because) {
    text += fmt::format("{}{}", separator, text_of(each));
    separator = "; ";
  }
  return text;
}

std::string farther_device(const Observation& what) {
  return fmt::format(
      "the RMS difference from the image rendered by {} is {:.3g}, allowed {:.3g}, and this image "
      "is farther from the reference image (RMSE {:.3g}, compared with {:.3g} for the other image)",
      what.fact("other"), what.number("rms"), what.number("allowed"), what.number("rmse"),
      what.number("rmse_of_other"));
}

std::string pixels_differ(const Observation& what) {
  return fmt::format(
      "{:.0f} of {:.0f} pixels {} those of the image with {}; the first is pixel ({:.0f}, {:.0f}): "
      "{} instead of {}",
      what.number("pixels_differing"), what.number("pixels"),
      what.fact("by") == "bits" ? "are not bit-identical to"
                                : "differ by more than the sum of both error bounds from",
      what.fact("levels"), what.number("x"), what.number("y"), colour(what, ""),
      colour(what, "other_"));
}

std::string not_inside(const Observation& what) {
  return fmt::format(
      "this image of {:.0f}x{:.0f} pixels, placed at ({:.0f}, {:.0f}), does not lie inside the "
      "image with {}, which has {:.0f}x{:.0f} pixels",
      what.number("width"), what.number("height"), what.number("x"), what.number("y"),
      what.fact("levels"), what.number("other_width"), what.number("other_height"));
}

std::string other_colour(const Observation& what) {
  return fmt::format("channel {:.0f} of pixel ({:.0f}, {:.0f}) is {:.9g} instead of {:.9g}",
                     what.number("channel"), what.number("x"), what.number("y"),
                     what.number("value"), what.number("expected_value"));
}

std::string count_too_large(const Observation& what) {
  std::string allowed = fmt::format("{:g}", what.number("factor"));
  if (!what.fact("of").empty()) {
    allowed += fmt::format(" × {:.0f} {}", what.number("unit"), what.fact("of"));
    if (!what.fact("levels").empty()) allowed += " with " + what.fact("levels");
  }
  return fmt::format("the counter '{}' is {:.0f}, but the limit is {}", what.fact("counter"),
                     what.number("count"), allowed);
}

}  // namespace triptych::report::words
