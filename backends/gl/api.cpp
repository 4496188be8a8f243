#include "backends/gl/api.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "backends/gl/compile_only.hpp"
#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

// GL_CONTEXT_LOST was introduced in GL 4.5, so older headers lack it.
constexpr GLenum context_lost = 0x0507;

std::string code_name(GLenum code) {
  static constexpr std::array<std::pair<GLenum, const char*>, 9> names{{
      {GL_INVALID_ENUM, "GL_INVALID_ENUM"},
      {GL_INVALID_VALUE, "GL_INVALID_VALUE"},
      {GL_INVALID_OPERATION, "GL_INVALID_OPERATION"},
      {GL_INVALID_FRAMEBUFFER_OPERATION, "GL_INVALID_FRAMEBUFFER_OPERATION"},
      {GL_OUT_OF_MEMORY, "GL_OUT_OF_MEMORY"},
      {context_lost, "GL_CONTEXT_LOST"},
      {GL_GUILTY_CONTEXT_RESET, "GL_GUILTY_CONTEXT_RESET"},
      {GL_INNOCENT_CONTEXT_RESET, "GL_INNOCENT_CONTEXT_RESET"},
      {GL_UNKNOWN_CONTEXT_RESET, "GL_UNKNOWN_CONTEXT_RESET"},
  }};
  for (const auto& [value, name] : names) {
    if (value == code) return name;
  }
  return fmt::format("{:#06x}", code);
}

}  // namespace

Api::Api(GLADloadfunc load) : GladGLContext{} {
  const int version = gladLoadGLContext(this, load);
  if (version < GLAD_MAKE_VERSION(3, 3)) {
    throw core::NotSupported(fmt::format("needs OpenGL 3.3, but the context provides only {}.{}",
                                         GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
  }
}

void GLAD_API_PTR Api::on_message(GLenum /*source*/, GLenum type, GLuint /*id*/,
                                  GLenum /*severity*/, GLsizei length, const GLchar* message,
                                  const void* user) {
  // The callback was registered with the address of a mutable Messages object, which GL passes as
  // const.
  auto* messages = static_cast<Messages*>(const_cast<void*>(user));
  const auto size =
      length < 0 ? std::string_view(message).size() : static_cast<std::size_t>(length);
  if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) {
    messages->lines.emplace_back(message, size);
  } else if (type == GL_DEBUG_TYPE_OTHER && messages->keeps_reports) {
    messages->reports.push_back({messages->program, std::string(message, size)});
  }
}

void Api::collect_messages() {
  if (DebugMessageCallback == nullptr) return;
  messages_ = std::make_unique<Messages>();
  Enable(GL_DEBUG_OUTPUT);
  Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  DebugMessageCallback(&Api::on_message, messages_.get());
}

void Api::set_compile_only() {
  executes_ = false;
  forbid_execution(*this);
}

void Api::keep_reports() const {
  if (!messages_) return;
  // The messages in which drivers report generated code have a severity that is disabled by
  // default.
  if (DebugMessageControl != nullptr) {
    DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  }
  messages_->keeps_reports = true;
  messages_->reports.clear();
}

std::vector<Api::Report> Api::take_reports() const {
  if (!messages_) return {};
  messages_->keeps_reports = false;
  return std::exchange(messages_->reports, {});
}

void Api::begin_link(std::vector<LinkedStage> stages) const {
  if (messages_) messages_->program = std::move(stages);
}

void Api::check(std::string_view call, core::CodePlace place) const {
  // After a context loss, every call may return an error, so the reset status is queried first.
  const GLenum reset = GetGraphicsResetStatus != nullptr ? GetGraphicsResetStatus() : GL_NO_ERROR;
  const GLenum error = GetError();
  if (reset == GL_NO_ERROR && error == GL_NO_ERROR && (!messages_ || messages_->lines.empty())) {
    return;
  }
  std::string detail;
  if (messages_) {
    for (const std::string& line : std::exchange(messages_->lines, {})) {
      detail += (detail.empty() ? "" : "; ") + line;
    }
  }
  if (reset != GL_NO_ERROR || error == context_lost) {
    throw core::DeviceLost(std::string(call), code_name(reset != GL_NO_ERROR ? reset : error),
                           detail, place);
  }
  throw core::ApiError(std::string(call),
                       error != GL_NO_ERROR ? code_name(error) : "a driver message", detail, place);
}

std::string Api::text(GLenum name) const {
  const GLubyte* value = GetString(name);
  return value != nullptr ? std::string(reinterpret_cast<const char*>(value)) : std::string();
}

std::int64_t Api::limit(GLenum name) const {
  GLint64 value = 0;
  GetInteger64v(name, &value);
  return value;
}

std::int64_t Api::limit(GLenum name, GLuint index) const {
  GLint value = 0;
  GetIntegeri_v(name, index, &value);
  return value;
}

bool Api::at_least(int major, int minor) const {
  const std::int64_t own_major = limit(GL_MAJOR_VERSION);
  return own_major > major || (own_major == major && limit(GL_MINOR_VERSION) >= minor);
}

}  // namespace triptych::gl_backend
