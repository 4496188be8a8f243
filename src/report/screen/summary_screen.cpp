#include "report/screen/summary_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/quoting.hpp"
#include "core/text.hpp"
#include "record/short_name.hpp"
#include "report/finding_command.hpp"
#include "report/overview.hpp"
#include "report/words/cause.hpp"
#include "report/words/command_note.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

using judge::Verdict;

constexpr std::size_t max_lines = 40;
constexpr std::size_t min_width = 40;
constexpr std::size_t max_command_width = 600;
constexpr std::size_t max_message_lines = 4;
constexpr std::size_t max_meaning_lines = 2;
constexpr std::size_t max_waived = 3;
constexpr std::size_t max_circumstances = 5;
constexpr std::size_t max_circumstance_lines = 2;      // for each note
constexpr std::size_t max_lines_of_circumstances = 8;  // for all notes
constexpr std::size_t max_drivers = 3;

std::string_view colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::regression:
      return "\x1b[1;31m";
    case Verdict::cannot_judge:
    case Verdict::waived:
      return "\x1b[33m";
    case Verdict::pass:
    case Verdict::improved:
      return "\x1b[32m";
    default:
      return "\x1b[2m";
  }
}

Verdict verdict_of(core::ExitCode code) {
  if (code == core::ExitCode::pass) return Verdict::pass;
  return code == core::ExitCode::regression ? Verdict::regression : Verdict::cannot_judge;
}

std::string time_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60);
}

class Screen {
 public:
  explicit Screen(const ScreenOptions& options)
      : options_(options), width_(std::max(options.width, min_width)) {}

  std::string text(const Overview& all, double seconds, std::span<const std::string> files) {
    head(all, seconds);
    for (const CheckRow& row : all.rows) {
      const std::string pad(11 - std::min<std::size_t>(11, core::character_count(row.verdict)),
                            ' ');
      add(fmt::format("  {:<12}{}{}{}", row.label, coloured(row.verdict, row.worst), pad,
                      core::printable(row.sentence, width_ - 25)));
    }
    add("");
    circumstances(all);
    waived(all);
    causes(all, files);
    list(files);
    const std::vector<std::string> next = words::next_steps(all, options_.store_option);
    for (const std::string& each : next) add("  " + core::printable(each));
    if (!next.empty()) add("");
    std::vector<std::string> meaning;
    append_wrapped(
        meaning, core::printable("exit " + words::meaning_of(all), max_meaning_lines * width_), "");
    meaning.front().erase(0, 2);
    for (const std::string& line : meaning) add(line);
    return text_;
  }

 private:
  void add(std::string_view line) {
    text_ += line;
    text_ += '\n';
    ++lines_;
  }
  [[nodiscard]] std::string coloured(std::string_view text, Verdict verdict) const {
    if (!options_.colours) return std::string(text);
    return std::string(colour_of(verdict)) + std::string(text) + "\x1b[0m";
  }

  void head(const Overview& all, double seconds) {
    const std::string left =
        fmt::format("Triptych   {} {} · {}{}", all.devices, all.devices == 1 ? "device" : "devices",
                    time_text(seconds), all.part ? " · only part of the plans was judged" : "");
    const std::string right =
        fmt::format("{} ({})", words::verdict_word(all.code), static_cast<int>(all.code));
    const std::size_t used = core::character_count(left) + core::character_count(right);
    add(left + std::string(used + 3 < width_ ? width_ - used : 3, ' ') +
        coloured(right, verdict_of(all.code)));
    drivers(all);
    if (!all.open.empty()) add(worst_of(all.open.front()));
    add("");
  }

  // Adds a line for each driver version that was tested.
  void drivers(const Overview& all) {
    const bool fits = all.drivers.size() <= max_drivers;
    const std::size_t shown = fits ? all.drivers.size() : max_drivers - 1;
    for (std::size_t i = 0; i < shown; ++i) {
      const TestedDriver& each = all.drivers[i];
      const std::string line = fmt::format("{}: {}", each.driver, fmt::join(each.devices, ", "));
      add("  " + core::printable(line, width_ - 2));
    }
    if (!fits) add(fmt::format("  {} more driver versions", all.drivers.size() - shown));
  }

  // Describes a cause in one line: "✗ image on gl:x: crashed: …".
  [[nodiscard]] std::string worst_of(const Cause& cause) const {
    const judge::Finding& first = *cause.group.first;
    const judge::Finding& worst = cause.group.worst == nullptr ? first : *cause.group.worst;
    return fmt::format(
        "  {} {}", sign_of(first),
        core::printable(
            fmt::format("{} {} {}: {}", judge::topic_of(first), first.device.empty() ? "of" : "on",
                        first.device.empty() ? cause.result->plan : worst.device,
                        words::text_of(worst)),
            width_ - 4));
  }

  [[nodiscard]] std::string sign_of(const judge::Finding& finding) const {
    return coloured(finding.verdict == Verdict::regression ? "✗" : "?", finding.verdict);
  }

  // Adds the circumstances (report/circumstances.hpp). They are shown even for a pass.
  void circumstances(const Overview& all) {
    std::size_t shown = 0;
    std::size_t used = 0;
    for (const std::string& each : all.circumstances) {
      std::vector<std::string> lines;
      append_wrapped(lines, core::printable(each, max_circumstance_lines * (width_ - 6)), "");
      used += lines.size();
      if (shown == max_circumstances || used > max_lines_of_circumstances) break;
      lines.front().replace(0, 3, "  !");
      for (const std::string& line : lines) add(line);
      ++shown;
    }
    if (shown < all.circumstances.size()) {
      add(fmt::format("  ! {} more notes are in the HTML report (--out)",
                      all.circumstances.size() - shown));
    }
    if (shown > 0) add("");
  }

