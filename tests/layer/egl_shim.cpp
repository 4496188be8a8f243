// Simulates the fault of an OpenGL driver that TRIPTYCH_SHIM selects. Because of LD_LIBRARY_PATH,
// the loader finds this EGL library before the system's. The library returns its own functions
// instead of the driver's.
#include <EGL/egl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <map>
#include <string_view>

// Repeats a few declarations, because the GL headers would declare conflicting functions.
using GLenum = unsigned int;
using GLuint = unsigned int;
using GLint = int;
using GLsizei = int;
constexpr GLenum gl_current_program = 0x8B8D;
constexpr GLenum gl_compile_status = 0x8B81;

namespace {

bool is_requested(std::string_view fault) {
  const char* set = std::getenv("TRIPTYCH_SHIM");
  return set != nullptr && fault == set;
}

void* system_library() {
  static void* const library = dlopen(TRIPTYCH_SYSTEM_EGL, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) std::abort();
  return library;
}

template <class Function>
Function* system_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(system_library(), name));
}

template <class Function>
Function* gl_function(const char* name) {
  return reinterpret_cast<Function*>(
      system_function<decltype(eglGetProcAddress)>("eglGetProcAddress")(name));
}

std::map<GLuint, int>& uses_of_programs() {
  static std::map<GLuint, int> uses;
  return uses;
}

// Drivers reuse the names of deleted programs, so a newly linked program counts as unused.
void link(GLuint program) {
  uses_of_programs().erase(program);
  gl_function<void(GLuint)>("glLinkProgram")(program);
}

// Returns whether the program was used before. A program works correctly when it is used for the
// first time.
bool repeated() {
  GLint program = 0;
  gl_function<void(GLenum, GLint*)>("glGetIntegerv")(gl_current_program, &program);
  return ++uses_of_programs()[static_cast<GLuint>(program)] > 1;
}

void dispatch_once(GLuint x, GLuint y, GLuint z) {
  if (!repeated()) gl_function<void(GLuint, GLuint, GLuint)>("glDispatchCompute")(x, y, z);
}

void draw_once(GLenum mode, GLint first, GLsizei count) {
  if (!repeated()) gl_function<void(GLenum, GLint, GLsizei)>("glDrawArrays")(mode, first, count);
}

void draw_indirect_once(GLenum mode, const void* indirect, GLsizei count, GLsizei stride) {
  if (repeated()) return;
  gl_function<void(GLenum, const void*, GLsizei, GLsizei)>("glMultiDrawArraysIndirect")(
      mode, indirect, count, stride);
}

void draw_instanced_once(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
  if (repeated()) return;
  gl_function<void(GLenum, GLint, GLsizei, GLsizei)>("glDrawArraysInstanced")(mode, first, count,
                                                                              instances);
}

// Simulates a driver whose compilation fails without being reported: every command succeeds, but
// nothing is drawn.
void dispatch_never(GLuint, GLuint, GLuint) {}
void draw_never(GLenum, GLint, GLsizei) {}

void failed_compilation(GLuint shader, GLenum name, GLint* value) {
  gl_function<void(GLuint, GLenum, GLint*)>("glGetShaderiv")(shader, name, value);
  constexpr GLenum gl_info_log_length = 0x8B84;
  if (name == gl_compile_status) *value = 0;
  if (name == gl_info_log_length) *value = 8;
}

void negative_length_log(GLuint, GLsizei, GLsizei* length, char* log) {
  constexpr std::string_view text = "no luck";
  log[text.copy(log, text.size())] = '\0';
  *length = -1;
}

using Any = void (*)();

Any fault_for(std::string_view name) {
  if (is_requested("once_only")) {
    if (name == "glLinkProgram") return reinterpret_cast<Any>(&link);
    if (name == "glDispatchCompute") return reinterpret_cast<Any>(&dispatch_once);
    if (name == "glDrawArrays") return reinterpret_cast<Any>(&draw_once);
    if (name == "glMultiDrawArraysIndirect") return reinterpret_cast<Any>(&draw_indirect_once);
    if (name == "glDrawArraysInstanced") return reinterpret_cast<Any>(&draw_instanced_once);
  }
  if (is_requested("never_compiled")) {
    if (name == "glDispatchCompute") return reinterpret_cast<Any>(&dispatch_never);
    if (name == "glDrawArrays") return reinterpret_cast<Any>(&draw_never);
  }
  if (is_requested("negative_log")) {
    if (name == "glGetShaderiv") return reinterpret_cast<Any>(&failed_compilation);
    if (name == "glGetShaderInfoLog") return reinterpret_cast<Any>(&negative_length_log);
  }
  return nullptr;
}

}  // namespace

extern "C" {

EGLAPI __eglMustCastToProperFunctionPointerType EGLAPIENTRY eglGetProcAddress(const char* name) {
  if (const Any fault = fault_for(name)) return fault;
  return system_function<decltype(eglGetProcAddress)>("eglGetProcAddress")(name);
}
EGLAPI EGLint EGLAPIENTRY eglGetError() {
  return system_function<decltype(eglGetError)>("eglGetError")();
}
EGLAPI const char* EGLAPIENTRY eglQueryString(EGLDisplay display, EGLint name) {
  return system_function<decltype(eglQueryString)>("eglQueryString")(display, name);
}
EGLAPI EGLBoolean EGLAPIENTRY eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
  return system_function<decltype(eglInitialize)>("eglInitialize")(display, major, minor);
}
EGLAPI EGLBoolean EGLAPIENTRY eglBindAPI(EGLenum api) {
  return system_function<decltype(eglBindAPI)>("eglBindAPI")(api);
}
EGLAPI EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config,
                                               EGLContext shared, const EGLint* attributes) {
  return system_function<decltype(eglCreateContext)>("eglCreateContext")(display, config, shared,
                                                                         attributes);
}
EGLAPI EGLBoolean EGLAPIENTRY eglDestroyContext(EGLDisplay display, EGLContext context) {
  return system_function<decltype(eglDestroyContext)>("eglDestroyContext")(display, context);
}
EGLAPI EGLBoolean EGLAPIENTRY eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read,
                                             EGLContext context) {
  return system_function<decltype(eglMakeCurrent)>("eglMakeCurrent")(display, draw, read, context);
}
}
