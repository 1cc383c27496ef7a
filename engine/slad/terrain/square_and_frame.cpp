#include "engine/slad/terrain/square_and_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace palace {
namespace {

constexpr int kRingFrom = 1;  // of the frame, in squares beyond the square
/// As kMostAside, of a frame cut at the square: whole, it lies 2.5 aside.
constexpr double kMostAsideOfCut = 3;
constexpr int kBands = 5;    // of blocks: what lies beyond the square, twice on each side, and it
constexpr int kMiddle = 2;   // … the square's own
constexpr int kOfPlane = 3;  // parameters

/// A block of the frame.
struct Block {
  int down = 0, right = 0;  ///< which band
  FineSum sum;
};

/// Which blocks of the frame are kept: all, or all but those beyond one side of the square.
struct Cut {
  int down = 0, right = 0;  ///< towards that side; both 0: none
  bool Keeps(const Block& block) const {
    return down * (block.down - kMiddle) + right * (block.right - kMiddle) <= 0;
  }
};
constexpr Cut kWhole;
constexpr std::array kCuts = {Cut{-1, 0}, Cut{1, 0}, Cut{0, -1}, Cut{0, 1}};

FineSum Own(const FineSums& sums, const SquareAndFrame& at) {
  return sums.Over(at.row, at.col, at.side);
}

ShownBySquare OffPlane(const FineSum& own, const FinePlane& ground, double most_aside) {
  ShownBySquare shown;
  const double aside = ground.told ? ground.Aside(own.x(), own.y()) : HUGE_VAL;
  if (aside <= most_aside) {
    shown.told = true;
    shown.level_m = ground.At(own.x(), own.y());
    shown.off_m = own.height_m() - shown.level_m;
    shown.sigma_m = std::sqrt(own.variance_m2() + (1 + aside) * ground.variance_m2);
    shown.off_laid_m = own.off_laid_m();
  }
  return shown;
}

std::vector<Block> BlocksOf(const FineSums& sums, const SquareAndFrame& at) {
  const int top = at.row - at.side / 2, left = at.col - at.side / 2;
  const int from = kRingFrom * at.side, to = at.ring_to * at.side;
  const auto edges = [&](int first) {
    const int end = first + at.side;
    return std::array{first - to, first - from, first, end, end + from, end + to};
  };
  const auto rows = edges(top), cols = edges(left);
  std::vector<Block> blocks;
  for (int i = 0; i < kBands; ++i) {
    for (int j = 0; j < kBands; ++j) {
      if (std::abs(i - kMiddle) == kMiddle || std::abs(j - kMiddle) == kMiddle) {
        const auto r = static_cast<std::size_t>(i), c = static_cast<std::size_t>(j);
        blocks.push_back({i, j, sums.Within(rows[r], rows[r + 1], cols[c], cols[c + 1])});
      }
    }
  }
  return blocks;
}

/// The plane of the blocks that a cut keeps, and what they lie off it by, mean square; infinity
/// where they are too few to tell.
struct Ground {
  FinePlane plane;
  double scatter_m2 = HUGE_VAL;
  double most_sigmas = 0;  ///< of a block off the plane
};

Ground GroundOf(const std::vector<Block>& blocks, const Cut& cut, double bumps_m) {
  FineSum all;
  for (const Block& block : blocks) {
    if (cut.Keeps(block)) {
      all += block.sum;
    }
  }
  Ground ground{PlaneThrough(all)};
  int known = 0;
  double weight = 0, square = 0;
  for (const Block& block : blocks) {
    if (cut.Keeps(block) && block.sum.known()) {
      const double off_m = block.sum.height_m() - ground.plane.At(block.sum.x(), block.sum.y());
      weight += block.sum.of[FineSum::kA];
      square += block.sum.of[FineSum::kA] * off_m * off_m;
      ground.most_sigmas =
          std::max(ground.most_sigmas,
                   std::abs(off_m) / std::sqrt(block.sum.variance_m2() + bumps_m * bumps_m));
      ++known;
    }
  }
  if (ground.plane.told && known > kOfPlane) {
    ground.scatter_m2 = square / weight * known / (known - kOfPlane);
  }
  return ground;
}

}  // namespace

ShownBySquare OffFrame(const FineSums& sums, const SquareAndFrame& at) {
  const FineSum own = Own(sums, at);
  if (!own.known()) {
    return {};
  }
  return OffPlane(own,
                  PlaneThrough(sums.Over(at.row, at.col, at.side, at.ring_to * at.side) -
                               sums.Over(at.row, at.col, at.side, kRingFrom * at.side)),
                  kMostAside);
}

ShownBySquare OffGroundAround(const FineSums& sums, const SquareAndFrame& at, double bumps_m) {
  ShownBySquare best = OffFrame(sums, at);
  if (!best.told) {
    return best;
  }
  const FineSum own = Own(sums, at);
  const std::vector<Block> blocks = BlocksOf(sums, at);
  const Ground whole = GroundOf(blocks, kWhole, bumps_m);
  if (!(whole.most_sigmas > kStandsOut_sigmas)) {
    return best;
  }
  double least_m2 = whole.scatter_m2;
  for (const Cut& cut : kCuts) {
    const Ground ground = GroundOf(blocks, cut, bumps_m);
    if (ground.scatter_m2 < least_m2) {
      const ShownBySquare shown = OffPlane(own, ground.plane, kMostAsideOfCut);
      if (shown.told) {
        best = shown;
        least_m2 = ground.scatter_m2;
      }
    }
  }
  return best;
}

}  // namespace palace
