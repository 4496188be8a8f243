#pragma once
// Runs whose times differ by known factors.

#include <fmt/format.h>

#include "fixture.hpp"

namespace triptych::judge {

class TimingGateTest : public JudgeTest {
 protected:
  static Tweak times(double factor, const std::string& configuration = {}) {
    return [=](record::Record& record, core::Image&) {
      if (!configuration.empty() && record.configuration != configuration) return;
      for (double& ns : record.wall_ns) ns *= factor;
    };
  }

  // Its device times are a fifth of the wall's, so that mixing the two would show.
  static Tweak by_the_device(const Tweak& times) {
    return [=](record::Record& record, core::Image& image) {
      times(record, image);
      record.device_ns = record.wall_ns;
      for (double& ns : record.device_ns) ns /= 5;
      record.device_clock_trusted = true;
    };
  }

  // Eight runs, each with its anchors, of which every second is of a slower day.
  void accept_history_with_anchors(double slow_day = 1) {
    for (int i = 1; i <= 8; ++i) {
      const double day = i % 2 == 0 ? slow_day : 1.0;
      add_anchors(fmt::format("r{}-anchors", i), day);
      accept_anchors(fmt::format("r{}-anchors", i));
      add_run(fmt::format("r{}-run", i), times(day));
      (void)accept_run(fmt::format("r{}-run", i));
    }
  }
};

}  // namespace triptych::judge
