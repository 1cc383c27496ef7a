// Elevation map of a survey's point cloud.
//
// A cell keeps the highest thing a survey met in it: the mean of the points within 0.3 m of its
// highest one. Flat ground averages its noise; a branch, a kerb or a car over ground is not
// averaged down to a height where nothing is. The cell's variance is that of those points about
// their mean, beyond what ordinary ground slopes inside a cell, shared among them; at least (1
// mm)^2, because a cloud states no noise of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"
#include "engine/model/elevation_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Points of a survey, X east, Y north, Z up, metres; points that are not finite or not on Earth
/// are left out, with a warning. The map covers all others: cells of cell_m where given, else of
/// the settings' size, enlarged with a warning until the map fits, most cells hold a point, and
/// those that chance left empty leave room for a lander. Degrees, points far from all others and
/// such gaps are told in warnings. Thesis mode, and bounds that are given, keep the thesis's grid
/// and plain means. No more than GridSettings::kMostCells a side.
Result<ElevationMap> MapOfCloud(const std::vector<Eigen::Vector3d>& survey,
                                std::optional<double> cell_m, SladSettings slad,
                                std::vector<std::string>& warnings);

/// Whether land lies that high anywhere. Files without a no-data tag mark gaps by heights like
/// -9999 or 1e38, which would be the flattest ground of all.
bool IsOnEarth(double height_m);

}  // namespace palace
