// BoxTree: finds what a ray may meet among many things, by a binary tree of their boxes.
//
// Built by halving at the median of the longest side (Kay and Kajiya 1986); walked nearest first,
// past what lies behind the nearest meeting so far.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace palace {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  bool empty() const { return nodes_.empty(); }
  const Eigen::AlignedBox3d& box() const { return nodes_.front().box; }

  /// Calls meet(item) for every item whose box the ray p + s r enters before `nearest`; meet
  /// returns where the item itself is met, infinity where it is not. Returns the least, or
  /// `nearest`.
  template <typename Meet>
  double Walk(const Eigen::Vector3d& p, const Eigen::Vector3d& r, double nearest,
              Meet&& meet) const {
    if (nodes_.empty()) {
      return nearest;
    }
    const Eigen::Vector3d per = r.cwiseInverse();
    std::array<std::uint32_t, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!Enters(node.box, p, per, nearest)) {
        continue;
      }
      if (node.count > 0) {
        for (std::uint32_t i = 0; i < node.count; ++i) {
          const double s = meet(items_[node.first + i]);
          nearest = s < nearest ? s : nearest;
        }
        continue;
      }
      // The child on the ray's side of the cut first.
      const bool forward = r[node.axis] > 0;
      stack[depth++] = forward ? node.first + 1 : node.first;
      stack[depth++] = forward ? node.first : node.first + 1;
    }
    return nearest;
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;  ///< item, or the first of two children
    std::uint32_t count = 0;  ///< of items; 0: an inner node
    int axis = 0;
  };
  static bool Enters(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& p,
                     const Eigen::Vector3d& per, double nearest) {
    double enter = 0, leave = nearest;
    for (int i = 0; i < 3; ++i) {
      const double a = (box.min()[i] - p[i]) * per[i], b = (box.max()[i] - p[i]) * per[i];
      // A ray along a face gives 0 times infinity, which is NaN: it neither enters nor leaves.
      const double low = a < b ? a : b, high = a < b ? b : a;
      enter = low > enter ? low : enter;
      leave = high < leave ? high : leave;
    }
    return enter <= leave;
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace palace
