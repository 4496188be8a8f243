// Titles of reports about a failing frame.

#include "report/words/frame_title.hpp"

#include <fmt/format.h>

namespace triptych::report::words {
namespace {

using judge::Cause;
using record::Outcome;

std::string title_of_end(const judge::Observation& failure, const std::string& device) {
  switch (failure.outcome) {
    case Outcome::crashed:
      return "A frame that crashes on " + device;
    case Outcome::hung:
      return "A frame that hangs on " + device;
    case Outcome::lost:
      return fmt::format("A frame that causes a device loss on {}", device);
    default:
      return failure.reason.cause == record::Cause::not_drawn
                 ? fmt::format("A frame that {} does not draw", device)
                 : fmt::format("A frame that {} rejects with an error", device);
  }
}

}  // namespace

std::string frame_title(const judge::Observation& failure, const std::string& device) {
  switch (failure.cause) {
    case Cause::ended:
      return title_of_end(failure, device);
    case Cause::values_changed:
      return fmt::format("A frame for which {} returns wrong counters", device);
    case Cause::not_finite:
      return failure.number("pixels_not_drawn") == failure.number("pixels_not_finite")
                 ? fmt::format("A frame in which {} leaves pixels undrawn", device)
                 : fmt::format("A frame in which {} draws non-finite values", device);
    case Cause::size_differs:
    case Cause::empty_image:
      return fmt::format("A frame that {} draws with the wrong size", device);
    default:
      return fmt::format("A frame that {} draws incorrectly", device);
  }
}

}  // namespace triptych::report::words
