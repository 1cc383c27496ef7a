// Dark dots on a bright board: where they are, to a few hundredths of a pixel.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"

namespace palace {

struct Dot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();      ///< centroid of the dot's area, px
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the area; half an axis is 2 sigma
  double area_px = 0;                                    ///< full dark pixels it amounts to
};

/// Dark spots of about `window_px` / 2 across and less: elliptic, brighter all round, away from the
/// border. The picture is held against its local mean in a square of window_px, so that light may
/// be uneven. Pixel accuracy only. At most 5000; none from a picture that has more.
std::vector<Dot> FindDots(const ImageU8& picture, int window_px);

/// Centroid of the dot with weight 1 - grey / background, the background a plane fitted to a bright
/// ring round the dot: limited by noise, and unmoved by uneven light, which scales dot and board
/// alike. Window and ring follow the dot's own moments. False when they leave the picture, the ring
/// is not bright, or the dot dissolves; the dot is then unchanged.
bool RefineDot(const ImageU8& picture, Dot& dot);

/// A dot whose place on the grid is known.
struct GridDot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< px, good to a fraction of a pixel
  Eigen::Matrix2d steps = Eigen::Matrix2d::Zero();   ///< px per pitch along columns and rows
  double radius = 0;                                 ///< of the dot, in pitches
  double neighbour_radius = 0;                       ///< of the largest neighbour, in pitches
};

/// The same centroid with a window that the grid gives: a circle on the board that ends in the gap
/// between the dots, clear of the blur of both. Nothing where RefineDot would say false.
std::optional<Eigen::Vector2d> RefineInGrid(const ImageU8& picture, const GridDot& dot);

}  // namespace palace
