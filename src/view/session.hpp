#pragma once
// The content of the window: columns for the devices, which share one configuration and one camera.
// This part does not depend on a window library.

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
  std::shared_ptr<const Drawn> shown = {};          // the frame that is displayed
  std::shared_ptr<const Reference> reference = {};  // its reference image, if it is rendered
  std::shared_ptr<const ShownError> error = {};     // `why_no_error` is the reason for nullptr
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

// A session needs two suites of the same kind: one checks the values that the user types, and the
// other renders reference images on another thread.
struct Suites {
  std::unique_ptr<measure::SuiteWithTruth> checks;
  std::unique_ptr<measure::SuiteWithTruth> renders;
};

class Session {
 public:
  using Clock = std::chrono::steady_clock;

  // `changed` is called on other threads when update() has work to do. Both references must outlive
  // this object.
  Session(const measure::ViewRequest& request, Suites suites, measure::InterruptGuard& interrupts,
          std::function<void()> changed);
  // Lets the workers exit. Workers that are drawing are killed.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const measure::ViewRequest& request() const noexcept { return request_; }
  [[nodiscard]] Choices& choices() noexcept { return choices_; }
  [[nodiscard]] const Choices& choices() const noexcept { return choices_; }
  [[nodiscard]] const std::vector<Column>& columns() const noexcept { return columns_; }

  void add_column(const measure::ViewSide& side);
  void remove_column(std::size_t column);
  // Shows another device in the column, or restarts the worker of the same device.
  void set_side(std::size_t column, const measure::ViewSide& side);
  // All devices of this machine, and all sides that the command line named.
  [[nodiscard]] std::vector<measure::ViewSide> sides() const;

  // The column with which the others are compared; nullopt if this is the reference image.
  [[nodiscard]] std::optional<std::size_t> against() const noexcept { return against_; }
  void compare_with(std::optional<std::size_t> column) { against_ = column; }

  // turn() rotates the camera by a drag of the mouse, given in shares of the image's height.
  // approach() moves it closer by notches of the wheel.
  void turn(double right, double down, Clock::time_point now);
  void approach(double notches, Clock::time_point now);

  // Requests frames from the devices if the configuration has changed, and collects the frames and
  // reference images that are finished. Returns whether anything visible has changed.
  bool update(Clock::time_point now);
  // The time at which update() must be called even if nothing else happens, because the camera will
  // then have come to rest.
  [[nodiscard]] std::optional<Clock::time_point> next_update() const;
  // Whether all columns show the configuration of the controls, and each image has its error.
  [[nodiscard]] bool settled() const;

  // The command for a column's frame, or for one pixel of it.
  [[nodiscard]] std::string command(const Column& column,
                                    std::optional<std::pair<int, int>> pixel = std::nullopt) const;

 private:
  void set_camera(const std::string& camera, Clock::time_point now);
  void ask(bool moving);
  [[nodiscard]] bool take_over(Column& column);
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
  std::vector<std::unique_ptr<LiveDevice>> retired_;  // of columns that are no longer visible
  std::optional<std::size_t> against_;
  Wanted asked_;  // the latest request, for all columns
  std::optional<Clock::time_point> rests_at_;
};

}  // namespace triptych::view