  // Adds a line for each waived cause (a known failure that is excused until a given date), because
  // readers must know which failures a pass excuses.
  void waived(const Overview& all) {
    std::size_t shown = 0;
    for (const Cause& cause : all.remarks) {
      if (cause.group.first->verdict != Verdict::waived || ++shown > max_waived) continue;
      add(core::printable("  – " + words::waived_text(cause), width_));
    }
    if (shown > max_waived) add(fmt::format("  – {} more causes are waived", shown - max_waived));
    if (shown > 0) add("");
  }

  // Adds as many causes as fit on the screen. If a cause does not fit, only its first line is
  // added.
  void causes(const Overview& all, std::span<const std::string> files) {
    // The number of lines that follow the causes.
    const std::size_t below = files.empty() ? 6 : 8;
    const auto fits = [&](std::size_t lines) { return lines_ + lines + 2 + below <= max_lines; };
    std::size_t shown = 0;
    bool complete = true;
    for (const Cause& cause : all.open) {
      std::vector<std::string> lines = lines_of(cause);
      if (!complete || !fits(lines.size())) {
        complete = false;
        lines.resize(1);
      }
      if (!fits(lines.size())) break;
      for (const std::string& line : lines) add(line);
      if (complete) add("");
      ++shown;
    }
    if (complete) return;
    const std::size_t more = all.open.size() - shown;
    const std::string omitted =
        more == 0 ? "details" : fmt::format("{} more {}", more, more == 1 ? "cause" : "causes");
    add(fmt::format("  {}: {}", omitted,
                    files.empty() ? "use --out FOLDER to write them to files"
                                  : "in the HTML report and in the other files below"));
  }

  [[nodiscard]] std::vector<std::string> lines_of(const Cause& cause) const {
    const judge::Finding& first = *cause.group.first;
    std::vector<std::string> lines{fmt::format(
        "  {} {}", sign_of(first),
        core::printable(fmt::format("{}: {}", judge::topic_of(first), words::location(cause)),
                        width_ - 4))};
    append_wrapped(lines, message_of(cause), "");
    const std::string command = command_of(first, *cause.result);
    // A command is never shortened, because that would turn it into a different command.
    if (core::character_count(command) > max_command_width) {
      lines.emplace_back(
          "    (the command is too long for a terminal; the HTML report contains it)");
    } else if (!command.empty()) {
      if (cause.group.configurations > 1 && !first.configuration.empty()) {
        append_wrapped(lines,
                       core::printable("reproduce the smallest configuration, " +
                                       record::short_name(first.configuration) + ":"),
                       "");
      }
      append_wrapped(lines, command, " \\");
      const std::string note = words::command_note(first, *cause.result);
      if (!note.empty()) append_wrapped(lines, core::printable("(" + note + ")"), "");
    }
    return lines;
  }

  // Shortens a long description of the finding, but never the words that follow it: the advice, and
  // whether the driver is at fault.
  [[nodiscard]] std::string message_of(const Cause& cause) const {
    std::string rest;
    for (const std::string& each :
         {words::advice(*cause.group.first), words::attribution(cause.group)}) {
      if (!each.empty()) rest += "; " + core::printable(each);
    }
    const std::size_t room = max_message_lines * (width_ - 6);
    const std::size_t left =
        room > 2 * core::character_count(rest) ? room - core::character_count(rest) : room / 2;
    return core::printable(words::found(cause), left) + rest;
  }

  // Breaks the text into lines at spaces. In a command (`end` is not empty), does not break within
  // quotation marks or between an option and its value. Appends `end` to every line except the
  // last.
  void append_wrapped(std::vector<std::string>& lines, std::string_view text,
                      std::string_view end) const {
    std::string line;
    bool quoted = false;
    std::string word;
    const auto flush_word = [&] {
      if (!line.empty() &&
          core::character_count(line) + 1 + core::character_count(word) + 4 + end.size() > width_) {
        lines.push_back("    " + line + std::string(end));
        line = end.empty() ? "" : "  ";
      }
      line += (line.empty() || line == "  " ? "" : " ") + word;
      word.clear();
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '\'' && !end.empty()) quoted = !quoted;
      const bool value_follows = !end.empty() && word.starts_with("--") &&
                                 word.find(' ') == std::string::npos && i + 1 < text.size() &&
                                 text[i + 1] != '-';
      if (c == ' ' && !quoted && !value_follows) {
        flush_word();
      } else {
        word += c;
      }
    }
    flush_word();
    lines.push_back("    " + line);
  }

  void list(std::span<const std::string> files) {
    if (files.empty()) return;
    std::string line;
    for (const std::string& file : files)
      line += (line.empty() ? "" : "   ") + core::printable(file);
    add("  " + core::printable(line, 3 * width_));
    add("");
  }

  const ScreenOptions& options_;
  std::size_t width_;
  std::string text_;
  std::size_t lines_ = 0;
};

}  // namespace

std::string summary_screen(std::span<const judge::GateResult> results, double seconds,
                           std::span<const std::string> files, const ScreenOptions& options) {
  return Screen(options).text(overview(results), seconds, files);
}

}  // namespace triptych::report
