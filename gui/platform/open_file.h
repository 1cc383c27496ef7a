// Opens a file in the program that the desktop keeps for it.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace palace {

/// Starts xdg-open and waits for nothing. An error where there is no such program.
Status OpenFile(const std::string& path);

}  // namespace palace
