#include "view/window/panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/quoting.hpp"
#include "report/words/outcome.hpp"
#include "view/window/colours.hpp"
#include "view/window/numbers.hpp"

namespace triptych::view {
namespace {

// Returns the largest rectangle in the area that has the aspect ratio of the image. Pixels are
// enlarged only by whole numbers, so that each pixel remains a square.
Panels::Place fitted(ImVec2 corner, ImVec2 area, int width, int height) {
  const auto w = static_cast<float>(std::max(1, width));
  const auto h = static_cast<float>(std::max(1, height));
  float scale = std::min(area.x / w, area.y / h);
  if (scale > 1) scale = std::floor(scale);
  const ImVec2 size{std::max(1.0F, std::floor(w * scale)), std::max(1.0F, std::floor(h * scale))};
  const ImVec2 from{std::floor(corner.x + 0.5F * (area.x - size.x)),
                    std::floor(corner.y + 0.5F * (area.y - size.y))};
  return {from, {from.x + size.x, from.y + size.y}};
}

void draw_border(const Panels::Place& place) {
  ImGui::GetWindowDrawList()->AddRect({place.from.x - 1, place.from.y - 1},
                                      {place.to.x + 1, place.to.y + 1}, colours::frame);
}

// Draws text in the centre of a rectangle.
void draw_message(const Panels::Place& place, const ImVec4& colour, const std::string& text) {
  const float margin = ImGui::GetFontSize();
  const float width = place.to.x - place.from.x - 2 * margin;
  const std::string shown = core::printable(text, 300);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str(), nullptr, false, width);
  const float y = place.from.y + std::max(0.0F, 0.5F * (place.to.y - place.from.y - size.y));
  ImGui::GetWindowDrawList()->AddText(nullptr, 0,
                                      {place.from.x + margin + 0.5F * (width - size.x), y},
                                      ImGui::GetColorU32(colour), shown.c_str(), nullptr, width);
}

// Draws text in the top left corner of an image. The text has a dark background, because the image
// may be bright or noisy.
void caption(const Panels::Place& place, const std::string& text) {
  const std::string shown = core::printable(text, 100);
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  const float right = std::min(place.to.x, place.from.x + size.x + 8);
  ImDrawList* const list = ImGui::GetWindowDrawList();
  list->PushClipRect(place.from, place.to, true);
  list->AddRectFilled(place.from, {right, place.from.y + size.y + 4}, IM_COL32(0, 0, 0, 215));
  list->AddText({place.from.x + 4, place.from.y + 2}, IM_COL32_WHITE, shown.c_str());
  list->PopClipRect();
}

std::string name_of(const measure::ViewSide& side) {
  std::string name = side.device;
  for (const std::string& each : side.environment) name += "," + each;
  return name;
}

// Returns the pixel of the image that is under the mouse pointer.
std::optional<std::pair<int, int>> pixel_under_mouse(const Panels::Place& place,
                                                     const core::Image& image) {
  const ImVec2 mouse = ImGui::GetMousePos();
  const float x = (mouse.x - place.from.x) / (place.to.x - place.from.x);
  const float y = (mouse.y - place.from.y) / (place.to.y - place.from.y);
  if (x < 0 || y < 0 || x >= 1 || y >= 1 || image.width < 1) return std::nullopt;
  return std::pair(static_cast<int>(x * static_cast<float>(image.width)),
                   static_cast<int>(y * static_cast<float>(image.height)));
}

std::string rgba(const core::Image& image, std::pair<int, int> at) {
  if (at.first >= image.width || at.second >= image.height) return "-";
  const auto [r, g, b, a] = image.pixel(at.first, at.second);
  return fmt::format("{:.5f} {:.5f} {:.5f} {:.5f}", r, g, b, a);
}

void show_pixel_tooltip(const Column& column, std::pair<int, int> at) {
  if (!column.shown || !column.shown->has_image()) return;
  ImGui::BeginTooltip();
  ImGui::Text("pixel %d,%d", at.first, at.second);
  ImGui::TextUnformatted(("image      " + rgba(column.shown->image, at)).c_str());
  if (column.reference && column.reference->error.empty()) {
    ImGui::TextUnformatted(("reference  " + rgba(column.reference->pair.truth, at)).c_str());
    ImGui::TextUnformatted(("bound      " + rgba(column.reference->pair.bound, at)).c_str());
  }
  ImGui::EndTooltip();
}

}  // namespace

