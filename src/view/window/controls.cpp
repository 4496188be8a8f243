#include "view/window/controls.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "core/quoting.hpp"
#include "view/window/colours.hpp"

namespace triptych::view {
namespace {

void show_factor_tooltip(const measure::Factor& factor, const std::string& default_level) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
  ImGui::TextUnformatted(factor.summary.c_str());
  if (factor.kind == measure::FactorKind::number) {
    ImGui::TextUnformatted(fmt::format("{} to {}", factor.minimum, factor.maximum).c_str());
  }
  ImGui::TextColored(colours::quiet, "default: %s", default_level.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// Draws the factor's name, which is bright if the factor does not have its default level.
void draw_label(const Choices& choices, const measure::Factor& factor) {
  const std::string& default_level = choices.default_level(factor.name);
  const bool changed = choices.value(factor.name) != default_level;
  ImGui::AlignTextToFramePadding();
  if (changed) {
    ImGui::TextUnformatted(factor.name.c_str());
  } else {
    ImGui::TextColored(colours::quiet, "%s", factor.name.c_str());
  }
  show_factor_tooltip(factor, default_level);
}

// Returns the width of the longest name, plus some space after it.
float label_width(const measure::Suite& suite) {
  float width = 0;
  for (const measure::Factor& each : suite.factors()) {
    width = std::max(width, ImGui::CalcTextSize(each.name.c_str()).x);
  }
  return width + ImGui::GetStyle().ItemSpacing.x;
}

// Returns the level that the user has chosen, or an empty string if nothing was chosen.
std::string selected_level(const std::vector<std::string>& offered_levels, const std::string& now) {
  std::string chosen;
  for (const std::string& each : offered_levels) {
    if (ImGui::Selectable(each.c_str(), each == now)) chosen = each;
    if (each == now && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
  }
  return chosen;
}

}  // namespace

void Controls::apply(Choices& choices, const std::string& factor, const std::string& value) {
  refusal_ = choices.set(factor, value);
  refused_factor_ = refusal_.empty() ? "" : factor;
}

void Controls::draw_text(Choices& choices, const measure::Factor& factor, float width) {
  const std::string& now = choices.value(factor.name);
  const float arrow = ImGui::GetFrameHeight();
  auto typed = typed_.find(factor.name);
  std::string text = typed == typed_.end() ? now : typed->second;
  ImGui::SetNextItemWidth(width - arrow);
  const bool entered = ImGui::InputText("##value", &text, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) typed_[factor.name] = text;
  if (entered || ImGui::IsItemDeactivatedAfterEdit()) {
    apply(choices, factor.name, text);
    typed_.erase(factor.name);
  } else if (!ImGui::IsItemActive()) {
    typed_.erase(factor.name);
  }
  ImGui::SameLine(0, 0);
  if (ImGui::BeginCombo("##offers", "",
                        ImGuiComboFlags_NoPreview | ImGuiComboFlags_HeightLarge |
                            ImGuiComboFlags_PopupAlignLeft)) {
    const std::string chosen = selected_level(choices.offered_levels(factor.name), now);
    if (!chosen.empty()) apply(choices, factor.name, chosen);
    ImGui::EndCombo();
  }
}

void Controls::draw_factor(Choices& choices, const measure::Factor& factor) {
  ImGui::PushID(factor.name.c_str());
  draw_label(choices, factor);
  const float whole = ImGui::GetWindowContentRegionMax().x;
  const float left = label_width_;
  ImGui::SameLine(left);
  if (factor.kind == measure::FactorKind::choice) {
    const std::string now = choices.value(factor.name);
    ImGui::SetNextItemWidth(whole - left);
    if (ImGui::BeginCombo("##value", now.c_str(), ImGuiComboFlags_HeightLarge)) {
      const std::string chosen = selected_level(choices.offered_levels(factor.name), now);
      if (!chosen.empty()) apply(choices, factor.name, chosen);
      ImGui::EndCombo();
    }
  } else {
    draw_text(choices, factor, whole - left);
  }
  if (refused_factor_ == factor.name) {
    ImGui::PushTextWrapPos(whole);
    ImGui::TextColored(colours::wrong, "%s", core::printable(refusal_, 400).c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::PopID();
}

void Controls::draw_against(Session& session) {
  const auto against = session.against();
  const auto name = [&](std::size_t i) {
    return fmt::format("{} (column {})", session.columns()[i].side.device, i + 1);
  };
  const std::string now = against ? name(*against) : "the reference image";
  ImGui::TextColored(colours::quiet, "difference from");
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##against", now.c_str())) return;
  if (ImGui::Selectable("the reference image", !against)) session.compare_with(std::nullopt);
  for (std::size_t i = 0; i < session.columns().size(); ++i) {
    if (ImGui::Selectable(name(i).c_str(), against == i)) session.compare_with(i);
  }
  ImGui::EndCombo();
}

void Controls::draw_columns(Session& session) const {
  constexpr std::size_t max_columns = 4;
  const std::size_t count = session.columns().size();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(colours::quiet, "columns");
  ImGui::SameLine(label_width_);
  ImGui::BeginDisabled(count <= 1);
  if (ImGui::Button("-", {ImGui::GetFrameHeight(), 0})) session.remove_column(count - 1);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::Text("%zu", count);
  ImGui::SameLine();
  ImGui::BeginDisabled(count >= max_columns);
  if (ImGui::Button("+", {ImGui::GetFrameHeight(), 0})) {
    const auto sides = session.sides();
    session.add_column(sides[count % sides.size()]);
  }
  ImGui::EndDisabled();
}

float Controls::width(const Session& session) {
  constexpr float values = 11;  // in multiples of the font size
  return label_width(session.choices().suite()) + values * ImGui::GetFontSize();
}

void Controls::draw(Session& session) {
  label_width_ = label_width(session.choices().suite());
  Choices& choices = session.choices();
  for (const measure::Factor& factor : choices.suite().factors()) draw_factor(choices, factor);
  if (ImGui::Button("Reset", {-1, 0})) {
    choices.reset();
    refused_factor_.clear();
  }
  ImGui::Spacing();
  ImGui::Separator();
  ImGui::Spacing();
  draw_against(session);
  draw_columns(session);
}

}  // namespace triptych::view
