#include "engine/world/truth_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "engine/world/world_mesh.h"

namespace palace {
namespace {

using Eigen::Vector3d;

/// A convex polygon while it is cut: x along rows from the northern edge, y along columns, both in
/// cells, h in metres. A triangle cut by four lines has at most seven corners.
struct CutPolygon {
  std::array<Vector3d, 8> corners;
  std::size_t count = 0;
  void Add(const Vector3d& corner) { corners[count++] = corner; }
};

/// What lies on the side where sign * (coordinate - limit) >= 0 (Sutherland and Hodgman 1974).
CutPolygon Cut(const CutPolygon& polygon, int axis, double limit, double sign) {
  CutPolygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vector3d& a = polygon.corners[i];
    const Vector3d& b = polygon.corners[(i + 1) % polygon.count];
    const double in_a = sign * (a[axis] - limit), in_b = sign * (b[axis] - limit);
    if (in_a >= 0) {
      kept.Add(a);
    }
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0)) {
      kept.Add(a + in_a / (in_a - in_b) * (b - a));
    }
  }
  return kept;
}

struct Span {
  double low, high;
};
Span SpanOf(const CutPolygon& polygon, int axis) {
  Span span{polygon.corners[0][axis], polygon.corners[0][axis]};
  for (std::size_t i = 1; i < polygon.count; ++i) {
    span.low = std::min(span.low, polygon.corners[i][axis]);
    span.high = std::max(span.high, polygon.corners[i][axis]);
  }
  return span;
}

/// Visits every cell a triangle touches with its highest point there.
template <typename Visit>
void OverTriangle(const GridGeometry& geometry, const CutPolygon& triangle, Visit&& visit) {
  const Span rows = SpanOf(triangle, 0);
  const int first = std::max(0, static_cast<int>(std::floor(rows.low)));
  const int last = std::min(geometry.rows - 1, static_cast<int>(std::floor(rows.high)));
  for (int row = first; row <= last; ++row) {
    const CutPolygon band = Cut(Cut(triangle, 0, row, 1), 0, row + 1, -1);
    if (band.count == 0) {
      continue;
    }
    const Span cols = SpanOf(band, 1);
    const int from = std::max(0, static_cast<int>(std::floor(cols.low)));
    const int to = std::min(geometry.cols - 1, static_cast<int>(std::floor(cols.high)));
    for (int col = from; col <= to; ++col) {
      const CutPolygon part = Cut(Cut(band, 1, col, 1), 1, col + 1, -1);
      if (part.count > 0) {
        visit(Cell{row, col}, SpanOf(part, 2).high);
      }
    }
  }
}

void RasteriseGround(const Ground& ground, GroundTruth& truth) {
  const GridGeometry& geometry = truth.geometry;
  cv::parallel_for_(cv::Range(0, geometry.rows), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      for (int col = 0; col < geometry.cols; ++col) {
        truth.height_m.at(row, col) =
            static_cast<float>(ground.Height(geometry.NorthOfRow(row), geometry.EastOfCol(col)));
      }
    }
  });
}

/// Marks the water, patch by patch: a later patch covers an earlier one.
void RasteriseWater(const Ground& ground, GroundTruth& truth) {
  if (!ground.material) {
    return;
  }
  const GridGeometry& geometry = truth.geometry;
  if (ground.material->texture == GroundTexture::kWater) {
    truth.flags = Grid<std::uint8_t>(geometry.rows, geometry.cols, kWaterThere);
  }
  for (const GroundPatch& patch : ground.patches) {
    const std::uint8_t flag = patch.material.texture == GroundTexture::kWater ? kWaterThere : 0;
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : patch.outline_m) {
      box.extend(corner);
    }
    for (int row = 0; row < geometry.rows; ++row) {
      const double north = geometry.NorthOfRow(row);
      if (north < box.min().x() || north > box.max().x()) {
        continue;
      }
      const double first = (box.min().y() - geometry.east_min_m) / geometry.cell_m;
      const double last = (box.max().y() - geometry.east_min_m) / geometry.cell_m;
      const int to = static_cast<int>(std::min(last, geometry.cols - 1.0));
      for (int col = static_cast<int>(std::max(first, 0.0)); col <= to; ++col) {
        if (truth.flags.at(row, col) != flag && patch.Contains(north, geometry.EastOfCol(col))) {
          truth.flags.at(row, col) = flag;
        }
      }
    }
  }
}

void RasteriseSolid(const Solid& solid, const std::vector<MeshVertex>& vertices,
                    GroundTruth& truth) {
  const GridGeometry& geometry = truth.geometry;
  const auto flag = static_cast<std::uint8_t>(kThingThere | (solid.soft ? kSoftThere : 0) |
                                              (solid.v_WO.isZero() ? 0 : kMovingThere));
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
    CutPolygon triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d p = vertices[i + k].position_W.cast<double>();
      triangle.Add({(geometry.north_max_m() - p.x()) / geometry.cell_m,
                    (p.y() - geometry.east_min_m) / geometry.cell_m, -p.z()});
    }
    OverTriangle(geometry, triangle, [&](Cell cell, double height_m) {
      float& top = truth.height_m.at(cell);
      if (height_m > static_cast<double>(top)) {
        top = static_cast<float>(height_m);
        truth.flags.at(cell) = flag;
      }
    });
  }
}

}  // namespace

GroundTruth RasteriseWorld(const World& world, const TruthArea& area, double time_s) {
  GroundTruth truth;
  truth.geometry = {
      .rows = static_cast<int>(std::lround((area.north_max_m - area.north_min_m) / area.cell_m)),
      .cols = static_cast<int>(std::lround((area.east_max_m - area.east_min_m) / area.cell_m)),
      .cell_m = area.cell_m,
      .north_min_m = area.north_min_m,
      .east_min_m = area.east_min_m};
  truth.height_m = GridF(truth.geometry.rows, truth.geometry.cols);
  truth.flags = Grid<std::uint8_t>(truth.geometry.rows, truth.geometry.cols);
  RasteriseGround(world.ground, truth);
  RasteriseWater(world.ground, truth);
  World lone;  // one solid at a time over the same plane, so that a triangle's owner is known
  lone.ground.rise_north = world.ground.rise_north;
  lone.ground.rise_east = world.ground.rise_east;
  for (const Solid& solid : world.solids) {
    lone.solids = {solid};
    lone.solids[0].X_WO.p += time_s * solid.v_WO;
    RasteriseSolid(solid, SolidTriangles(lone, 0.5F), truth);
  }
  return truth;
}

}  // namespace palace