void Panels::upload(const Column& column, Uploaded& uploaded) {
  if (column.shown && column.shown.get() != uploaded.frame) {
    if (column.shown->has_image()) uploaded.image.set(column.shown->displayed);
    uploaded.frame = column.shown.get();
  }
  if (column.reference && column.reference->error.empty() &&
      column.reference.get() != uploaded.reference) {
    uploaded.truth.set(core::to_srgb(column.reference->pair.truth));
    uploaded.reference = column.reference.get();
  }
  if (column.error && column.error.get() != uploaded.error) {
    uploaded.difference.set(column.error->displayed);
    uploaded.error = column.error.get();
  }
}

void Panels::draw_header(Session& session, std::size_t index) {
  const measure::ViewSide now = session.columns()[index].side;
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##device", name_of(now).c_str())) {
    for (const measure::ViewSide& each : session.sides()) {
      if (ImGui::Selectable(name_of(each).c_str(), each == now)) session.set_side(index, each);
    }
    ImGui::Separator();
    if (ImGui::Selectable("restart the driver")) session.set_side(index, now);
    ImGui::EndCombo();
  }
  if (!ImGui::IsItemHovered()) return;
  for (const record::Device& device : session.request().devices) {
    if (device.id != now.device) continue;
    ImGui::SetTooltip("%s, driver %s, %s", core::printable(device.name).c_str(),
                      core::printable(device.driver_version).c_str(),
                      core::printable(device.api_version).c_str());
  }
}

void Panels::handle_mouse(Session& session, const Column& column, const Place& place) {
  const auto now = Session::Clock::now();
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0)) {
    const float height = place.to.y - place.from.y;
    if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) {
      session.turn(io.MouseDelta.x / height, io.MouseDelta.y / height, now);
    }
  }
  if (!ImGui::IsItemHovered()) return;
  if (io.MouseWheel != 0) session.approach(io.MouseWheel, now);
  const bool quiet =
      ImGui::IsMouseDown(ImGuiMouseButton_Left) || !session.request().screenshot.empty();
  if (!column.shown || quiet) return;
  if (const auto at = pixel_under_mouse(place, column.shown->image))
    show_pixel_tooltip(column, *at);
}

void Panels::draw_command_menu(Session& session, const Column& column, const Place& place) {
  if (!column.shown) return;
  const auto at = pixel_under_mouse(place, column.shown->image);
  if (at && ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
    clicked_ = *at;
    ImGui::OpenPopup("commands");
  }
  if (!ImGui::BeginPopup("commands")) return;
  if (ImGui::MenuItem("Copy the render command")) copy_(session.command(column));
  const std::string pixel =
      fmt::format("Copy the command that explains pixel {},{}", clicked_.first, clicked_.second);
  if (ImGui::MenuItem(pixel.c_str())) copy_(session.command(column, clicked_));
  ImGui::EndPopup();
}

void Panels::draw_image(Session& session, std::size_t index, bool reference, ImVec2 area) {
  const Column& column = session.columns()[index];
  const Uploaded& uploaded = uploaded_[index];
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool drawn = column.shown && column.shown->has_image();
  const Place place = drawn ? fitted(corner, area, uploaded.image.width(), uploaded.image.height())
                            : Place{corner, {corner.x + area.x, corner.y + area.y}};
  ImGui::InvisibleButton("image", area);
  draw_border(place);
  images_[index] = place;
  if (!drawn) {
    const bool failed = column.shown != nullptr;
    const std::string why =
        failed ? report::words::text_of(column.shown->record.outcome, column.shown->record.reason)
        : column.state.loading
            ? fmt::format("loading the data: {:.0f} %", 100 * column.state.loading->share)
            : "starting the driver";
    draw_message(place, failed ? colours::wrong : colours::quiet, why);
  } else if (reference && column.reference && !uploaded.truth.is_empty()) {
    uploaded.truth.draw(place.from, place.to);
    caption(place, "reference image");
  } else {
    uploaded.image.draw(place.from, place.to);
  }
  handle_mouse(session, column, place);
  draw_command_menu(session, column, place);
}

