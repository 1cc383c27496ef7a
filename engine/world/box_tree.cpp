#include "engine/world/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace palace {

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) {
  constexpr std::uint32_t kLeaf = 4;
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0U);
  if (boxes.empty()) {
    return;
  }
  struct Range {
    std::uint32_t node, first, count;
  };
  std::vector<Range> waiting = {{0, 0, static_cast<std::uint32_t>(boxes.size())}};
  nodes_.emplace_back();
  while (!waiting.empty()) {
    const Range range = waiting.back();
    waiting.pop_back();
    const auto begin = items_.begin() + range.first, end = begin + range.count;
    Node node{.box = {}, .first = range.first, .count = range.count, .axis = 0};
    Eigen::AlignedBox3d middles;
    for (auto item = begin; item != end; ++item) {
      node.box.extend(boxes[*item]);
      middles.extend(boxes[*item].center());
    }
    if (range.count > kLeaf) {
      middles.sizes().maxCoeff(&node.axis);
      const auto half = begin + range.count / 2;
      std::nth_element(begin, half, end, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(boxes[a].center()[node.axis], a) <
               std::pair(boxes[b].center()[node.axis], b);
      });
      node.first = static_cast<std::uint32_t>(nodes_.size());
      node.count = 0;
      nodes_.resize(nodes_.size() + 2);
      waiting.push_back({node.first, range.first, range.count / 2});
      waiting.push_back(
          {node.first + 1, range.first + range.count / 2, range.count - range.count / 2});
    }
    nodes_[range.node] = node;
  }
}

}  // namespace palace
