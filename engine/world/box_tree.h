// BoxTree: finds what a ray may meet among many things, by a binary tree of their boxes.
//
// Built by halving at the median of the longest side (Kay and Kajiya 1986); walked nearest first,
// past what lies behind the nearest meeting so far. Rays of one beam may begin where the whole beam
// enters: what no ray of it can meet is left out once for all of them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "engine/world/beam.h"

namespace palace {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  bool empty() const { return nodes_.empty(); }
  const Eigen::AlignedBox3d& box() const { return nodes_.front().box; }
  /// The things, those close together side by side; walks name a thing by its place in here.
  const std::vector<std::uint32_t>& items() const { return items_; }

  /// Branches of the tree, in the order in which rays meet them.
  using Branches = std::vector<std::uint32_t>;
  std::span<const std::uint32_t> Whole() const {
    static constexpr std::uint32_t kRoot = 0;
    return {&kRoot, empty() ? 0U : 1U};
  }
  /// Those that hold all that rays of the beam meet; few.
  Branches Within(const Beam& beam) const;

  /// Calls meet(place) for every item whose box the ray p + s r enters before `nearest`; meet
  /// returns where the item itself is met, infinity where it is not. Returns the least, or
  /// `nearest`. What lies on other branches is not asked.
  template <typename Meet>
  double Walk(std::span<const std::uint32_t> branches, const Eigen::Vector3d& p,
              const Eigen::Vector3d& r, double nearest, Meet&& meet) const {
    const Eigen::Vector3d per = r.cwiseInverse();
    std::array<std::uint32_t, 64> stack;
    for (const std::uint32_t branch : branches) {
      std::size_t depth = 0;
      stack[depth++] = branch;
      while (depth > 0) {
        const Node& node = nodes_[stack[--depth]];
        if (!Enters(node.box, p, per, nearest)) {
          continue;
        }
        if (node.count > 0) {
          for (std::uint32_t i = 0; i < node.count; ++i) {
            const double s = meet(node.first + i);
            nearest = s < nearest ? s : nearest;
          }
          continue;
        }
        // The child on the ray's side of the cut first.
        const std::uint32_t second = r[node.axis] > 0 ? 1 : 0;
        stack[depth++] = node.first + second;
        stack[depth++] = node.first + 1 - second;
      }
    }
    return nearest;
  }

  /// Whether meets(place) is true of any item whose box the ray enters.
  template <typename Meets>
  bool Any(const Eigen::Vector3d& p, const Eigen::Vector3d& r, Meets&& meets) const {
    if (nodes_.empty()) {
      return false;
    }
    const Eigen::Vector3d per = r.cwiseInverse();
    std::array<std::uint32_t, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!Enters(node.box, p, per, std::numeric_limits<double>::infinity())) {
        continue;
      }
      if (node.count == 0) {
        stack[depth++] = node.first;
        stack[depth++] = node.first + 1;
        continue;
      }
      for (std::uint32_t i = 0; i < node.count; ++i) {
        if (meets(node.first + i)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  struct alignas(64) Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;  ///< place of an item, or the first of two children
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
