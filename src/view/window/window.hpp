#pragma once
// The window, based on GLFW and Dear ImGui with OpenGL, and textures for it.

#include <imgui.h>

#include <chrono>
#include <optional>
#include <string>

#include "core/rgb_image.hpp"

struct GLFWwindow;

namespace triptych::view {

class Window {
 public:
  // Opens the window. Throws IoError with the reason if there is no display or no OpenGL.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] bool is_closed() const;
  // Sleeps until there is input, wake() is called, or the time limit has passed.
  void wait(std::chrono::milliseconds limit) const;
  void begin_frame() const;
  // Finishes and displays the frame. With `capture`, returns the displayed image.
  std::optional<core::RgbImage> end_frame(bool capture) const;
  [[nodiscard]] bool is_reference_key_pressed() const;
  [[nodiscard]] ImVec2 size() const;
  void copy_to_clipboard(const std::string& text) const;
  // Makes wait() return. This may be called from any thread.
  static void wake();

 private:
  GLFWwindow* window_ = nullptr;
};

// An image that the window can draw. It requires an open window, and must be destroyed before the
// window.
class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  void set(const core::RgbImage& captured);
  [[nodiscard]] bool is_empty() const noexcept { return width_ == 0; }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  // Draws the image into a rectangle of the current ImGui window. Enlarged pixels have sharp edges.
  void draw(ImVec2 from, ImVec2 to) const;

 private:
  unsigned int name_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace triptych::view