void Panels::draw_error(Session& session, std::size_t index, ImVec2 area) {
  const Column& column = session.columns()[index];
  const Uploaded& uploaded = uploaded_[index];
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool shown = column.error && !column.error->displayed.rgb.empty();
  const Place place =
      shown ? fitted(corner, area, uploaded.difference.width(), uploaded.difference.height())
            : Place{corner, {corner.x + area.x, corner.y + area.y}};
  ImGui::InvisibleButton("error", area);
  draw_border(place);
  if (!shown) {
    draw_message(place, colours::quiet,
                 column.error ? column.error->sentence : column.why_no_error);
  } else {
    uploaded.difference.draw(place.from, place.to);
    const auto against = session.against();
    const std::string from = against ? session.columns()[*against].side.device : "the reference";
    const float scale =
        (place.to.x - place.from.x) / static_cast<float>(uploaded.difference.width());
    for (const ShownError::Ring& ring : column.error->rings) {
      const ImVec2 centre{place.from.x + (static_cast<float>(ring.x) + 0.5F) * scale,
                          place.from.y + (static_cast<float>(ring.y) + 0.5F) * scale};
      const float radius = static_cast<float>(column.error->ring_radius) * scale;
      ImGui::GetWindowDrawList()->AddCircle(centre, radius, IM_COL32(0, 0, 0, 255), 0, 4);
      ImGui::GetWindowDrawList()->AddCircle(centre, radius, IM_COL32(255, 255, 255, 255), 0, 1.5F);
    }
    caption(place, "difference from " + from);
  }
  handle_mouse(session, column, place);
  draw_command_menu(session, column, place);
}

void Panels::draw_legend(float width) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  constexpr int steps = 220;
  constexpr float bound = 1 / 1.1F;
  if (scale_.is_empty()) scale_.set(scale_of_bounds(steps));
  const float height = std::floor(0.55F * ImGui::GetFontSize());
  scale_.draw(from, {from.x + width, from.y + height});
  draw_border({from, {from.x + width, from.y + height}});
  ImGui::Dummy({width, height});
  const float line = ImGui::GetCursorScreenPos().y;
  const auto label = [&](float x, const char* text, float shift) {
    const float size = ImGui::CalcTextSize(text).x;
    ImGui::GetWindowDrawList()->AddText({from.x + x - shift * size, line},
                                        ImGui::GetColorU32(colours::quiet), text);
  };
  label(0, "no difference", 0);
  label(bound * width, "the bound", 1);
  ImGui::Dummy({width, ImGui::GetFontSize()});
}

void Panels::draw_column(Session& session, std::size_t index, bool reference, float side) {
  ImGui::PushID(static_cast<int>(index));
  draw_header(session, index);
  upload(session.columns()[index], uploaded_[index]);
  const ImVec2 area{ImGui::GetContentRegionAvail().x, side};
  draw_image(session, index, reference, area);
  draw_error(session, index, area);
  const Column& column = session.columns()[index];
  if (column.error) {
    ImGui::TextColored(column.error->right ? colours::right : colours::wrong, "%s %s",
                       column.error->right ? "right:" : "WRONG:", column.error->headline.c_str());
    if (ImGui::IsItemHovered()) {
      ImGui::BeginTooltip();
      ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
      ImGui::TextUnformatted(core::printable(column.error->sentence).c_str());
      ImGui::PopTextWrapPos();
      ImGui::EndTooltip();
    }
  } else {
    ImGui::TextColored(colours::quiet, "%s", column.state.drawing ? "drawing" : "not compared");
  }
  if (ImGui::Button("Copy the render command", {-1, 0})) copy_(session.command(column));
  draw_numbers(session, index);
  ImGui::PopID();
}

void Panels::draw(Session& session, bool reference) {
  const std::size_t count = session.columns().size();
  uploaded_.resize(count);
  images_.resize(count);
  // The height is divided between two square images and some lines of numbers.
  const float line = ImGui::GetFrameHeightWithSpacing();
  constexpr float number_lines = 7.5F;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float width =
      std::floor((room.x - static_cast<float>(count - 1) * spacing) / static_cast<float>(count));
  const float side = std::clamp(0.5F * (room.y - number_lines * line), 64.0F, width);
  for (std::size_t i = 0; i < session.columns().size(); ++i) {
    if (i > 0) ImGui::SameLine();
    ImGui::BeginChild(static_cast<ImGuiID>(i + 1), {width, room.y}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_column(session, i, reference, side);
    ImGui::EndChild();
  }
}

}  // namespace triptych::view
