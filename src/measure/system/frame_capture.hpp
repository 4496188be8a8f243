#pragma once
#include <string>

namespace triptych::measure {

// Makes RenderDoc capture all frames on all devices while this object exists. Uses RenderDoc's
// in-application interface (renderdoc_app.h). Has no effect unless RenderDoc is already loaded into
// the process.
class FrameCapture {
 public:
  // `file` is the path for captures, without the extension. If it is empty, RenderDoc chooses the
  // path.
  explicit FrameCapture(const std::string& file);
  FrameCapture(const FrameCapture&) = delete;
  FrameCapture& operator=(const FrameCapture&) = delete;
  ~FrameCapture();

 private:
  const void* const* functions_ = nullptr;
};

}  // namespace triptych::measure
