#include "engine/calibration/chessboard_corners.h"

#include <algorithm>
#include <limits>
#include <string>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/calibration/chessboard_extent.h"
#include "engine/camera/grey_view.h"

namespace palace {
namespace {

constexpr int kMostHalfWindow_px = 11;
constexpr int kLeastHalfWindow_px = 2;
// Half window over the distance to the nearest other corner. A window that reaches into the next
// corner's edges is pulled there; on photographed boards that begins at 0.4.
constexpr double kWindowPerSquare = 0.3;

/// Distance of the nearest neighbour on the grid, diagonal ones included.
double NearestCorner(const std::vector<cv::Point2f>& corners, int columns, int rows, int column,
                     int row) {
  const auto at = [&](int c, int r) { return corners[static_cast<std::size_t>(r * columns + c)]; };
  double least = std::numeric_limits<double>::infinity();
  for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
    for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
      if (c != column || r != row) {
        least = std::min(least, cv::norm(at(c, r) - at(column, row)));
      }
    }
  }
  return least;
}

/// Each corner in a window of its own size: a slanted board has small squares at its far end.
void RefineCorners(const cv::Mat& grey, int columns, int rows, std::vector<cv::Point2f>& corners) {
  const std::vector<cv::Point2f> found = corners;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int half = std::clamp(
          static_cast<int>(kWindowPerSquare * NearestCorner(found, columns, rows, column, row)),
          kLeastHalfWindow_px, kMostHalfWindow_px);
      const auto at = static_cast<std::size_t>(row * columns + column);
      std::vector<cv::Point2f> one = {found[at]};
      cv::cornerSubPix(
          grey, one, {half, half}, {-1, -1},
          cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4));
      corners[at] = one[0];
    }
  }
}

std::string GridText(int a, int b) {
  return std::to_string(std::max(a, b)) + " x " + std::to_string(std::min(a, b));
}

/// The largest chessboard in the picture, whatever its size; 0 x 0 without any. Fast, and misses
/// rows at a slant.
cv::Size LargestBoard(const cv::Mat& grey) {
  // Only the count is wanted: a small picture does, and the search is slow.
  constexpr double kSearchSide_px = 400;
  const double scale = std::min(1.0, kSearchSide_px / std::max(grey.cols, grey.rows));
  cv::Mat small, corners, meta;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  const cv::Size least(3, 3);
  if (!cv::findChessboardCornersSB(small, least, corners,
                                   cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE, meta)) {
    return {0, 0};
  }
  return meta.size();
}

Error WrongSize(const std::string& seen, int columns, int rows) {
  return InvalidError(seen + ", the target has " + std::to_string(columns) + " x " +
                      std::to_string(rows));
}

Error NotFound(const cv::Size& largest, int columns, int rows) {
  return WrongSize(largest.empty() ? "no chessboard found"
                                   : "found " + GridText(largest.width, largest.height) +
                                         " inner corners at most",
                   columns, rows);
}

void MakeRightHanded(std::vector<Eigen::Vector2d>& corners, int columns, int rows) {
  const auto at = [&](int c, int r) -> Eigen::Vector2d& {
    return corners[static_cast<std::size_t>(r * columns + c)];
  };
  const Eigen::Vector2d x = at(columns - 1, 0) - at(0, 0), y = at(0, rows - 1) - at(0, 0);
  if (x.x() * y.y() - x.y() * y.x() < 0) {
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns / 2; ++c) {
        std::swap(at(c, r), at(columns - 1 - c, r));
      }
    }
  }
}

}  // namespace

Result<std::vector<Eigen::Vector2d>> FindChessboardCorners(const ImageU8& picture, int columns,
                                                           int rows) {
  const cv::Mat grey = GreyView(picture);
  const cv::Size size(columns, rows);
  std::vector<cv::Point2f> found;
  try {
    // The search takes seconds where there is no board (dots, foliage), so two quick looks that
    // fail on different pictures must both find nothing before it is spared.
    if (!cv::checkChessboard(grey, size)) {
      const cv::Size largest = LargestBoard(grey);
      if (GridText(largest.width, largest.height) != GridText(columns, rows)) {
        return NotFound(largest, columns, rows);
      }
    }
    const bool seen = cv::findChessboardCorners(
        grey, size, found, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE);
    if (!seen || static_cast<int>(found.size()) != columns * rows) {
      return NotFound(LargestBoard(grey), columns, rows);
    }
    RefineCorners(grey, columns, rows, found);
  } catch (const cv::Exception& error) {
    return InvalidError("the chessboard search failed: " + std::string(error.err));
  }
  std::vector<Eigen::Vector2d> corners;
  for (const cv::Point2f& corner : found) {
    corners.emplace_back(corner.x, corner.y);
  }
  MakeRightHanded(corners, columns, rows);
  const ChessboardExtent whole = ExtentOfChessboard(picture, corners, columns, rows);
  if (whole.columns != columns || whole.rows != rows) {
    return WrongSize("found " + GridText(whole.columns, whole.rows) + " inner corners", columns,
                     rows);
  }
  return corners;
}

}  // namespace palace
