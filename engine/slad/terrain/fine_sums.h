// Sums of what pictures tell of heights, over any rectangle of a map (summed-area tables). Internal
// to the SLAD room.
#pragma once

#include <array>
#include <cstddef>

#include "engine/model/grid.h"

namespace palace {

/// Side of the squares whose heights are asked: with what a gradient feels, as wide as a thing.
inline constexpr double kFineSquare_m = 0.15;
/// Beyond it a height is a thing's, not the noise of one square of a hundred thousand.
inline constexpr double kStandsOut_sigmas = 4.5;
/// A plane is asked no farther from its middle, squared, in its own spread.
inline constexpr double kMostAside = 1;

/// What the pixels of a place, or of many, tell of the height (fine_relief.h).
struct FineKnown {
  float net = 0;     ///< A, 1/m^2
  float gross = 0;   ///< G, 1/m^2
  float height = 0;  ///< J, 1/m
  float off = 0;     ///< R, 1/m: of J, what its pixels tell off the ground they were laid on
};

/// Sums over places: of A, with columns x and rows y off the grid's middle and their products; of J
/// with places; of G; of R.
struct FineSum {
  enum { kA, kAx, kAy, kAxx, kAxy, kAyy, kJ, kJx, kJy, kG, kR, kCount };
  static constexpr int kStored = 12;  ///< even: pairs are summed together
  std::array<double, kStored> of{};

  /// 1/m^2: to a metre at least. What is left of sums over nothing is rounding.
  static constexpr double kLeastNet = 1;
  bool known() const { return of[kA] > kLeastNet && of[kG] > 0; }
  double height_m() const { return of[kJ] / of[kA]; }
  double off_laid_m() const { return of[kR] / of[kA]; }
  double variance_m2() const { return of[kG] / (of[kA] * of[kA]); }
  double x() const { return of[kAx] / of[kA]; }
  double y() const { return of[kAy] / of[kA]; }

  FineSum& operator+=(const FineSum& other);
  friend FineSum operator-(FineSum a, const FineSum& b);
};

/// The plane through all of a sum.
struct FinePlane {
  bool told = false;  ///< the sum spans a plane
  double height_m = 0, per_x_m = 0, per_y_m = 0;
  double x = 0, y = 0;            ///< its middle
  double variance_m2 = 0;         ///< in its middle
  double xx = 0, xy = 0, yy = 0;  ///< its spread, places squared

  double At(double at_x, double at_y) const {
    return height_m + per_x_m * (at_x - x) + per_y_m * (at_y - y);
  }
  /// Squared distance from its middle in its own spread: the variance there is 1 + this times that
  /// in the middle.
  double Aside(double at_x, double at_y) const;
};
FinePlane PlaneThrough(const FineSum& sum);

class FineSums {
 public:
  /// Heights of `known` are relative to `reference_m`. A place counts as one known to a centimetre
  /// at most: ground is rough, and a painted line, known to a millimetre, would be all of the plane
  /// through its surroundings.
  FineSums(const Grid<FineKnown>& known, const GridGeometry& places, double reference_m);

  const GridGeometry& places() const { return places_; }
  double reference_m() const { return reference_m_; }
  /// Places along a square.
  int side() const;
  /// Over the square of `side` places whose middle is the corner between places (row - 1, col - 1)
  /// and (row, col), or the place itself where the side is odd; `reach` places wider on all sides.
  /// Cut at the grid.
  FineSum Over(int row, int col, int side, int reach = 0) const;
  /// Over rows from `row` to before `row_end`, and columns likewise. Cut at the grid.
  FineSum Within(int row, int row_end, int col, int col_end) const;

 private:
  GridGeometry places_;
  double reference_m_;
  Grid<FineSum> corners_;
};

}  // namespace palace
