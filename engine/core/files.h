// Files read whole, and files written whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/result.h"

namespace palace {

/// Whether the path names a file on disk. Refuses missing files, folders, and pipes and devices,
/// which may never end or never begin, naming the path.
Status CheckRegularFile(const std::filesystem::path& path);

/// The file's text, or its bytes. Refuses missing files, folders, pipes and devices, and files over
/// `limit` bytes, naming the path.
Result<std::string> ReadTextFile(const std::filesystem::path& path, std::size_t limit = 1 << 20);

/// Writes through a neighbour file, so that a full disk leaves no half file under the name.
Status WriteTextFile(const std::filesystem::path& path, const std::string& text);

/// Of this program's files of a user: palace in $XDG_CONFIG_HOME, or in ~/.config where that is not
/// set or no absolute path (XDG Base Directory Specification); empty without either.
std::filesystem::path ConfigFolder();

/// With those above it. A folder that is there already is as good.
Status MakeFolder(const std::filesystem::path& folder);

}  // namespace palace
