#pragma once
// One frame drawn by this process itself, with nothing before it: what debuggers and tools that
// record the calls of an API need.

#include <span>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/suite.hpp"
#include "measure/plan/plan.hpp"
#include "measure/protocol/injected_fault.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct FrameInProcess {
  record::Record record;
  core::Image image;
  record::Device device;
};

// Draws the plan's one configuration: opens the device, prepares it, draws one frame and reads its
// image. Nothing is calibrated, counted or repeated. Where RenderDoc is loaded into the process,
// its capture holds the frame and nothing else; the file is named after `capture`. Throws as the
// device's functions do.
[[nodiscard]] FrameInProcess draw_in_process(const Backend& backend, std::string_view device_id,
                                             Suite& suite, const Plan& plan,
                                             std::span<const InjectedFault> faults,
                                             const std::string& capture);

}  // namespace triptych::measure
