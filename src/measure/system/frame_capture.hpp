#pragma once
#include <string>

namespace triptych::measure {

// While it lives, a capture by RenderDoc's in-application interface (renderdoc_app.h), of whichever
// device is used. Does nothing where RenderDoc is not loaded into the process: it never loads it.
class FrameCapture {
 public:
  // `file`: where captures go, without the extension; empty: where RenderDoc puts them.
  explicit FrameCapture(const std::string& file);
  FrameCapture(const FrameCapture&) = delete;
  FrameCapture& operator=(const FrameCapture&) = delete;
  ~FrameCapture();

 private:
  const void* const* functions_ = nullptr;
};

}  // namespace triptych::measure
