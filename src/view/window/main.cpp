// triptych-view: the window of `triptych view`, which runs this program with a request as its only
// argument. This process loads only the driver that displays its window. The devices run in worker
// processes of `triptych`.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "core/quoting.hpp"
#include "measure/request/view_request.hpp"
#include "measure/system/interrupt.hpp"
#include "view/session.hpp"
#include "view/session_json.hpp"
#include "view/window/colours.hpp"
#include "view/window/controls.hpp"
#include "view/window/panels.hpp"
#include "view/window/suites.hpp"
#include "view/window/window.hpp"

namespace triptych::view {
namespace {

using namespace std::chrono_literals;

// The content of the window, and the command that the user has most recently copied.
class Screen {
 public:
  Screen(Window& window, Session& session)
      : window_(window), session_(session), panels_([this](const std::string& command) {
          window_.copy_to_clipboard(command);
          copied_ = command;
          std::fputs((core::printable_lines(command) + "\n").c_str(), stdout);
          std::fflush(stdout);
        }) {}

  void draw() {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(window_.size());
    ImGui::Begin("view", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const float width = Controls::width(session_);
    ImGui::BeginChild("controls", {width, 0});
    controls_.draw(session_);
    ImGui::Spacing();
    panels_.draw_legend(0.85F * width);
    draw_help();
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("panels", {0, 0}, false, ImGuiWindowFlags_NoScrollbar);
    const bool typing = ImGui::GetIO().WantTextInput;
    panels_.draw(session_, !typing && window_.is_reference_key_pressed());
    ImGui::EndChild();
    ImGui::End();
  }

  [[nodiscard]] core::Json json() const {
    std::vector<std::array<int, 4>> places;
    for (const Panels::Place& each : panels_.images()) {
      places.push_back({static_cast<int>(each.from.x), static_cast<int>(each.from.y),
                        static_cast<int>(each.to.x - each.from.x),
                        static_cast<int>(each.to.y - each.from.y)});
    }
    return session_json(session_, places);
  }

 private:
  void draw_help() {
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, colours::quiet);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(
        "Drag on an image to turn the camera. Use the mouse wheel to move closer or farther away. "
        "Hold R to show the reference image. Right-click a pixel for commands that reproduce or "
        "explain it.");
    if (!copied_.empty()) {
      ImGui::Spacing();
      ImGui::TextUnformatted(("Copied: " + core::printable(copied_)).c_str());
    }
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }

  Window& window_;
  Session& session_;
  Controls controls_;
  Panels panels_;
  std::string copied_;
};

// Draws the window when there is something new to show, and sleeps otherwise.
class Loop {
 public:
  Loop(Window& window, Session& session, Screen& screen, measure::InterruptGuard& interrupts)
      : window_(window), session_(session), screen_(screen), interrupts_(interrupts) {}

  void run() {
    while (!window_.is_closed() && !interrupts_.received_signal()) {
      sleep();
      if (session_.update(Session::Clock::now())) frames_due_ = frames_after_input;
      const bool capture = !session_.request().screenshot.empty() && session_.is_settled();
      if (capture) frames_due_ = std::max(frames_due_, 1);
      if (frames_due_ == 0) continue;
      window_.begin_frame();
      screen_.draw();
      --frames_due_;
      // After a change, several frames are due (frames_due_). Only the last of them is captured,
      // because everything has its final position only then.
      const auto captured = window_.end_frame(capture && frames_due_ == 0);
      if (!captured) continue;
      return core::write_file(core::encode_png(*captured), session_.request().screenshot);
    }
  }

 private:
  // ImGui needs a few frames to react to input.
  static constexpr int frames_after_input = 3;

  void sleep() {
    constexpr auto blink = 400ms;    // the blinking period of the text cursor
    constexpr auto signals = 500ms;  // signals are polled, because GLFW cannot wait for them
    if (frames_due_ > 0) return window_.wait(0ms);
    const auto before = Session::Clock::now();
    auto limit = ImGui::GetIO().WantTextInput ? blink : signals;
    if (const auto next = session_.next_update()) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*next - before);
      limit = std::clamp(left, std::chrono::milliseconds(0), limit);
    }
    window_.wait(limit);
    if (Session::Clock::now() - before < limit) {
      frames_due_ = frames_after_input;  // there was input or a call of wake()
    } else if (ImGui::GetIO().WantTextInput) {
      frames_due_ = 1;
    }
  }

  Window& window_;
  Session& session_;
  Screen& screen_;
  measure::InterruptGuard& interrupts_;
  int frames_due_ = frames_after_input;
};

core::ExitCode show(const measure::ViewRequest& request, measure::InterruptGuard& interrupts) {
  auto window = std::make_unique<Window>(request.width, request.height,
                                         fmt::format("triptych view {}", request.suite));
  Session session(request, make_suites(request.suite, request.data_folders), interrupts,
                  [] { Window::wake(); });
  {
    Screen screen(*window, session);
    Loop(*window, session, screen, interrupts).run();
    if (request.json) std::fputs((core::json_text(screen.json(), 2) + "\n").c_str(), stdout);
  }
  window.reset();  // closes the window before the drivers shut down
  return core::ExitCode::pass;
}

core::ExitCode run(int argc, char** argv) {
  if (argc != 2) {
    throw core::InputError("triptych-view cannot be run directly; use `triptych view`");
  }
  const auto request = core::Json::parse(argv[1]).get<measure::ViewRequest>();
  measure::InterruptGuard interrupts;  // created before any thread is started
  return show(request, interrupts);
}

}  // namespace
}  // namespace triptych::view

int main(int argc, char** argv) {
  auto code = triptych::core::ExitCode::usage;
  try {
    code = triptych::view::run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(("triptych: " + triptych::core::printable(error.what()) + "\n").c_str(), stderr);
  }
  if (std::fflush(stdout) != 0) code = triptych::core::ExitCode::usage;
  // Exits without destroying objects. A thread may still be rendering a reference image, which
  // cannot be cancelled, and this thread must not use destroyed objects.
  std::_Exit(static_cast<int>(code));
}
