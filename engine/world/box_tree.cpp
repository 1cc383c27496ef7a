#include "engine/world/box_tree.h"

#include <algorithm>
#include <array>
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

BoxTree::Branches BoxTree::Within(const Beam& beam) const {
  constexpr std::size_t kMost = 24;
  const std::span<const std::uint32_t> whole = Whole();
  Branches branches(whole.begin(), whole.end()), finer;
  // Rays that go both ways along an axis meet children in both orders.
  const std::array<int, 3> sign = {beam.Sign(0), beam.Sign(1), beam.Sign(2)};
  for (bool split = true; split;) {
    split = false;
    finer.clear();
    for (const std::uint32_t branch : branches) {
      const Node& node = nodes_[branch];
      if (!beam.MayEnter(node.box)) {
        continue;
      }
      const int way = sign[static_cast<std::size_t>(node.axis)];
      if (node.count > 0 || way == 0) {
        finer.push_back(branch);
        continue;
      }
      split = true;
      finer.push_back(way > 0 ? node.first : node.first + 1);
      finer.push_back(way > 0 ? node.first + 1 : node.first);
    }
    if (finer.size() > kMost) {
      break;
    }
    branches.swap(finer);
  }
  return branches;
}

}  // namespace palace
