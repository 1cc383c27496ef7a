// HeightField: relief of the simulated ground on a square grid of corners.
//
// Heights are metres, up-positive, given at (n + 1) x (n + 1) corners; each cell is two triangles
// that share the diagonal from its south-west to its north-east corner, so that rays, skids and a
// mesh of the same triangles meet one surface. Beyond its rectangle the field goes on mirrored: the
// ground has no end and no step.
//
// Rays are followed through a pyramid of the highest corner of each block (maximum mipmaps, Tevs,
// Ihrke and Seidel 2008): exact, some twenty steps a ray.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Dense>

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
  /// Unit normal in W, pointing up, of the triangle at that place.
  Eigen::Vector3d Normal(double north_m, double east_m) const;
  /// Least s >= 0 where the ray p + s r of W, which starts above, meets the surface; infinity where
  /// it does not, and for a ray that starts below.
  double Cast(const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W) const;

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
  int Mirrored(std::int64_t index) const;
  /// Highest corner of the block of 2^level cells.
  float Highest(int level, std::int64_t i, std::int64_t j) const;
  struct Corners {
    double sw, nw, se, ne;
  };
  Corners CornersOf(std::int64_t i, std::int64_t j) const;

  Place place_;
  int cells_;
  double cell_m_;
  double lowest_m_ = 0;
  std::vector<float> corners_;
  std::vector<std::vector<float>> levels_;  ///< highest corner of blocks of 1, 2, 4 ... cells
};

}  // namespace palace
