#pragma once
#include <string>

#include "backends/gl/api.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// If a dump was requested (render --dump), writes frame.c to the dump folder. This program draws
// the frame with a compute shader and prints one of its pixels.
void dump_standalone(const measure::VolumeWork& work, const std::string& source, GLuint groups_x,
                     GLuint groups_y);

}  // namespace triptych::gl_backend
