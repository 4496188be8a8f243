#pragma once
// One move-only owner type for each kind of GL object. Create and destroy the owners while their
// context is current.

#include <utility>

#include "backends/gl/api.hpp"
#include "measure/contract/memory_ledger.hpp"

namespace triptych::gl_backend {

// An object that glGen… creates and glDelete… deletes. Both functions take a count and an array of
// names.
template <auto Generate, auto Delete>
class Object {
 public:
  Object() = default;
  explicit Object(const Api& gl) : gl_(&gl) { (gl.*Generate)(1, &name_); }
  Object(Object&& other) noexcept
      : gl_(other.gl_), name_(other.release()), ledger_entry_(std::move(other.ledger_entry_)) {}
  Object& operator=(Object&& other) noexcept {
    Object moved(std::move(other));
    std::swap(gl_, moved.gl_);
    std::swap(name_, moved.name_);
    std::swap(ledger_entry_, moved.ledger_entry_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (name_ != 0) (gl_->*Delete)(1, &name_);
  }
  [[nodiscard]] GLuint get() const noexcept { return name_; }
  [[nodiscard]] GLuint release() noexcept { return std::exchange(name_, 0U); }

  // Records the memory that was allocated for the object.
  void record_memory(measure::MemoryLedger::Entry memory) { ledger_entry_ = std::move(memory); }

 private:
  const Api* gl_ = nullptr;
  GLuint name_ = 0;
  measure::MemoryLedger::Entry ledger_entry_;
};

using Buffer = Object<&GladGLContext::GenBuffers, &GladGLContext::DeleteBuffers>;
using Texture = Object<&GladGLContext::GenTextures, &GladGLContext::DeleteTextures>;
using Renderbuffer = Object<&GladGLContext::GenRenderbuffers, &GladGLContext::DeleteRenderbuffers>;
using Framebuffer = Object<&GladGLContext::GenFramebuffers, &GladGLContext::DeleteFramebuffers>;
using VertexArray = Object<&GladGLContext::GenVertexArrays, &GladGLContext::DeleteVertexArrays>;
using Query = Object<&GladGLContext::GenQueries, &GladGLContext::DeleteQueries>;

// A shader, program or fence: an object with its own creation call that is deleted individually.
template <class Name, auto Delete>
class OwnedHandle {
 public:
  OwnedHandle() = default;
  OwnedHandle(const Api& gl, Name name) : gl_(&gl), name_(name) {}
  OwnedHandle(OwnedHandle&& other) noexcept : gl_(other.gl_), name_(other.release()) {}
  OwnedHandle& operator=(OwnedHandle&& other) noexcept {
    OwnedHandle moved(std::move(other));
    std::swap(gl_, moved.gl_);
    std::swap(name_, moved.name_);
    return *this;
  }
  OwnedHandle(const OwnedHandle&) = delete;
  OwnedHandle& operator=(const OwnedHandle&) = delete;
  ~OwnedHandle() {
    if (name_ != Name{}) (gl_->*Delete)(name_);
  }
  [[nodiscard]] Name get() const noexcept { return name_; }
  [[nodiscard]] Name release() noexcept { return std::exchange(name_, Name{}); }

 private:
  const Api* gl_ = nullptr;
  Name name_{};
};

using Shader = OwnedHandle<GLuint, &GladGLContext::DeleteShader>;
using Program = OwnedHandle<GLuint, &GladGLContext::DeleteProgram>;
using Fence = OwnedHandle<GLsync, &GladGLContext::DeleteSync>;

}  // namespace triptych::gl_backend
