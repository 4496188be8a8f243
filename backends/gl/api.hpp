#pragma once
// The functions of one GL context, and the code that turns their errors into exceptions.

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/code_place.hpp"
#include "measure/contract/memory_ledger.hpp"

namespace triptych::gl_backend {

// GL's functions as members (`gl.DrawArrays(…)`). A function is null if neither the version nor the
// extensions of the context provide it. The object is valid while the context exists. Its functions
// may be called only while the context is current.
struct Api : GladGLContext {
  // Throws core::NotSupported if a function of GL 3.3 is missing.
  explicit Api(GLADloadfunc load);

  // Makes check() also report the error messages that the driver sends from now on. Needs KHR_debug
  // (GL 4.3).
  void collect_messages();

  // Enables labels if the driver supports them (KHR_debug).
  void label_all() { labelled = PushDebugGroup != nullptr && ObjectLabel != nullptr; }

  // Prepares the context for a device that only compiles, because its GPU is not present. After
  // this call, functions that would execute work on the device throw core::NotSupported, and no
  // data are uploaded. Objects are still created, so that programs can be linked.
  void set_compile_only();
  [[nodiscard]] bool executes() const { return executes_; }

  // While a program is linked, drivers send messages about the code that they generate for it. A
  // Report is one of these messages, together with the stages of the program.
  struct LinkedStage {
    GLenum type = 0;
    std::string name;
  };
  struct Report {
    std::vector<LinkedStage> program;
    std::string text;
  };
  // Starts storing the messages that the driver sends while programs are linked. Has no effect
  // unless collect_messages() was called. take_reports() returns the stored messages, oldest first,
  // and stops storing.
  void keep_reports() const;
  [[nodiscard]] bool can_keep_reports() const { return messages_ != nullptr; }
  [[nodiscard]] std::vector<Report> take_reports() const;
  // Assigns all following messages to a program with these stages.
  void begin_link(std::vector<LinkedStage> stages) const;

  // Throws core::DeviceLost or core::ApiError if any call since the previous check failed. `call`
  // names the last or the most important of these calls.
  void check(std::string_view call, core::CodePlace place = core::CodePlace::current()) const;

  // Whether objects and commands get names that debuggers and profilers display. True if the names
  // were requested and the context has KHR_debug.
  bool labelled = false;

  // The memory of the textures, renderbuffers and buffers of this context.
  measure::MemoryLedger memory_ledger;

  // Returns the result of glGetString, or an empty string if the result is null.
  [[nodiscard]] std::string text(GLenum name) const;
  [[nodiscard]] std::int64_t limit(GLenum name) const;
  [[nodiscard]] std::int64_t limit(GLenum name, GLuint index) const;
  // Returns the number b of subpixel bits. The rasterizer rounds vertices to a grid with a spacing
  // of 2⁻ᵇ pixels.
  [[nodiscard]] int sub_pixel_bits() const { return static_cast<int>(limit(GL_SUBPIXEL_BITS)); }
  [[nodiscard]] bool at_least(int major, int minor) const;

 private:
  struct Messages {
    std::vector<std::string> lines;
    std::vector<LinkedStage> program;
    std::vector<Report> reports;
    bool keeps_reports = false;
  };
  static void GLAD_API_PTR on_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                      GLsizei length, const GLchar* message, const void* user);
  std::unique_ptr<Messages> messages_;  // on the heap, because the driver stores its address
  bool executes_ = true;
};

// While an object of this class exists, all GL calls belong to a named group that debuggers and
// profilers display. Does nothing if names were not requested.
class Label {
 public:
  Label(const Api& gl, std::string_view name) : gl_(gl.labelled ? &gl : nullptr) {
    if (gl_ == nullptr) return;
    gl_->PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()),
                        name.data());
  }
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;
  ~Label() {
    if (gl_ != nullptr) gl_->PopDebugGroup();
  }

 private:
  const Api* gl_;
};

}  // namespace triptych::gl_backend
