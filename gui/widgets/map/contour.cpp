#include "gui/widgets/map/contour.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace palace {

namespace {

constexpr std::uint8_t kSafe = 1;

/// True for unknown pixels reachable from the rim through unknown pixels.
ImageU8 OutsideOfMap(const ImageU8& verdict) {
  ImageU8 outside(verdict.width(), verdict.height(), 0);
  std::vector<std::array<int, 2>> open;
  const auto visit = [&](int x, int y) {
    if (verdict.Contains(x, y) && verdict.at(x, y) == 0 && outside.at(x, y) == 0) {
      outside.at(x, y) = 1;
      open.push_back({x, y});
    }
  };
  for (int x = 0; x < verdict.width(); ++x) {
    visit(x, 0);
    visit(x, verdict.height() - 1);
  }
  for (int y = 0; y < verdict.height(); ++y) {
    visit(0, y);
    visit(verdict.width() - 1, y);
  }
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return outside;
}

/// Points of the contour are crossings of the pixel grid's edges; each has up to two neighbours.
class Chains {
 public:
  Chains(int width, int height)
      : width_(width),
        next_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 2, {-1, -1}) {}
  int Horizontal(int x, int y) const { return 2 * (y * width_ + x); }
  int Vertical(int x, int y) const { return 2 * (y * width_ + x) + 1; }
  void Join(int a, int b) {
    Add(a, b);
    Add(b, a);
  }
  std::vector<std::vector<ImVec2>> Trace() {
    std::vector<std::vector<ImVec2>> lines;
    for (const bool ends_only : {true, false}) {  // open chains first, then loops
      for (int i = 0; i < static_cast<int>(next_.size()); ++i) {
        const auto& n = next_[static_cast<std::size_t>(i)];
        if (n[0] >= 0 && (!ends_only || n[1] < 0)) {
          lines.push_back(Follow(i));
        }
      }
    }
    return lines;
  }

 private:
  void Add(int from, int to) {
    auto& n = next_[static_cast<std::size_t>(from)];
    n[n[0] < 0 ? 0 : 1] = to;
  }
  ImVec2 At(int id) const {
    const int cell = id / 2;
    const float x = static_cast<float>(cell % width_);
    const float y = static_cast<float>(cell / width_);
    return id % 2 == 0 ? ImVec2{x + 0.5f, y} : ImVec2{x, y + 0.5f};
  }
  void Cut(int from, int to) {
    auto& n = next_[static_cast<std::size_t>(from)];
    if (n[0] == to) {
      n = {n[1], -1};
    } else if (n[1] == to) {
      n[1] = -1;
    }
  }
  std::vector<ImVec2> Follow(int start) {
    std::vector<ImVec2> line = {At(start)};
    for (int at = start; next_[static_cast<std::size_t>(at)][0] >= 0;) {
      const int to = next_[static_cast<std::size_t>(at)][0];
      Cut(at, to);
      Cut(to, at);
      const ImVec2 point = At(to);
      if (line.size() >= 2) {  // a straight run keeps only its ends
        const ImVec2 a = line[line.size() - 2];
        const ImVec2 b = line.back();
        const float turn = (b.x - a.x) * (point.y - b.y) - (b.y - a.y) * (point.x - b.x);
        if (std::abs(turn) < 1e-6f) {
          line.pop_back();
        }
      }
      line.push_back(point);
      at = to;
    }
    return line;
  }

  int width_;
  std::vector<std::array<int, 2>> next_;
};

}  // namespace

std::vector<std::vector<ImVec2>> SafeContours(const ImageU8& verdict) {
  if (verdict.empty()) {
    return {};
  }
  const ImageU8 outside = OutsideOfMap(verdict);
  Chains chains(verdict.width(), verdict.height());
  for (int y = 0; y + 1 < verdict.height(); ++y) {
    for (int x = 0; x + 1 < verdict.width(); ++x) {
      if ((outside.at(x, y) | outside.at(x + 1, y) | outside.at(x, y + 1) |
           outside.at(x + 1, y + 1)) != 0) {
        continue;
      }
      const bool a = verdict.at(x, y) == kSafe;
      const bool b = verdict.at(x + 1, y) == kSafe;
      const bool c = verdict.at(x + 1, y + 1) == kSafe;
      const bool d = verdict.at(x, y + 1) == kSafe;
      const int top = chains.Horizontal(x, y);
      const int low = chains.Horizontal(x, y + 1);
      const int left = chains.Vertical(x, y);
      const int right = chains.Vertical(x + 1, y);
      if (a == c && b == d && a != b) {  // saddle: the safe corners stay apart
        chains.Join(a ? top : left, a ? left : low);
        chains.Join(a ? right : top, a ? low : right);
        continue;
      }
      int ends[4];
      int count = 0;
      if (a != b) ends[count++] = top;
      if (b != c) ends[count++] = right;
      if (c != d) ends[count++] = low;
      if (d != a) ends[count++] = left;
      if (count == 2) {
        chains.Join(ends[0], ends[1]);
      }
    }
  }
  return chains.Trace();
}

}  // namespace palace
