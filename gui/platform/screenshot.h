// Screenshots: pictures of the screen as PNG files.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "gui/render/picture.h"

namespace palace {

/// Error naming the path when it cannot be written. Alpha is dropped: a screen is opaque.
Status SavePng(const ImageRgba& picture, const std::string& path);
Status SavePng(const ImageU8& picture, const std::string& path);

}  // namespace palace
