// A camera model as a row of numbers: for messages, logs and hashes.
#pragma once

#include <optional>
#include <vector>

#include "engine/model/camera_models.h"

namespace palace {

/// Family (its index in CameraModel::lens), unit of length, pose known or not, then the fields of
/// the family in the order of its struct; matrices row by row. Exact to the bit.
std::vector<double> NumbersOf(const CameraModel& model);
/// The model of such a row. Nothing for rows of another length or family, numbers that are not
/// finite, and sizes, kinds and counts that are not whole or out of range: rows come from outside.
std::optional<CameraModel> CameraFromNumbers(const std::vector<double>& row);

}  // namespace palace
