#pragma once
// The controls on the left side of the window: one for each factor of the suite.

#include <map>
#include <string>

#include "view/session.hpp"

namespace triptych::view {

class Controls {
 public:
  // Returns the width needed for the names and the levels of the suite's factors.
  [[nodiscard]] static float width(const Session& session);
  // Draws the controls into the current ImGui window, and applies the changes that the user makes.
  void draw(Session& session);

 private:
  void draw_factor(Choices& choices, const measure::Factor& factor);
  void draw_text(Choices& choices, const measure::Factor& factor, float width);
  void apply(Choices& choices, const std::string& factor, const std::string& value);
  static void draw_against(Session& session);
  void draw_columns(Session& session) const;

  float label_width_ = 0;                     // width of the factors' names
  std::map<std::string, std::string> typed_;  // text that is being typed, by factor
  std::string refused_factor_;
  std::string refusal_;  // the reason why the latest change was rejected
};

}  // namespace triptych::view
