// Reading a whole small text file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/result.h"

namespace palace {

/// The file's text. Refuses missing files, folders, and files over `limit` bytes, naming the path.
Result<std::string> ReadTextFile(const std::filesystem::path& path, std::size_t limit = 1 << 20);

}  // namespace palace
