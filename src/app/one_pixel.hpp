#pragma once
// `render --pixel X,Y`: shows a device's results for one pixel next to the reference renderer's
// results.

#include <filesystem>
#include <string_view>

#include "accuracy/truth_pair.hpp"
#include "core/exit_code.hpp"
#include "measure/contract/suite.hpp"
#include "measure/run/in_process.hpp"

namespace triptych::app {

// Parses "X,Y". Throws core::InputError if `text` has a different format.
[[nodiscard]] measure::PixelPlace parse_pixel(std::string_view text);

// Prints the pixel's history (shortened if it is long), and writes the complete history to
// pixel.txt in the folder `out`. Returns ExitCode::regression if a sample of the volume or a
// visible surface differs from the reference renderer's. Throws NotSupported if the suite cannot
// trace the pixel.
[[nodiscard]] core::ExitCode print_pixel(measure::SuiteWithTruth& suite,
                                         const measure::FrameInProcess& drawn,
                                         const accuracy::TruthPair& truth,
                                         const std::filesystem::path& out);

}  // namespace triptych::app
