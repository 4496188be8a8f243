#include "backends/gl/compile_only.hpp"

#include <string>
#include <utility>

#include "core/error.hpp"
#include "measure/system/compile_only.hpp"

namespace triptych::gl_backend {
namespace {

// The driver's own functions. They are global variables, because the replacements are plain
// function pointers, which cannot carry state.
PFNGLBUFFERDATAPROC buffer_data = nullptr;
PFNGLTEXIMAGE1DPROC tex_image_1d = nullptr;
PFNGLTEXIMAGE2DPROC tex_image_2d = nullptr;
PFNGLTEXIMAGE3DPROC tex_image_3d = nullptr;

template <typename Function>
struct Forbidden;
template <typename Result, typename... Arguments>
struct Forbidden<Result(GLAD_API_PTR*)(Arguments...)> {
  static Result GLAD_API_PTR call(Arguments... /*arguments*/) {
    throw core::NotSupported(std::string(measure::only_compiles));
  }
};

template <typename Function>
struct Ignored;
template <typename... Arguments>
struct Ignored<void(GLAD_API_PTR*)(Arguments...)> {
  static void GLAD_API_PTR call(Arguments... /*arguments*/) {}
};

template <typename Function>
void forbid(Function& function) {
  if (function != nullptr) function = &Forbidden<Function>::call;
}

template <typename Function>
void ignore(Function& function) {
  if (function != nullptr) function = &Ignored<Function>::call;
}

// These replacements allocate memory but copy no data.
void GLAD_API_PTR make_buffer(GLenum target, GLsizeiptr size, const void* /*data*/, GLenum usage) {
  buffer_data(target, size, nullptr, usage);
}
void GLAD_API_PTR make_image_1d(GLenum target, GLint level, GLint internal, GLsizei width,
                                GLint border, GLenum format, GLenum type, const void* /*data*/) {
  tex_image_1d(target, level, internal, width, border, format, type, nullptr);
}
void GLAD_API_PTR make_image_2d(GLenum target, GLint level, GLint internal, GLsizei width,
                                GLsizei height, GLint border, GLenum format, GLenum type,
                                const void* /*data*/) {
  tex_image_2d(target, level, internal, width, height, border, format, type, nullptr);
}
void GLAD_API_PTR make_image_3d(GLenum target, GLint level, GLint internal, GLsizei width,
                                GLsizei height, GLsizei depth, GLint border, GLenum format,
                                GLenum type, const void* /*data*/) {
  tex_image_3d(target, level, internal, width, height, depth, border, format, type, nullptr);
}

}  // namespace

void forbid_execution(GladGLContext& gl) {
  forbid(gl.DrawArrays);
  forbid(gl.DrawArraysInstanced);
  forbid(gl.DrawElementsBaseVertex);
  forbid(gl.MultiDrawArraysIndirect);
  forbid(gl.DispatchCompute);
  forbid(gl.DispatchComputeIndirect);
  forbid(gl.ReadPixels);
  forbid(gl.GetBufferSubData);
  forbid(gl.GetQueryObjectui64v);
  forbid(gl.BeginQuery);
  forbid(gl.EndQuery);
  forbid(gl.QueryCounter);
  forbid(gl.FenceSync);
  forbid(gl.ClientWaitSync);
  forbid(gl.Finish);
  forbid(gl.Flush);
  ignore(gl.BufferSubData);
  ignore(gl.CopyBufferSubData);
  ignore(gl.TexSubImage3D);
  ignore(gl.ClearBufferfv);
  ignore(gl.ClearBufferuiv);
  buffer_data = std::exchange(gl.BufferData, &make_buffer);
  tex_image_1d = std::exchange(gl.TexImage1D, &make_image_1d);
  tex_image_2d = std::exchange(gl.TexImage2D, &make_image_2d);
  tex_image_3d = std::exchange(gl.TexImage3D, &make_image_3d);
}

}  // namespace triptych::gl_backend
