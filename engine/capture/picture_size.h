// Pictures must be as large as the camera models they are measured with.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

/// "640 x 480 px"
std::string SizeText(int width, int height);

/// The error names the picture by `name`, both sizes and `remedy`.
Status CheckPictureSize(const ImageU8& picture, const PinholeCamera& camera,
                        const std::string& name, const std::string& remedy);

}  // namespace palace
