// Point clouds from survey files: xyz text and PLY.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"

namespace palace {

/// Points as the file has them: x east, y north, z up. Further columns are ignored. Errors name
/// file and line.
Result<std::vector<Eigen::Vector3d>> ReadPointFile(const std::filesystem::path& path);

}  // namespace palace
