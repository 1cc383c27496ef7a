// Whether settings go together, and which of them nobody usually takes. Every value is inside its
// own limits here (SetSettingValue); that says nothing of two of them, nor of how far is wise.
#pragma once

#include <string>

#include "engine/model/settings/settings.h"

namespace palace {

/// Why nothing may be approved under these sizes, with figure and limit: a base circle that does
/// not hold the gear, or a clear radius that no vehicle takes. Empty: nothing speaks against them.
std::string WhyNotLandable(const Lander& lander);

/// The hazard limits and sizes of the lander outside their usual range, in the order of the table:
/// "Max roughness 100.0 cm (usually 2.0 cm to 30.0 cm), ..."; after the third "and 2 more". Empty:
/// none is.
std::string OutsideUsual(const Settings& settings);

}  // namespace palace
