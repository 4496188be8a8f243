#pragma once
#include <string>

namespace triptych::measure {

// While this object exists, RenderDoc captures all frames, on any device. Uses RenderDoc's
// in-application interface (renderdoc_app.h). Does nothing if RenderDoc is not loaded into the
// process, and never loads it.
class FrameCapture {
 public:
  // `file`: the path for captures, without the extension; empty: RenderDoc chooses it.
  explicit FrameCapture(const std::string& file);
  FrameCapture(const FrameCapture&) = delete;
  FrameCapture& operator=(const FrameCapture&) = delete;
  ~FrameCapture();

 private:
  const void* const* functions_ = nullptr;
};

}  // namespace triptych::measure
