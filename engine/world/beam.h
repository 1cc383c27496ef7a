// Beam: a bundle of rays from one point, for what is asked once of all rays of a few pixels.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace palace {

/// All rays p + s r, s >= 0, with r between four: a pyramid without end.
class Beam {
 public:
  /// Its edges in order round it, either way; less than half a turn between any two.
  Beam(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 4>& edges)
      : p_(p), edges_(edges) {
    const Eigen::Vector3d middle = edges[0] + edges[1] + edges[2] + edges[3];
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d inward = edges[k].cross(edges[(k + 1) % 4]);
      inward_[k] = inward.dot(middle) < 0 ? -inward : inward;
    }
  }

  const Eigen::Vector3d& p() const { return p_; }
  const std::array<Eigen::Vector3d, 4>& edges() const { return edges_; }
  /// The same rays from another point.
  Beam From(const Eigen::Vector3d& p) const {
    Beam beam = *this;
    beam.p_ = p;
    return beam;
  }

  /// False when no ray of it enters the box; true may be said of a box that lies just beside it.
  bool MayEnter(const Eigen::AlignedBox3d& box) const {
    const Eigen::Vector3d low = box.min() - p_, high = box.max() - p_;
    for (const Eigen::Vector3d& n : inward_) {
      double farthest = 0;  // of the box's corners, inward of that side
      for (int i = 0; i < 3; ++i) {
        farthest += n[i] > 0 ? n[i] * high[i] : n[i] * low[i];
      }
      if (farthest < 0) {
        return false;
      }
    }
    return true;
  }
  /// Of all its rays, on each axis: +1 forward, -1 backward, 0 some this way and some that.
  int Sign(int axis) const {
    int forward = 0, backward = 0;
    for (const Eigen::Vector3d& edge : edges_) {
      forward += edge[axis] > 0;
      backward += edge[axis] < 0;
    }
    return forward == 4 ? 1 : backward == 4 ? -1 : 0;
  }

 private:
  Eigen::Vector3d p_;
  std::array<Eigen::Vector3d, 4> edges_;
  std::array<Eigen::Vector3d, 4> inward_;  ///< normals of its sides
};

}  // namespace palace
