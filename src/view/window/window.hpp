#pragma once
// The window itself: GLFW and Dear ImGui with OpenGL, and pictures on the graphics card.

#include <imgui.h>

#include <chrono>
#include <optional>
#include <string>

#include "core/rgb_picture.hpp"

struct GLFWwindow;

namespace triptych::view {

class Window {
 public:
  // Throws IoError with the reason if there is no display or no OpenGL.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] bool is_closed() const;
  // Sleeps until there is input, wake() is called or this time is over.
  void wait(std::chrono::milliseconds limit) const;
  void begin_frame() const;
  // Finishes the frame and shows it. With `capture`, returns what it looks like.
  std::optional<core::RgbPicture> end_frame(bool capture) const;
  [[nodiscard]] bool is_reference_key_pressed() const;
  [[nodiscard]] ImVec2 size() const;
  void copy_to_clipboard(const std::string& text) const;
  // Makes wait() return. May be called on any thread.
  static void wake();

 private:
  GLFWwindow* window_ = nullptr;
};

// A picture that the window can draw. It needs a window, and must be destroyed before it.
class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  void set(const core::RgbPicture& picture);
  [[nodiscard]] bool is_empty() const noexcept { return width_ == 0; }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  // Draws the picture into a rectangle of the current ImGui window. Enlarged pixels stay sharp.
  void draw(ImVec2 from, ImVec2 to) const;

 private:
  unsigned int name_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace triptych::view
