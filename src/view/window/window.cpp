#include "view/window/window.hpp"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace triptych::view {
namespace {

// GLFW reports the reason for an error only to a callback, which stores it here.
std::string& last_reason() {
  static std::string reason;
  return reason;
}

void store_glfw_error(int /*code*/, const char* text) {
  last_reason() = text;
}

[[noreturn]] void throw_window_error(const std::string& what) {
  std::string reason = std::exchange(last_reason(), {});
  glfwTerminate();
  throw core::IoError(
      fmt::format("cannot open the window: {}{}{}; `triptych view` needs a display, for example "
                  "one created by xvfb-run",
                  what, reason.empty() ? "" : ": ", reason));
}

// Whether the window is open. If it is not, wake() does nothing, because threads may call wake()
// even after the window has been closed.
std::atomic<bool> is_open = false;

// The default font of most Debian desktops. Without it, ImGui's built-in font is used, which has
// only one size.
constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

void set_style(float scale) {
  constexpr float font_size = 14;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // do not save ImGui's settings
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  static const ImWchar ranges[] = {0x20, 0xff, 0x2010, 0x2026, 0x2190, 0x2193, 0x2260, 0x2264, 0};
  if (!std::filesystem::exists(font_file) ||
      io.Fonts->AddFontFromFileTTF(font_file, font_size * scale, nullptr, ranges) == nullptr) {
    io.FontGlobalScale = scale;
  }
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.ItemSpacing = {8, 4};
  style.Colors[ImGuiCol_WindowBg] = {0.11F, 0.12F, 0.13F, 1};
  style.ScaleAllSizes(scale);
}

// Converts the name of an OpenGL texture to ImGui's type for textures, which is a pointer in some
// versions of ImGui and an integer in others.
template <typename Id = ImTextureID>
Id texture_id(unsigned int name) {
  if constexpr (std::is_pointer_v<Id>) {
    return reinterpret_cast<Id>(static_cast<std::uintptr_t>(name));
  } else {
    return static_cast<Id>(name);
  }
}

}  // namespace

Window::Window(int width, int height, const std::string& title) {
  glfwSetErrorCallback(store_glfw_error);
  if (glfwInit() != GLFW_TRUE) throw_window_error("there is no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) throw_window_error("OpenGL 3.0 is not available");
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  float scale = 1;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  ImGui::CreateContext();
  set_style(std::max(1.0F, scale));
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 130");
  is_open = true;
}

Window::~Window() {
  is_open = false;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::is_closed() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::wait(std::chrono::milliseconds limit) const {
  if (limit.count() <= 0) return glfwPollEvents();
  glfwWaitEventsTimeout(std::chrono::duration<double>(limit).count());
}

void Window::wake() {
  if (is_open) glfwPostEmptyEvent();
}

void Window::begin_frame() const {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

std::optional<core::RgbImage> Window::end_frame(bool capture) const {
  ImGui::Render();
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  std::optional<core::RgbImage> captured;
  if (capture) {
    captured.emplace(core::RgbImage{width, height, {}});
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    captured->rgb.resize(row * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, captured->rgb.data());
    // The first row from OpenGL is the bottom row, so the rows are reversed.
    for (std::size_t top = 0, low = static_cast<std::size_t>(height) - 1; top < low; ++top, --low) {
      std::swap_ranges(captured->rgb.data() + top * row, captured->rgb.data() + (top + 1) * row,
                       captured->rgb.data() + low * row);
    }
  }
  glfwSwapBuffers(window_);
  return captured;
}

bool Window::is_reference_key_pressed() const {
  return glfwGetKey(window_, GLFW_KEY_R) == GLFW_PRESS;
}

ImVec2 Window::size() const {
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {static_cast<float>(width), static_cast<float>(height)};
}

void Window::copy_to_clipboard(const std::string& text) const {
  glfwSetClipboardString(window_, text.c_str());
}

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

Texture::Texture(Texture&& other) noexcept
    : name_(std::exchange(other.name_, 0)),
      width_(std::exchange(other.width_, 0)),
      height_(std::exchange(other.height_, 0)) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  return *this;
}

void Texture::set(const core::RgbImage& captured) {
  width_ = captured.width;
  height_ = captured.height;
  if (captured.rgb.empty()) return;
  if (name_ == 0) glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE,
               captured.rgb.data());
}

void Texture::draw(ImVec2 from, ImVec2 to) const {
  if (name_ != 0) ImGui::GetWindowDrawList()->AddImage(texture_id(name_), from, to);
}

}  // namespace triptych::view
