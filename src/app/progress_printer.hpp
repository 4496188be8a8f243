#pragma once
// Prints the progress of a measurement to a log or a terminal.

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/terminal.hpp"
#include "measure/run/runner.hpp"
#include "report/screen/progress_log.hpp"

namespace triptych::app {

class ProgressPrinter {
 public:
  // `planned` contains the names of the plans, and how many measurements each of them needs.
  explicit ProgressPrinter(bool verbose = false,
                           std::vector<std::pair<std::string, int>> planned = {})
      : log_({.width = terminal_width(), .verbose = verbose, .planned = std::move(planned)}) {}

  ~ProgressPrinter() { end(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void print(const measure::Progress& progress) {
    if (progress.loading) {
      if (!progress.loading->note.empty()) return show_note(*progress.loading);
      return write(log_.loading(progress.loading->what, progress.loading->share));
    }
    if (progress.record != nullptr) plan_ = progress.record->plan;
    write(log_.next({.plan = plan_,
                     .device = progress.device,
                     .done = progress.done,
                     .total = progress.total,
                     .left = progress.left,
                     .record = progress.record}));
  }
  // Prints the remaining lines and removes the bar. The destructor does the same, for exceptions.
  void end() {
    if (!std::exchange(ended_, true)) write(log_.end());
  }

 private:
  // The log has already escaped names and messages.
  static void write(const std::string& text) {
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  }

  report::ProgressLog log_;
  std::string plan_;
  bool ended_ = false;
};

}  // namespace triptych::app
