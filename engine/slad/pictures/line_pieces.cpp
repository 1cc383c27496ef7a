#include "engine/slad/pictures/line_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palace {
namespace {

constexpr int kApart_px = 6;
constexpr std::size_t kMostPieces = 24;

bool Continues(const LinePiece& upper, const LinePiece& lower) {
  constexpr double kGap_px = 3, kBend_px = 5, kClimb_px = 4;
  const double slope = (upper.to - upper.from) / (kStrip_px - 1);
  const int skipped = lower.strip - upper.strip - 1;
  const double expected = upper.to + slope * (1 + skipped * kStrip_px);
  return std::abs(lower.from - expected) <= kGap_px * (1 + skipped) &&
         std::abs((lower.to - lower.from) - (upper.to - upper.from)) <= kBend_px &&
         std::abs(lower.above_px - upper.above_px) <= kClimb_px * (1 + skipped);
}

}  // namespace

Eigen::Vector2d MarkStrips::Pixel(const LinePiece& piece, double share) const {
  const double along = piece.strip * kStrip_px + share * (kStrip_px - 1);
  const double across = piece.from + share * (piece.to - piece.from);
  return transposed ? Eigen::Vector2d(along, across) : Eigen::Vector2d(across, along);
}

std::vector<LinePiece> FindPieces(const MarkStrips& strips, int strip, int least_sum,
                                  LineSums& lines) {
  lines.Add(strips.marks, strip * kStrip_px);
  const int width = strips.marks.width();
  std::vector<LinePiece> all;
  for (int x = -kStrip_px / 2; x < width + kStrip_px / 2; ++x) {
    if (lines.sum(x) >= least_sum) {
      all.push_back({strip, double(x), double(x + lines.aside_px(x)), lines.sum(x)});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const LinePiece& a, const LinePiece& b) { return a.sum > b.sum; });
  std::vector<LinePiece> kept;
  for (const LinePiece& piece : all) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const LinePiece& other) {
      return std::abs(piece.from - other.from) + std::abs(piece.to - other.to) < 2 * kApart_px;
    });
    if (!known) {
      kept.push_back(piece);
      if (kept.size() == kMostPieces) {
        break;
      }
    }
  }
  return kept;
}

std::vector<std::vector<LinePiece>> Chains(const std::vector<LinePiece>& pieces,
                                           std::size_t least) {
  std::vector<int> root(pieces.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int k) {
    while (root[std::size_t(k)] != k) {
      k = root[std::size_t(k)];
    }
    return k;
  };
  for (std::size_t a = 0; a < pieces.size(); ++a) {
    for (std::size_t b = 0; b < pieces.size(); ++b) {
      const int ahead = pieces[b].strip - pieces[a].strip;
      if (ahead >= 1 && ahead <= 2 && Continues(pieces[a], pieces[b])) {
        root[std::size_t(find(int(b)))] = find(int(a));
      }
    }
  }
  std::vector<std::vector<LinePiece>> chains;
  std::vector<int> chain_of(pieces.size(), -1);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    int& chain = chain_of[std::size_t(find(int(k)))];
    if (chain < 0) {
      chain = static_cast<int>(chains.size());
      chains.emplace_back();
    }
    chains[std::size_t(chain)].push_back(pieces[k]);
  }
  std::erase_if(chains, [&](const auto& chain) { return chain.size() < least; });
  return chains;
}

}  // namespace palace
