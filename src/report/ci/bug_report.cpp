#include "report/ci/bug_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "report/ci/markdown.hpp"

namespace triptych::report {
namespace {

std::string row(std::string_view name, std::string_view value) {
  if (value.empty()) return {};
  return fmt::format("| {} | {} |\n", markdown_escaped(name), markdown_escaped(value));
}

std::string device_facts(const BugReport& report) {
  const record::Device& device = report.device;
  std::string text = "\n| | |\n|---|---|\n";
  text += row("device", device.name);
  text += row("driver", device.driver + " " + device.driver_version);
  text += row("API", device.api_version);
  text += row("CPU features", device.cpu_features);
  for (const auto& [name, value] : device.environment) text += row(name, value);
  for (const char* name : {"os", "kernel", "processor", "triptych"}) {
    if (const auto found = report.system.find(name); found != report.system.end()) {
      text += row(name, found->second);
    }
  }
  return text;
}

struct File {
  std::string_view name;
  std::string_view what;
};
constexpr std::array files{
    File{"frame.json", "camera, scene, transfer function and every factor"},
    File{"image.png",
         "the device's image (`image.exr`: the same image with linear, premultiplied floats)"},
    File{"sequence.txt", "the list of configurations to draw, for the option `--caselist`"},
    File{"truth.png",
         "the reference image, rendered in double precision (`truth.exr`: the same image with "
         "floats)"},
    File{
        "difference.png",
        "the error relative to the error bound of each pixel: black means no error, white means an "
        "error equal to the bound, and azure to cyan a larger error, on a logarithmic scale"},
    File{"dump",
         "everything that the driver receives: device code, options and buffers; for some "
         "techniques, also a C program that draws the frame; `compile.sh` compiles the device "
         "code"},
    File{"dump/pixel.txt",
         "the device's intermediate results for one wrong pixel; the first difference from the "
         "reference is marked"},
};

std::string list_of_files(const BugReport& report) {
  std::string text;
  for (const auto& [name, what] : files) {
    if (std::ranges::find(report.files, name) == report.files.end()) continue;
    text += fmt::format("- `{}`: {}\n", name, what);
  }
  return text;
}

std::string sequence(const BugReport& report) {
  std::string text = fmt::format(
      "\n## The configurations before the frame\n\nIf the frame is drawn alone, it does not fail. "
      "It fails if the same process has first drawn these configurations of {}:\n\n",
      markdown_escaped(report.plan));
  for (const std::string& name : report.before) {
    text += fmt::format("1. {}\n", markdown_escaped(name));
  }
  return text;
}

// Returns a sentence about the search for a simpler frame, or for a shorter sequence of
// configurations, that also fails: either there is none, or the search reached its maximum number
// of frames.
std::string_view search_result_text(const BugReport& report) {
  if (report.before.empty()) {
    return report.complete ? "If any factor is simplified further, the frame no longer fails in "
                             "this way.\n"
                           : "The search reached the maximum number of frames, so a simpler frame "
                             "may also fail.\n";
  }
  return report.complete
             ? "If any of these configurations is left out, the frame no longer fails in this "
               "way.\n"
             : "The search stopped after drawing the maximum number of frames, so a shorter list "
               "of configurations may also make the frame fail.\n";
}

}  // namespace

std::string text_of(const std::vector<BugReport::Change>& changes) {
  std::string text;
  for (const auto& [factor, from, to] : changes) {
    text += fmt::format("{}{} {} → {}", text.empty() ? "" : ", ", factor, from, to);
  }
  return text.empty() ? "nothing" : text;
}

std::string markdown(const BugReport& report) {
  std::string text = fmt::format("# {}{}\n\n{}\n", markdown_escaped(report.title),
                                 report.injected.empty() ? "" : " because of an injected fault",
                                 markdown_escaped(report.message));
  if (!report.injected.empty()) {
    text += fmt::format(
        "\nTriptych injected faults into this frame ({}), so the driver is not at fault.\n",
        markdown_escaped(fmt::format("{}", fmt::join(report.injected, ", "))));
  }
  text += device_facts(report);
  text += "\n## How to reproduce it\n" + fenced(report.command, "");
  text += "\nThe command exits with code 0 if nothing is wrong.\n\n## Files\n\n" +
          list_of_files(report);
  text += "\n## The frame\n\n| factor | level |\n|---|---|\n";
  for (const auto& [factor, level] : report.factors) text += row(factor, level);
  if (!report.before.empty()) text += sequence(report);
  text += fmt::format("\nThe search drew {} frames.", report.frames);
  if (report.before.empty()) {
    text += fmt::format(" It simplified: {}.", markdown_escaped(text_of(report.changes)));
  }
  text += fmt::format("\n{}", search_result_text(report));
  return text;
}

}  // namespace triptych::report
