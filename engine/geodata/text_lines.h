// Lines of text files: their numbers, and how messages name them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace palace {

/// Up to `most` decimal numbers parted by blanks, commas or semicolons; stops at the first other
/// word, such as 0x1F, which surveys hold by mistake only.
/// Returns how many there are.
std::size_t ParseNumbers(const std::string& line, std::size_t most, std::vector<double>& numbers);

/// The start of a line, fit for a message: quoted, at most 40 characters, others than ASCII as "?".
std::string QuotedLine(const std::string& line);

/// "cloud.xyz:17: what"
Error ErrorAtLine(const std::filesystem::path& path, std::size_t line, const std::string& what);

}  // namespace palace
