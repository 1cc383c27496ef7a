// Point clouds from survey files: xyz text and PLY.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"

namespace palace {

/// Points as the file has them: x east, y north, z up, by the names of the line above the first row
/// (column_names.h), else the first three columns. Further columns are ignored. Errors name file
/// and line.
Result<std::vector<Eigen::Vector3d>> ReadPointFile(const std::filesystem::path& path);

/// A point with what a survey's editor says it is.
struct LabelledPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  bool ground = false;
};

/// Text of x y z label: label 1 is ground, any other (0 in the ISPRS filter test) an object.
Result<std::vector<LabelledPoint>> ReadLabelledPoints(const std::filesystem::path& path);

}  // namespace palace
