#pragma once
#include <imgui.h>

namespace triptych::view::colours {

inline const ImVec4 quiet{0.62F, 0.64F, 0.66F, 1};
// Correct values are blue and wrong values are orange, because people who cannot distinguish red
// from green can distinguish these two colours.
inline const ImVec4 right{0.55F, 0.80F, 1.0F, 1};
inline const ImVec4 wrong{1.0F, 0.72F, 0.30F, 1};
inline constexpr ImU32 frame = IM_COL32(70, 74, 78, 255);

}  // namespace triptych::view::colours
