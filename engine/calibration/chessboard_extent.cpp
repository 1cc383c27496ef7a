#include "engine/calibration/chessboard_extent.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <opencv2/calib3d.hpp>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr int kNearest = 4;             // rows of corners that predict what lies beyond them
constexpr int kMostBeyond = 32;         // a board is not followed farther
constexpr int kLeastSquares = 4;        // fewer alternate by chance
constexpr double kLeastContrast = 0.5;  // of the squares inside
constexpr double kReach = 0.2;          // half the sampled part of a square, in squares
// Outwards the near part of a square is sampled: boards are often cut through their outermost ones.
constexpr double kOut = 0.25;
constexpr double kOutReach = 0.1;

/// One side of the grid in coordinates of its own: `along` the side, `out` away from it, with 0 at
/// the outermost corners. Squares are numbered by their corner of least coordinates.
struct Side {
  int length = 0;  ///< corners along the side
  cv::Matx33d picture_from_side;
};

/// corner(along, inward) for inward = 0 at the side.
Side SideOf(const std::function<Eigen::Vector2d(int, int)>& corner, int length, int depth) {
  std::vector<cv::Point2d> from, to;
  for (int along = 0; along < length; ++along) {
    for (int inward = 0; inward < std::min(depth, kNearest); ++inward) {
      const Eigen::Vector2d at = corner(along, inward);
      from.emplace_back(along, -inward);
      to.emplace_back(at.x(), at.y());
    }
  }
  Side side;
  side.length = length;
  const cv::Mat homography = cv::findHomography(from, to);
  side.picture_from_side =
      homography.empty() ? cv::Matx33d::zeros() : cv::Matx33d(homography.ptr<double>());
  return side;
}

/// Mean grey of the near middle of the square at (along, out); nothing outside the picture.
std::optional<double> GreyOf(const ImageU8& picture, const Side& side, int along, int out) {
  double sum = 0;
  for (const double u : {-kReach, 0.0, kReach}) {
    for (const double v : {-kOutReach, 0.0, kOutReach}) {
      const cv::Vec3d at = side.picture_from_side * cv::Vec3d(along + 0.5 + u, out + kOut + v, 1.0);
      const double x = std::round(at[0] / at[2]), y = std::round(at[1] / at[2]);
      if (!(at[2] > 0 && x >= 0 && y >= 0 && x < picture.width() && y < picture.height())) {
        return std::nullopt;
      }
      sum += picture.at(static_cast<int>(x), static_cast<int>(y));
    }
  }
  return sum / 9;
}

/// Mean grey of the even squares less that of the odd ones in the row `out` along the side; nothing
/// when too few are in the picture. The sign tells which squares are the bright ones.
std::optional<double> Alternation(const ImageU8& picture, const Side& side, int out) {
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (int along = 0; along + 1 < side.length; ++along) {
    if (const auto grey = GreyOf(picture, side, along, out)) {
      const int odd = (along + out) & 1;
      sum[odd] += *grey;
      ++count[odd];
    }
  }
  if (count[0] == 0 || count[1] == 0 || count[0] + count[1] < kLeastSquares) {
    return std::nullopt;
  }
  return sum[0] / count[0] - sum[1] / count[1];
}

/// Rows of corners beyond the side.
int Beyond(const ImageU8& picture, const Side& side) {
  const auto inside = Alternation(picture, side, -1);
  if (!inside) {
    return 0;
  }
  // The row of squares 0 always exists; a row of corners more needs the squares after them.
  int more = 0;
  while (more < kMostBeyond) {
    const auto beyond = Alternation(picture, side, more + 1);
    if (!beyond || !(*beyond * *inside > kLeastContrast * *inside * *inside)) {
      break;
    }
    ++more;
  }
  return more;
}

}  // namespace

ChessboardExtent ExtentOfChessboard(const ImageU8& picture,
                                    const std::vector<Eigen::Vector2d>& corners, int columns,
                                    int rows) {
  PALACE_CHECK(static_cast<int>(corners.size()) == columns * rows, corners.size(), columns, rows);
  const auto at = [&](int column, int row) {
    return corners[static_cast<std::size_t>(row * columns + column)];
  };
  const Side left = SideOf([&](int a, int in) { return at(in, a); }, rows, columns);
  const Side right = SideOf([&](int a, int in) { return at(columns - 1 - in, a); }, rows, columns);
  const Side top = SideOf([&](int a, int in) { return at(a, in); }, columns, rows);
  const Side bottom = SideOf([&](int a, int in) { return at(a, rows - 1 - in); }, columns, rows);
  return {columns + Beyond(picture, left) + Beyond(picture, right),
          rows + Beyond(picture, top) + Beyond(picture, bottom)};
}

}  // namespace palace
