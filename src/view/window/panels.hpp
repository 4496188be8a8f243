#pragma once
// The columns of the window. Each column shows the image, the error, the times and the counters of
// one device.

#include <imgui.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "view/session.hpp"
#include "view/window/window.hpp"

namespace triptych::view {

class Panels {
 public:
  // `copy` is called with a command that should be copied to the clipboard.
  explicit Panels(std::function<void(const std::string&)> copy) : copy_(std::move(copy)) {}

  // Draws all columns into the current ImGui window. With `reference`, each image is replaced with
  // its reference image.
  void draw(Session& session, bool reference);

  // Draws the legend for the colours of the difference images.
  void draw_legend(float width);

  // The rectangle of a column's image, in window pixels.
  struct Place {
    ImVec2 from;
    ImVec2 to;
  };
  [[nodiscard]] const std::vector<Place>& images() const noexcept { return images_; }

 private:
  // The textures of a column, and the data from which they were created.
  struct Uploaded {
    const void* frame = nullptr;
    const void* reference = nullptr;
    const void* error = nullptr;
    Texture image;
    Texture truth;
    Texture difference;
  };
  void upload(const Column& column, Uploaded& uploaded);
  void draw_column(Session& session, std::size_t index, bool reference, float side);
  void draw_header(Session& session, std::size_t index);
  void draw_image(Session& session, std::size_t index, bool reference, ImVec2 area);
  void draw_error(Session& session, std::size_t index, ImVec2 area);
  void handle_mouse(Session& session, const Column& column, const Place& place);
  void draw_command_menu(Session& session, const Column& column, const Place& place);

  std::function<void(const std::string&)> copy_;
  std::vector<Uploaded> uploaded_;
  std::vector<Place> images_;
  Texture scale_;
  std::pair<int, int> clicked_;  // the pixel for which commands are offered
};

}  // namespace triptych::view
