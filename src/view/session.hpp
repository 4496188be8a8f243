#pragma once
// The content of the window: a column for each device. All columns share one configuration and one
// camera. This code does not depend on a window library.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/request/view_request.hpp"
#include "measure/system/interrupt.hpp"
#include "view/choices.hpp"
#include "view/live_device.hpp"
#include "view/references.hpp"
#include "view/shown_error.hpp"

namespace triptych::view {

struct Column {
  measure::ViewSide side;
  std::unique_ptr<LiveDevice> live;
  LiveDevice::State state = {};
  std::shared_ptr<const DrawnFrame> shown = {};     // the displayed frame
  std::shared_ptr<const Reference> reference = {};  // nullptr until it is rendered
  std::shared_ptr<const ShownError> error = {};     // if nullptr, see `why_no_error`
  std::string why_no_error = {};

  // The inputs from which `error` was computed.
  struct Inputs {
    const void* frame = nullptr;
    const void* reference = nullptr;
    const void* other_frame = nullptr;
    const void* other_reference = nullptr;
    bool operator==(const Inputs&) const = default;
  };
  Inputs inputs = {};
};

// Two objects for the same suite, because two threads use them. `for_choices` checks the levels
// that the user types, and `for_references` renders reference images on a second thread.
struct Suites {
  std::unique_ptr<measure::SuiteWithTruth> for_choices;
  std::unique_ptr<measure::SuiteWithTruth> for_references;
};

class Session {
 public:
  using Clock = std::chrono::steady_clock;

  // `changed` is called on other threads when update() has work to do. `request` and `interrupts`
  // must outlive this object.
  Session(const measure::ViewRequest& request, Suites suites, measure::InterruptGuard& interrupts,
          std::function<void()> changed);
  // Lets the workers exit. Workers that are still drawing are killed.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const measure::ViewRequest& request() const noexcept { return request_; }
  [[nodiscard]] Choices& choices() noexcept { return choices_; }
  [[nodiscard]] const Choices& choices() const noexcept { return choices_; }
  [[nodiscard]] const std::vector<Column>& columns() const noexcept { return columns_; }

  void add_column(const measure::ViewSide& side);
  void remove_column(std::size_t column);
  // Shows `side` in the column. If the column already shows this device, its worker is restarted.
  void set_side(std::size_t column, const measure::ViewSide& side);
  // Returns all devices of this machine, and all sides that were named on the command line.
  [[nodiscard]] std::vector<measure::ViewSide> sides() const;

  // Returns the column with which the other columns are compared, or nullopt if all columns are
  // compared with the reference image.
  [[nodiscard]] std::optional<std::size_t> against() const noexcept { return against_; }
  void compare_with(std::optional<std::size_t> column) { against_ = column; }

  // turn() rotates the camera by a mouse drag, which is given in fractions of the image height.
  // approach() moves the camera closer by the given number of mouse-wheel notches.
  void turn(double right, double down, Clock::time_point now);
  void approach(double notches, Clock::time_point now);

  // Requests frames from the devices if the configuration has changed, and collects finished frames
  // and reference images. Returns whether anything visible has changed.
  bool update(Clock::time_point now);
  // Returns the time at which the camera counts as resting. At that time, update() must be called
  // even if there was no input. Returns nullopt if the camera does not move.
  [[nodiscard]] std::optional<Clock::time_point> next_update() const;
  // Returns whether all columns show the current configuration, and the error of each image has
  // been computed.
  [[nodiscard]] bool is_settled() const;

  // Returns the command that draws a column's frame, or that explains one of its pixels.
  [[nodiscard]] std::string command(const Column& column,
                                    std::optional<std::pair<int, int>> pixel = std::nullopt) const;

 private:
  void set_camera(const std::string& camera, Clock::time_point now);
  void request_frames(bool moving);
  [[nodiscard]] bool collect_frame(Column& column);
  [[nodiscard]] bool refresh_error(std::size_t index);
  [[nodiscard]] std::string why_not_compared(std::size_t index) const;
  [[nodiscard]] Column make_column(const measure::ViewSide& side);
  void retire(Column& column);

  const measure::ViewRequest& request_;
  LiveOptions options_;
  measure::InterruptGuard& interrupts_;
  std::function<void()> changed_;
  std::unique_ptr<measure::SuiteWithTruth> suite_;
  Choices choices_;
  References references_;
  std::vector<Column> columns_;
  std::vector<std::unique_ptr<LiveDevice>> retired_;  // devices of columns that have been removed
  std::optional<std::size_t> against_;
  FrameRequest latest_request_;  // the latest request to all columns
  std::optional<Clock::time_point> camera_rests_at_;
};

}  // namespace triptych::view
