// Pictures on disk as 8-bit grey.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/model/image.h"

namespace palace {

/// Reads PNG, JPEG, TIFF or PGM. Errors name the file and what to do: missing, no picture, or a PNG
/// or JPEG that ends before the picture does (half of one would be grey ground that is not there).
Result<ImageU8> ReadGreyPicture(const std::filesystem::path& path);
/// In the format of the name's extension; whole or not at all. Errors name the file.
Status WriteGreyPicture(const std::filesystem::path& path, const ImageU8& image);

}  // namespace palace
