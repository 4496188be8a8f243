// OSMesa: Mesa's software renderers without a window system. Newer versions of Mesa no longer
// include OSMesa, so this file repeats its few declarations instead of including <GL/osmesa.h>.

#include <array>
#include <cstdint>

#include "backends/gl/context.hpp"
#include "backends/gl/library.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

using OsmesaHandle = void*;

constexpr int osmesa_format = 0x22;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_context_major_version = 0x36;
constexpr int osmesa_context_minor_version = 0x37;

struct Osmesa {
  Library library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  OsmesaHandle (*create)(const int* attributes, OsmesaHandle share) =
      library.get<OsmesaHandle (*)(const int*, OsmesaHandle)>("OSMesaCreateContextAttribs");
  void (*destroy)(OsmesaHandle) = library.get<void (*)(OsmesaHandle)>("OSMesaDestroyContext");
  GLboolean (*make_current)(OsmesaHandle, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) =
      library.get<GLboolean (*)(OsmesaHandle, void*, GLenum, GLsizei, GLsizei)>(
          "OSMesaMakeCurrent");
  GLADloadfunc get_proc_address = library.get<GLADloadfunc>("OSMesaGetProcAddress");
};

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(bool debug) {
    constexpr std::array attributes{osmesa_format,
                                    GL_RGBA,
                                    osmesa_profile,
                                    osmesa_core_profile,
                                    osmesa_context_major_version,
                                    3,
                                    osmesa_context_minor_version,
                                    3,
                                    0};
    handle_ = osmesa_.create(attributes.data(), nullptr);
    if (handle_ == nullptr)
      throw core::NotSupported("the driver cannot create an OpenGL 3.3 core context");
    try {
      const Current current(*this);
      load(osmesa_.get_proc_address, debug);
    } catch (...) {
      osmesa_.destroy(handle_);
      throw;
    }
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;
  [[nodiscard]] bool computes_on_cpu() const override { return true; }
  ~OsmesaContext() override { osmesa_.destroy(handle_); }

 private:
  void make_current() override {
    if (osmesa_.make_current(handle_, window_.data(), GL_UNSIGNED_BYTE, window_edge, window_edge) ==
        GL_FALSE) {
      throw core::ApiError("OSMesaMakeCurrent", "GL_FALSE");
    }
  }
  void release_current() noexcept override {
    osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  }

  static constexpr int window_edge = 4;
  Osmesa osmesa_;
  OsmesaHandle handle_ = nullptr;
  // OSMesa requires a window buffer, although every technique draws into its own framebuffer.
  std::array<std::uint8_t, std::size_t{4} * window_edge * window_edge> window_{};
};

}  // namespace

std::vector<Candidate> osmesa_candidates() {
  const Osmesa probe;
  return {{"OSMesa", [](bool debug) { return std::make_unique<OsmesaContext>(debug); }}};
}

}  // namespace triptych::gl_backend
