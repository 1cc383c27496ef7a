// Pictures must be as large as the camera models they are measured with.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

/// The error names the picture by `name`, both sizes and `remedy`.
Status CheckPictureSize(const ImageU8& picture, const PinholeCamera& camera,
                        const std::string& name, const std::string& remedy);

}  // namespace palace
