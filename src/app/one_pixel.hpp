#pragma once
// `render --pixel X,Y`: a device's results for one pixel, next to those of the reference.

#include <filesystem>
#include <string_view>

#include "accuracy/truth_pair.hpp"
#include "core/exit_code.hpp"
#include "measure/contract/suite.hpp"
#include "measure/run/in_process.hpp"

namespace triptych::app {

// Throws core::InputError unless the text is "X,Y".
[[nodiscard]] measure::PixelPlace parse_pixel(std::string_view text);

// Prints the history, and writes all of it to pixel.txt in the folder. ExitCode::regression if an
// operation differs from the reference. Throws NotSupported if the suite cannot report the pixel.
[[nodiscard]] core::ExitCode show_pixel(measure::SuiteWithTruth& suite,
                                        const measure::FrameInProcess& drawn,
                                        const accuracy::TruthPair& truth,
                                        const std::filesystem::path& out);

}  // namespace triptych::app
