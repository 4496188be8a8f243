#pragma once
// A device that draws whatever the window asks for, in a worker process of its own. The window
// stays alive when a driver crashes or hangs: the worker is replaced for the next frame.

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
#include "core/rgb_picture.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "measure/request/view_request.hpp"
#include "measure/system/interrupt.hpp"
#include "measure/worker/worker_setup.hpp"
#include "measure/worker/worker_slot.hpp"

namespace triptych::view {

// A frame that the window wants.
struct Wanted {
  std::uint64_t number = 0;  // a later frame has a larger number
  measure::Configuration configuration;
  std::string key;  // measure::configuration_key
  // While the mouse moves, only the image and one time are measured.
  bool moving = false;
};

// The answer to it.
struct Drawn {
  Wanted wanted;
  record::Record record;
  core::Image image;         // empty unless the frame was measured
  core::RgbPicture picture;  // the image as it is shown

  [[nodiscard]] bool has_image() const { return image.width > 0; }
};

struct LiveOptions {
  std::string program;  // see ViewRequest
  std::string suite;
  std::vector<measure::InjectedFault> faults;
  std::chrono::seconds limit{};
};

class LiveDevice {
 public:
  struct State {
    std::shared_ptr<const Drawn> drawn;  // the last frame; nullptr before the first
    bool drawing = false;
    std::optional<measure::Loading> loading;  // of a large data set
  };

  // `changed` is called on another thread whenever the state has changed. The guard must outlive
  // this object. Throws IoError if there is no folder for the driver's cache.
  LiveDevice(const measure::ViewSide& side, LiveOptions options,
             measure::InterruptGuard& interrupts, std::function<void()> changed);
  // Waits until retire() is done.
  ~LiveDevice();
  LiveDevice(const LiveDevice&) = delete;
  LiveDevice& operator=(const LiveDevice&) = delete;

  // Asks for a frame. It replaces one that was asked for and is not yet being drawn.
  void draw(Wanted wanted);
  [[nodiscard]] State state() const;

  // Lets the worker exit normally. One that is drawing is killed if the guard has been interrupted,
  // and otherwise finishes its frame. Does not wait for it.
  void retire();
  [[nodiscard]] bool is_gone() const { return gone_; }

 private:
  void serve();
  [[nodiscard]] std::optional<Wanted> next();
  [[nodiscard]] Drawn drawn(const Wanted& wanted);
  [[nodiscard]] record::Record measured(const Wanted& wanted, std::vector<std::byte>& exr);
  // Whether there is a worker whose clock for this kind of work is calibrated.
  [[nodiscard]] bool open_for(const std::string& kind);
  [[nodiscard]] measure::Job job(const Wanted& wanted) const;
  void publish(const std::function<void(State&)>& change);

  LiveOptions options_;
  std::string device_;
  std::function<void()> changed_;
  measure::CacheFolder cache_;
  measure::WorkerSlot slot_;
  std::vector<record::ClockTrust> clocks_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Wanted> wanted_;
  bool stop_ = false;
  std::atomic<bool> gone_ = false;  // the worker has exited
  State state_;
  std::thread thread_;  // the last member, because it uses all others
};

}  // namespace triptych::view
