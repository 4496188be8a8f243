#pragma once
// Contexts without a window, and where they come from.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "backends/gl/api.hpp"

namespace triptych::gl_backend {

// A GL context and its functions. Only while a Current of it stands may they be called.
class Context {
 public:
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context() = default;
  [[nodiscard]] const Api& gl() const { return *gl_; }
  // Calls Api::only_compile().
  void only_compile() { gl_->only_compile(); }
  // Whether its window system says so.
  [[nodiscard]] virtual bool computes_on_the_processor() const = 0;

 protected:
  Context() = default;
  // To be called by a context's maker, once, when it can be made current: loads the functions and
  // sets the conventions all techniques rely on. `debug`: see Api::collect_messages.
  void load(GLADloadfunc load_function, bool debug);

 private:
  friend class Current;
  virtual void make_current() = 0;  // throws core::ApiError
  virtual void release_current() noexcept = 0;

  std::unique_ptr<Api> gl_;
};

// Keeps a context current on this thread. EGL's Mesa and OSMesa share the variable that holds the
// thread's current context without knowing of each other, so each use binds and unbinds: a context
// that was left current would be taken for bound when the other library has replaced it.
class Current {
 public:
  explicit Current(Context& context) : context_(context) { context_.make_current(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  ~Current() { context_.release_current(); }

 private:
  Context& context_;
};

// One device as a window system offers it, not yet opened.
struct Candidate {
  std::string what;  // for people: "EGL surfaceless"
  // Throws core::NotSupported or core::ApiError.
  std::function<std::unique_ptr<Context>(bool debug)> open;
};

struct WindowSystem {
  std::string_view name;    // "EGL"
  std::string_view suffix;  // of device ids: "-egl"
  // What is here, in a fixed order; throws core::NotSupported when the library is missing. The same
  // device may be offered twice, by platform and by enumeration.
  std::vector<Candidate> (*candidates)();
};

[[nodiscard]] std::vector<Candidate> egl_candidates();
[[nodiscard]] std::vector<Candidate> osmesa_candidates();

}  // namespace triptych::gl_backend
