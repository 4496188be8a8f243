#pragma once
// A device that draws the frames that the window requests, in its own worker process. If a driver
// crashes or hangs, the window survives, and the worker is replaced for the next frame.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/image.hpp"
#include "core/rgb_image.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/request/view_request.hpp"
#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_setup.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::view {

// A frame that the window requests.
struct FrameRequest {
  std::uint64_t number = 0;  // later frames have larger numbers
  measure::Configuration configuration;
  std::string key;  // measure::configuration_key
  // While the mouse moves, only the image and a single time are measured.
  bool moving = false;
};

// The result of a request.
struct DrawnFrame {
  FrameRequest request;
  record::Record record;
  core::Image image;         // empty unless the frame was measured
  core::RgbImage displayed;  // the image as displayed

  [[nodiscard]] bool has_image() const { return image.width > 0; }
};

struct LiveOptions {
  std::string program;  // path of `triptych`, see ViewRequest
  std::string suite;
  std::vector<measure::InjectedFault> faults;
  std::chrono::seconds limit{};
};

class LiveDevice {
 public:
  struct State {
    std::shared_ptr<const DrawnFrame> drawn;  // the latest frame; nullptr if there is none yet
    bool drawing = false;
    std::optional<measure::Loading> loading;  // set while a large data set is loading
  };

  // `changed` is called on another thread whenever the state has changed. `interrupts` must outlive
  // this object. Throws IoError if the folder for the driver's cache cannot be created.
  LiveDevice(const measure::ViewSide& side, LiveOptions options,
             measure::InterruptGuard& interrupts, std::function<void()> changed);
  // Calls retire(), and waits until the thread has finished.
  ~LiveDevice();
  LiveDevice(const LiveDevice&) = delete;
  LiveDevice& operator=(const LiveDevice&) = delete;

  // Requests a frame. Cancels the previous request if its frame is not being drawn yet.
  void draw(FrameRequest request);
  [[nodiscard]] State state() const;

  // Lets the worker exit normally, without waiting for it. If the worker is drawing, it first
  // finishes its frame. If a signal has asked the program to stop, the worker is killed instead.
  void retire();
  [[nodiscard]] bool has_exited() const { return has_exited_; }

 private:
  void serve();
  [[nodiscard]] std::optional<FrameRequest> next();
  [[nodiscard]] DrawnFrame draw_frame(const FrameRequest& request);
  [[nodiscard]] record::Record measure_frame(const FrameRequest& request,
                                             std::vector<std::byte>& exr);
  // Ensures that there is a worker whose clock is calibrated for this kind of work. Returns false
  // if no worker could be started.
  [[nodiscard]] bool open_worker(const std::string& kind);
  [[nodiscard]] measure::Job job(const FrameRequest& request) const;
  void update_state(const std::function<void(State&)>& change);

  LiveOptions options_;
  std::string device_;
  std::function<void()> changed_;
  measure::CacheFolder cache_;
  measure::WorkerSlot slot_;
  std::vector<record::ClockTrust> clocks_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<FrameRequest> request_;
  bool stop_ = false;
  std::atomic<bool> has_exited_ = false;  // whether the worker has exited
  State state_;
  std::thread thread_;  // the last member, because its code uses all other members
};

}  // namespace triptych::view
