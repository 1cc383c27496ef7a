// Files written whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/result.h"

namespace palace {

/// Writes through a neighbour file, so that a full disk leaves no half file under the name.
Status WriteTextFile(const std::filesystem::path& path, const std::string& text);

/// With those above it. A folder that is there already is as good.
Status MakeFolder(const std::filesystem::path& folder);

}  // namespace palace
