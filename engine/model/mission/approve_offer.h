// Whether approve is offered on a screen: what is approved must be what is seen.
#pragma once

#include <string>

namespace palace {

/// Figures on the screen are older than the engine's by this much at most.
inline constexpr double kScreenOld_s = 0.5;

/// Why nothing may be approved on a screen that shows a snapshot `silent_s` after it was published:
/// guards pass on newer figures than a person sees. Empty: it may.
std::string WhyScreenOld(double silent_s);

}  // namespace palace
