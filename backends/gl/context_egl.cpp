// EGL without a window: Mesa's surfaceless platform, and EGL devices (from NVIDIA's driver and
// others).

#include <fmt/format.h>
#include <glad/egl.h>

#include <array>
#include <vector>

#include "backends/gl/context.hpp"
#include "backends/gl/library.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

struct Egl {
  Library library{"libEGL.so.1", "libEGL.so"};
  PFNEGLGETPROCADDRESSPROC get_proc_address =
      library.get<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
  PFNEGLGETERRORPROC get_error = library.get<PFNEGLGETERRORPROC>("eglGetError");
  PFNEGLQUERYSTRINGPROC query_string = library.get<PFNEGLQUERYSTRINGPROC>("eglQueryString");
  PFNEGLINITIALIZEPROC initialize = library.get<PFNEGLINITIALIZEPROC>("eglInitialize");
  PFNEGLBINDAPIPROC bind_api = library.get<PFNEGLBINDAPIPROC>("eglBindAPI");
  PFNEGLCREATECONTEXTPROC create_context = library.get<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
  PFNEGLDESTROYCONTEXTPROC destroy_context =
      library.get<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
  PFNEGLMAKECURRENTPROC make_current = library.get<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
  // Functions from client extensions of the library; null if the library lacks the extension.
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
          get_proc_address("eglGetPlatformDisplayEXT"));
  PFNEGLQUERYDEVICESEXTPROC query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(get_proc_address("eglQueryDevicesEXT"));
  PFNEGLQUERYDISPLAYATTRIBEXTPROC query_display = reinterpret_cast<PFNEGLQUERYDISPLAYATTRIBEXTPROC>(
      get_proc_address("eglQueryDisplayAttribEXT"));
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(get_proc_address("eglQueryDeviceStringEXT"));

  [[nodiscard]] bool has(EGLDisplay display, std::string_view extension) const {
    return is_among(query_string(display, EGL_EXTENSIONS), extension);
  }
  // Returns whether the display belongs to a device that Mesa marks as software.
  [[nodiscard]] bool is_software(EGLDisplay display) const {
    EGLAttrib device = 0;
    if (query_display == nullptr || query_device_string == nullptr) return false;
    if (query_display(display, EGL_DEVICE_EXT, &device) == EGL_FALSE) return false;
    const char* names = query_device_string(reinterpret_cast<EGLDeviceEXT>(device), EGL_EXTENSIONS);
    return is_among(names, "EGL_MESA_device_software");
  }
  [[nodiscard]] core::ApiError error(std::string call,
                                     core::CodePlace place = core::CodePlace::current()) {
    return {std::move(call), code_name(get_error()), {}, place};
  }

 private:
  // Compares whole words, because the name of one extension may be a prefix of another extension's
  // name.
  static bool is_among(const char* names, std::string_view extension) {
    return names != nullptr &&
           fmt::format(" {} ", names).find(fmt::format(" {} ", extension)) != std::string::npos;
  }

  static std::string code_name(EGLint code) {
    static constexpr std::array names{
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    const auto index = static_cast<std::size_t>(code - EGL_SUCCESS);
    return index < names.size() ? names[index] : fmt::format("{:#06x}", code);
  }
};

class EglContext final : public Context {
 public:
  EglContext(EGLenum platform, EGLDeviceEXT device, bool debug) {
    open_display(platform, device);
    if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE) throw egl_.error("eglBindAPI");
    // Requests reset notification, so that a lost context is reported. Not every driver supports
    // it.
    handle_ = create_newest(debug, true);
    if (handle_ == EGL_NO_CONTEXT) handle_ = create_newest(debug, false);
    if (handle_ == EGL_NO_CONTEXT) refuse_context();
    try {
      const Current current(*this);
      load(egl_.get_proc_address, debug);
    } catch (...) {
      egl_.destroy_context(display_, handle_);
      throw;
    }
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  [[nodiscard]] bool computes_on_cpu() const override { return egl_.is_software(display_); }
  // Does not terminate the display, because all contexts of this process on the same display share
  // it.
  ~EglContext() override { egl_.destroy_context(display_, handle_); }

