// HeightField: relief of the simulated ground on a square grid of corners.
//
// Heights are metres, up-positive, given at (n + 1) x (n + 1) corners; each cell is two triangles
// that share the diagonal from its south-west to its north-east corner, so that rays, skids and a
// mesh of the same triangles meet one surface. Beyond its rectangle the field goes on mirrored: the
// ground has no end and no step.
//
// Rays are followed through a pyramid of the highest corner of each block (maximum mipmaps, Tevs,
// Ihrke and Seidel 2008): exact, some ten steps a ray, three where a beam was followed before.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "engine/world/beam.h"

namespace palace {

class HeightField {
 public:
  /// A square of `size_m` with its south-west corner at (north, east), 2^levels cells a side.
  struct Place {
    double north_m = 0;
    double east_m = 0;
    double size_m = 0;
    int levels = 9;
  };
  /// Samples the function at the corners, rows at once on several threads. 4 <= levels <= 12.
  HeightField(const Place& place,
              const std::function<double(double north_m, double east_m)>& height);

  double Height(double north_m, double east_m) const;
  /// One of the triangles; `north_half` of the cell is that towards its north-west corner.
  struct Triangle {
    std::int64_t i = 0, j = 0;
    bool north_half = false;
    bool operator==(const Triangle&) const = default;
  };
  Triangle TriangleAt(double north_m, double east_m) const;
  /// Unit normal in W, pointing up, of the triangle at that place.
  Eigen::Vector3d Normal(double north_m, double east_m) const;
  /// Least s >= 0 where the ray p + s r of W, which starts above, meets the surface; infinity where
  /// it does not, and for a ray that starts below.
  double Cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W) const {
    return Cast(p_W, r_W, 0);
  }
  /// The same of a ray that is known to be over the surface up to s = `clear`: ClearUpTo a beam it
  /// is of.
  double Cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W, double clear) const;
  /// A number s >= 0 up to which all rays p + s r with r a mean of the beam's edges are over the
  /// surface: close to where they meet it. 0 for a beam of which some rays go up.
  double ClearUpTo(const Beam& beam_W) const;

  const Place& place() const { return place_; }
  int cells() const { return cells_; }  ///< a side
  double cell_m() const { return cell_m_; }
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return levels_.back().front(); }
  /// Corner 0 <= i, j <= cells(), i to the north and j to the east.
  double Corner(int i, int j) const { return corners_[At(i, j)]; }

 private:
  std::size_t At(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(cells_ + 1) +
           static_cast<std::size_t>(j);
  }
  struct Corners {
    double sw, nw, se, ne;
  };
  Corners CornersOf(std::int64_t i, std::int64_t j) const;
  /// Highest corner of the block of 2^level cells a side.
  float Highest(int level, std::int64_t i, std::int64_t j) const;
  /// Not lower than the surface anywhere in a rectangle of cells' coordinates.
  double HighestIn(const Eigen::AlignedBox2d& cells) const;

  Place place_;
  int cells_;
  double cell_m_;
  double lowest_m_ = 0;
  std::vector<float> corners_;
  std::vector<std::vector<float>> levels_;  ///< highest corner of blocks of 1, 2, 4 ... cells
};

}  // namespace palace
