// Which view to take next (declared in calibration_quality.h).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/calibration/calibration_quality.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr int kZones = 3;               // a picture in thirds, both ways
constexpr double kSparseZone = 10;      // points in a zone that count as few
constexpr double kTilted_rad = 0.26;    // 15 degrees
constexpr double kDistanceRatio = 1.4;  // farthest over nearest board
constexpr int kEnoughViews = 10;

const std::array<const char*, 9> kZoneNames = {
    "upper left corner", "upper edge",        "upper right corner", "left edge",         "middle",
    "right edge",        "lower left corner", "lower edge",         "lower right corner"};

/// A third by a third of the picture, as the maps of the report show it: the sum of its cells'
/// points, and its least certain cell.
struct Zone {
  int side = 0;
  int index = 0;
  double points = 0;
  int cells = 0;
  int empty_cells = 0;
  double sigma_px = 0;
  int row = 0;  ///< of the least certain cell
  int column = 0;
};

std::array<Zone, kZones * kZones> ZonesOf(const Calibration& calibration, int side) {
  const GridF coverage = CoverageMap(calibration, side, kMapRows, kMapColumns);
  const GridF sigma = UncertaintyMap(calibration, side, kMapRows, kMapColumns);
  std::array<Zone, kZones * kZones> zones;
  for (int row = 0; row < kMapRows; ++row) {
    for (int column = 0; column < kMapColumns; ++column) {
      const int index = row * kZones / kMapRows * kZones + column * kZones / kMapColumns;
      Zone& zone = zones[static_cast<std::size_t>(index)];
      zone.side = side;
      zone.index = index;
      zone.points += coverage.at(row, column);
      ++zone.cells;
      zone.empty_cells += coverage.at(row, column) == 0 ? 1 : 0;
      if (sigma.at(row, column) > zone.sigma_px) {
        zone.sigma_px = sigma.at(row, column);
        zone.row = row;
        zone.column = column;
      }
    }
  }
  return zones;
}

/// The zone that most wants points: fewest where any is sparse, else the least certain one.
Zone WorstZone(const Calibration& calibration) {
  Zone sparse, uncertain;
  sparse.points = 1e9;
  for (const int side : {0, 1}) {
    for (const Zone& zone : ZonesOf(calibration, side)) {
      sparse = zone.points < sparse.points ? zone : sparse;
      uncertain = zone.sigma_px > uncertain.sigma_px ? zone : uncertain;
    }
  }
  // Of several empty zones the least certain one.
  if (uncertain.points < kSparseZone || sparse.points >= kSparseZone) {
    return uncertain;
  }
  return sparse;
}

/// How far the boards lean each way: their normals' largest components against the picture.
struct Leans {
  double left = 0, right = 0, up = 0, down = 0;
};

Leans LeansOf(const Calibration& calibration) {
  Leans leans;
  for (const ViewResult& view : calibration.views) {
    const Eigen::Vector3d n = view.X_C0T.R.col(2);
    const double across = std::atan2(n.x(), n.z()), along = std::atan2(n.y(), n.z());
    leans.right = std::max(leans.right, across);
    leans.left = std::max(leans.left, -across);
    leans.down = std::max(leans.down, along);
    leans.up = std::max(leans.up, -along);
  }
  return leans;
}

/// z points into the board: a normal to the right means that the board's right side is nearer.
std::string LackingTilt(const Leans& leans) {
  const std::array<std::pair<double, const char*>, 4> ways = {
      {{leans.right, "its right side nearer to the cameras than its left"},
       {leans.left, "its left side nearer to the cameras than its right"},
       {leans.down, "its lower edge nearer to the cameras than its upper"},
       {leans.up, "its upper edge nearer to the cameras than its lower"}}};
  const auto least = *std::min_element(ways.begin(), ways.end());
  return least.first < kTilted_rad ? least.second : "";
}

std::string PlaceText(const Zone& zone) {
  return std::string(kZoneNames[static_cast<std::size_t>(zone.index)]) + " of the " +
         (zone.side == 0 ? "left" : "right") + " picture";
}

std::string CellText(const Calibration& calibration, const Zone& zone) {
  char text[96];
  std::snprintf(text, sizeof text, "%.3f px 1 sigma round column %.0f, row %.0f", zone.sigma_px,
                (zone.column + 0.5) * calibration.width / kMapColumns - 0.5,
                (zone.row + 0.5) * calibration.height / kMapRows - 0.5);
  return text;
}

}  // namespace

std::string NextView(const Calibration& calibration) {
  const Zone zone = WorstZone(calibration);
  const std::string tilt = LackingTilt(LeansOf(calibration));
  double nearest = calibration.views[0].distance_m, farthest = nearest;
  for (const ViewResult& view : calibration.views) {
    nearest = std::min(nearest, view.distance_m);
    farthest = std::max(farthest, view.distance_m);
  }
  const bool flat_depth = farthest < kDistanceRatio * nearest;
  const bool few = static_cast<int>(calibration.views.size()) < kEnoughViews;
  if (zone.points >= kSparseZone && tilt.empty() && !flat_depth && !few) {
    return "Nothing is lacking. The least certain place is in the " + PlaceText(zone) + ", " +
           CellText(calibration, zone) + ".";
  }
  char points[96];
  std::snprintf(points, sizeof points, "%.0f points in that ninth, %d of its %d cells empty; ",
                zone.points, zone.empty_cells, zone.cells);
  std::string text = "Next view: hold the board in the " + PlaceText(zone) + " (" + points +
                     CellText(calibration, zone) + ")";
  text += tilt.empty() ? ", tilted by 20 to 45 degrees" : ", tilted by 30 degrees with " + tilt;
  if (flat_depth) {
    char depth[96];
    std::snprintf(depth, sizeof depth, ", at %.1f m or %.1f m (all views are near %.1f m)",
                  0.6 * nearest, 1.6 * farthest, (nearest + farthest) / 2);
    text += depth;
  }
  return text + ".";
}

}  // namespace palace