 private:
  [[noreturn]] void refuse_context() {
    const core::ApiError error = egl_.error("eglCreateContext");
    // EGL returns this error if the driver does not support the version or profile.
    if (error.code() == "EGL_BAD_MATCH")
      throw core::NotSupported("the driver cannot create an OpenGL 3.3 core context");
    throw error;
  }

  void open_display(EGLenum platform, EGLDeviceEXT device) {
    display_ = egl_.get_platform_display(platform, device, nullptr);
    if (display_ == EGL_NO_DISPLAY) throw egl_.error("eglGetPlatformDisplayEXT");
    if (egl_.initialize(display_, nullptr, nullptr) == EGL_FALSE) {
      throw egl_.error("eglInitialize");
    }
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"}) {
      if (!egl_.has(display_, needed)) {
        throw core::NotSupported(fmt::format("the EGL display lacks {}", needed));
      }
    }
  }

  // Requests the newest version first. When asked for version 3.3, Mesa creates the newest version
  // that it supports, but NVIDIA's driver creates 3.3.
  EGLContext create_newest(bool debug, bool robust) {
    static constexpr std::array<std::array<EGLint, 2>, 8> versions{
        {{4, 6}, {4, 5}, {4, 4}, {4, 3}, {4, 2}, {4, 1}, {4, 0}, {3, 3}}};
    for (const auto& [major, minor] : versions) {
      const EGLContext context = create(major, minor, debug, robust);
      if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
  }

  EGLContext create(EGLint major, EGLint minor, bool debug, bool robust) {
    std::vector<EGLint> attributes{
        EGL_CONTEXT_MAJOR_VERSION,       major,
        EGL_CONTEXT_MINOR_VERSION,       minor,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    // EGL 1.4 displays (such as softpipe's) reject the debug attribute of EGL 1.5. Therefore this
    // uses the flag of EGL_KHR_create_context, which all displays accept.
    if (debug && egl_.has(display_, "EGL_KHR_create_context")) {
      attributes.insert(attributes.end(),
                        {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
    }
    if (robust) {
      attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                           EGL_LOSE_CONTEXT_ON_RESET});
    }
    attributes.push_back(EGL_NONE);
    return egl_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  }

  void make_current() override {
    // The bound API is a property of the thread, and another library may have changed it.
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, handle_) == EGL_FALSE) {
      throw egl_.error("eglMakeCurrent");
    }
  }
  void release_current() noexcept override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext handle_ = EGL_NO_CONTEXT;
};

Candidate candidate(std::string description, EGLenum platform, EGLDeviceEXT device) {
  return {std::move(description), [platform, device](bool debug) {
            return std::make_unique<EglContext>(platform, device, debug);
          }};
}

}  // namespace

std::vector<Candidate> egl_candidates() {
  const Egl egl;
  std::vector<Candidate> result;
  if (egl.get_platform_display == nullptr) {
    throw core::NotSupported("libEGL lacks the extension EGL_EXT_platform_base");
  }
  if (egl.has(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    result.push_back(candidate("EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, nullptr));
  }
  if (egl.query_devices != nullptr && egl.has(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 64> devices{};
    EGLint count = 0;
    if (egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) ==
        EGL_FALSE) {
      count = 0;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      result.push_back(
          candidate(fmt::format("EGL device {}", i), EGL_PLATFORM_DEVICE_EXT, devices[i]));
    }
  }
  if (result.empty()) {
    throw core::NotSupported(
        "libEGL offers neither EGL_MESA_platform_surfaceless nor EGL_EXT_platform_device");
  }
  return result;
}

}  // namespace triptych::gl_backend
