#include "view/window/numbers.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>

#include "judge/agreement.hpp"
#include "view/window/colours.hpp"

namespace triptych::view {
namespace {

// Formats a number with thousands separators, such as "1,234,567".
std::string grouped(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::size_t from_end = 3; from_end < digits.size(); from_end += 4) {
    digits.insert(digits.size() - from_end, ",");
  }
  return digits;
}

void draw_right_aligned(const ImVec4& colour, const std::string& text) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::TextColored(colour, "%s", text.c_str());
}

void draw_row(const std::string& name, const ImVec4& colour, const std::string& value,
              const std::string& explanation) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextColored(colours::quiet, "%s", name.c_str());
  if (!explanation.empty() && ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s", explanation.c_str());
  }
  ImGui::TableNextColumn();
  draw_right_aligned(colour, value);
}

std::string milliseconds(double ns) {
  return fmt::format("{:.3f} ms", ns / 1e6);
}

void draw_time_row(const record::Record& record) {
  const auto summary = record::summarise(record.time_ns());
  if (!summary) return;
  draw_row(
      "frame", ImGui::GetStyleColorVec4(ImGuiCol_Text), milliseconds(summary->median),
      fmt::format("median of {} frames on the {} clock; range {} to {}", record.time_ns().size(),
                  record.clock(), milliseconds(summary->minimum), milliseconds(summary->maximum)));
}

// Returns the value of the same counter in the first column. Returns nullptr if this is the first
// column or if the first column shows another frame.
const std::uint64_t* first_column_counter(const Session& session, std::size_t index,
                                          const std::string& name) {
  const Column& first = session.columns().front();
  const Column& column = session.columns()[index];
  if (index == 0 || !first.shown || !column.shown) return nullptr;
  if (first.shown->request.number != column.shown->request.number) return nullptr;
  const auto found = first.shown->record.counters.find(name);
  return found == first.shown->record.counters.end() ? nullptr : &found->second;
}

bool differ_too_much(std::uint64_t a, std::uint64_t b) {
  const double distance = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return distance > judge::counters_across_devices * static_cast<double>(b);
}

}  // namespace

void draw_numbers(const Session& session, std::size_t index) {
  const Column& column = session.columns()[index];
  if (!column.shown || column.shown->record.outcome != record::Outcome::measured) return;
  const record::Record& record = column.shown->record;
  const ImVec4& plain = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  if (!ImGui::BeginTable("numbers", 2, ImGuiTableFlags_ScrollY)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1.7F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1);
  draw_time_row(record);
  for (const auto& [name, value] : record.counters) {
    const std::uint64_t* const first = first_column_counter(session, index, name);
    const bool differs =
        first != nullptr && !judge::depends_on_api(name) && differ_too_much(value, *first);
    draw_row(name, differs ? colours::wrong : plain, grouped(value),
             differs ? fmt::format("differs from the first column: {}", grouped(*first)) : "");
  }
  for (const auto& [name, value] : record.statistics) {
    draw_row(name, colours::quiet, grouped(value), "reported by the driver");
  }
  for (const auto& [name, value] : record.memory) {
    draw_row(name, colours::quiet, grouped(value) + " B", "memory allocated on the device");
  }
  ImGui::EndTable();
}

}  // namespace triptych::view
