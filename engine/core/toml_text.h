// A check of TOML text before it is parsed. toml++ 3.3 runs into undefined behaviour at letters
// outside ASCII where a key or a bare value may stand; inside strings and comments any are fine.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace palace {

/// kInvalid with file and line for such a letter. Judges nothing else: what is no TOML passes.
Status CheckTomlLetters(std::string_view text, const std::string& name);

}  // namespace palace
