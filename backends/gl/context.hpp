#pragma once
// Finds and creates GL contexts without a window.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "backends/gl/api.hpp"

namespace triptych::gl_backend {

// A GL context and its functions. The functions may be called only while a Current object for the
// context exists.
class Context {
 public:
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context() = default;
  [[nodiscard]] const Api& gl() const { return *gl_; }
  // Calls Api::set_compile_only().
  void set_compile_only() { gl_->set_compile_only(); }
  // Returns whether the window system reports that the context renders on the CPU.
  [[nodiscard]] virtual bool computes_on_cpu() const = 0;

 protected:
  Context() = default;
  // Called once by the constructor of a derived class, as soon as the context can be made current.
  // Loads the functions and sets the conventions on which all techniques rely. For `debug`, see
  // Api::collect_messages.
  void load(GLADloadfunc load_function, bool debug);

 private:
  friend class Current;
  virtual void make_current() = 0;  // throws core::ApiError
  virtual void release_current() noexcept = 0;

  std::unique_ptr<Api> gl_;
};

// Makes a context current on this thread for the lifetime of this object. OSMesa and the Mesa
// library behind EGL store the thread's current context in the same variable, but neither library
// notices when the other changes it. If a context stayed current, its library would still regard it
// as bound after the other library had bound a different context. Therefore every use binds the
// context, and unbinds it afterwards.
class Current {
 public:
  explicit Current(Context& context) : context_(context) { context_.make_current(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  ~Current() { context_.release_current(); }

 private:
  Context& context_;
};

// A device that a window system offers but that has not been opened yet.
struct Candidate {
  std::string description;  // shown to users, such as "EGL surfaceless"
  // Throws core::NotSupported or core::ApiError.
  std::function<std::unique_ptr<Context>(bool debug)> open;
};

struct WindowSystem {
  std::string_view name;    // "EGL"
  std::string_view suffix;  // the suffix of device ids, such as "-egl"
  // Lists the available devices in a fixed order. Throws core::NotSupported if the library is
  // missing. The same device may be listed twice: by platform and by enumeration.
  std::vector<Candidate> (*candidates)();
};

[[nodiscard]] std::vector<Candidate> egl_candidates();
[[nodiscard]] std::vector<Candidate> osmesa_candidates();

}  // namespace triptych::gl_backend
