#include "engine/slad/thin_structures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/slad/line_sums.h"

namespace palace {
namespace {

constexpr int kTile_px = 32;             // differences are compared with those of their tile
constexpr float kMarksPerMean = 2.0F;    // marks of a difference as large as the tile's mean
constexpr float kLeastMean_grey = 2.5F;  // sensor noise
constexpr int kLeastSum = 130;           // of 224
constexpr int kApart_px = 6;             // candidates of one strip
constexpr int kMostCandidates = 24;      // a strip
constexpr double kLeastAbove_px = 1.5;   // disparity beyond the ground's
constexpr double kMostAbove_px = 96;
constexpr double kStep_px = 0.5;
constexpr double kAside_px = 4;
constexpr float kMostDifference_grey = 40;
constexpr double kLeastPieces = 3;
constexpr double kLeastLength_m = 1.0;

/// A candidate over one strip, in strip coordinates: `along` runs over the strips.
struct Piece {
  int strip = 0;
  double from = 0;  ///< across, on the strip's first row
  double to = 0;    ///< on its last
  int sum = 0;
  double above_px = 0;  ///< disparity beyond the ground's
  int group = -1;
};

/// The picture as strips see it: upright, or transposed for lines that run across.
struct Strips {
  ImageU8 marks;
  bool transposed = false;

  Eigen::Vector2d Pixel(const Piece& piece, double share) const {
    const double along = piece.strip * kStrip_px + share * (kStrip_px - 1);
    const double across = piece.from + share * (piece.to - piece.from);
    return transposed ? Eigen::Vector2d(along, across) : Eigen::Vector2d(across, along);
  }
};

struct Tiles {
  ImageF mean;       ///< of left minus right over left
  ImageF deviation;  ///< mean |difference - mean|
};

/// Of usable blocks only.
Tiles MeasureTiles(const ImageU8& left, const SceneGround& ground) {
  const int cols = (left.width() + kTile_px - 1) / kTile_px;
  const int rows = (left.height() + kTile_px - 1) / kTile_px;
  ImageF sum(cols, rows), spread(cols, rows), count(cols, rows);
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < ground.rows() * kBlock_px; y += 2) {
      const std::uint8_t* l = left.row(y);
      const std::uint8_t* r = ground.right.row(y);
      for (int i = 0; i < ground.cols(); ++i) {
        if (ground.usable.at(i, y / kBlock_px) == 0) {
          continue;
        }
        const int tile_col = i * kBlock_px / kTile_px, tile_row = y / kTile_px;
        const float mean = pass == 0 ? 0 : sum.at(tile_col, tile_row);
        float total = 0;
        for (int x = kBlock_px * i; x < kBlock_px * (i + 1); ++x) {
          const float difference = static_cast<float>(l[x] - r[x]) - mean;
          total += pass == 0 ? difference : std::abs(difference);
        }
        (pass == 0 ? sum : spread).at(tile_col, tile_row) += total;
        count.at(tile_col, tile_row) += pass == 0 ? kBlock_px : 0;
      }
    }
    for (std::size_t k = 0; k < sum.pixels().size(); ++k) {
      float& value = (pass == 0 ? sum : spread).pixels()[k];
      value /= std::max(1.0F, count.pixels()[k]);
    }
  }
  return {std::move(sum), std::move(spread)};
}

ImageU8 MarkDifferences(const ImageU8& left, const SceneGround& ground) {
  const Tiles tiles = MeasureTiles(left, ground);
  ImageU8 marks(left.width(), left.height(), 0);
  for (int y = 0; y < ground.rows() * kBlock_px; ++y) {
    const std::uint8_t* l = left.row(y);
    const std::uint8_t* r = ground.right.row(y);
    std::uint8_t* out = marks.row(y);
    for (int i = 0; i < ground.cols(); ++i) {
      if (ground.usable.at(i, y / kBlock_px) == 0) {
        continue;
      }
      const int tile_col = i * kBlock_px / kTile_px, tile_row = y / kTile_px;
      const float mean = tiles.mean.at(tile_col, tile_row);
      const float gain =
          kMarksPerMean / std::max(kLeastMean_grey, tiles.deviation.at(tile_col, tile_row));
      for (int x = kBlock_px * i; x < kBlock_px * (i + 1); ++x) {
        const float mark = std::abs(static_cast<float>(l[x] - r[x]) - mean) * gain;
        out[x] = static_cast<std::uint8_t>(std::min(mark, static_cast<float>(kLargestMark)));
      }
    }
  }
  return marks;
}

ImageU8 Transposed(const ImageU8& picture) {
  constexpr int kTile = 16;
  ImageU8 turned(picture.height(), picture.width());
  for (int y0 = 0; y0 < picture.height(); y0 += kTile) {
    for (int x0 = 0; x0 < picture.width(); x0 += kTile) {
      for (int x = x0; x < std::min(x0 + kTile, picture.width()); ++x) {
        std::uint8_t* out = turned.row(x);
        for (int y = y0; y < std::min(y0 + kTile, picture.height()); ++y) {
          out[y] = picture.at(x, y);
        }
      }
    }
  }
  return turned;
}

/// The best lines of a strip, at least kApart_px apart; strongest first.
std::vector<Piece> Candidates(const LineSums& lines, int width, int strip) {
  std::vector<Piece> all;
  for (int x = -kStrip_px / 2; x < width + kStrip_px / 2; ++x) {
    if (lines.sum(x) >= kLeastSum) {
      all.push_back({strip, double(x), double(x + lines.aside_px(x)), lines.sum(x)});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Piece& a, const Piece& b) { return a.sum > b.sum; });
  std::vector<Piece> kept;
  for (const Piece& piece : all) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Piece& other) {
      return std::abs(piece.from - other.from) + std::abs(piece.to - other.to) < 2 * kApart_px;
    });
    if (!known) {
      kept.push_back(piece);
      if (kept.size() == kMostCandidates) {
        break;
      }
    }
  }
  return kept;
}

/// How well a piece's own pixels are found again at disparities beyond the ground's.
class PieceMatcher {
 public:
  PieceMatcher(const SceneView& view, const SceneGround& ground)
      : left_(*view.left), right_(*view.right), ground_(ground) {}

  bool Match(const Strips& strips, Piece& piece) {
    samples_.clear();
    for (int k = 0; k < kStrip_px; ++k) {
      const Eigen::Vector2d pixel = strips.Pixel(piece, k / double(kStrip_px - 1));
      const int x = static_cast<int>(std::lround(pixel.x()));
      const int y = static_cast<int>(std::lround(pixel.y()));
      const int i = std::clamp(x / kBlock_px, 0, ground_.cols() - 1);
      const int j = std::clamp(y / kBlock_px, 0, ground_.rows() - 1);
      if (left_.Contains(x, y) && ground_.usable.at(i, j) != 0) {
        samples_.push_back({right_.row(y), static_cast<float>(x) - ground_.disparity_px.at(i, j),
                            static_cast<float>(left_.at(x, y))});
      }
    }
    if (samples_.size() < kStrip_px / 2) {
      return false;
    }
    const int steps = static_cast<int>((kMostAbove_px - kLeastAbove_px) / kStep_px);
    errors_.clear();
    int best = 0;
    for (int k = 0; k < steps; ++k) {
      errors_.push_back(Difference(kLeastAbove_px + k * kStep_px));
      if (errors_[std::size_t(k)] < errors_[std::size_t(best)]) {
        best = k;
      }
    }
    const float on_ground = Difference(0);
    const float found = errors_[std::size_t(best)];
    std::vector<float> sorted = errors_;
    const auto typical = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
    std::nth_element(sorted.begin(), typical, sorted.end());
    piece.above_px = kLeastAbove_px + best * kStep_px;
    // A sharp minimum: even ground hidden by a line fits a whole range of disparities.
    const float aside =
        std::min(Difference(piece.above_px - kAside_px), Difference(piece.above_px + kAside_px));
    return found < 0.56F * on_ground && found < 0.64F * *typical && found < 0.68F * aside;
  }

 private:
  struct Sample {
    const std::uint8_t* right_row;
    float x_px;  ///< in the right picture when it is ground
    float grey;
  };

  float Difference(double above_px) const {
    float sum = 0;
    for (const Sample& s : samples_) {
      const float x = std::clamp(s.x_px - static_cast<float>(above_px), 0.0F,
                                 static_cast<float>(right_.width()) - 1.001F);
      const int k = static_cast<int>(x);
      const float f = x - static_cast<float>(k);
      const float grey =
          static_cast<float>(s.right_row[k]) * (1 - f) + static_cast<float>(s.right_row[k + 1]) * f;
      sum += std::min(std::abs(grey - s.grey), kMostDifference_grey);
    }
    return sum / static_cast<float>(samples_.size());
  }

  const ImageU8& left_;
  const ImageU8& right_;
  const SceneGround& ground_;
  std::vector<Sample> samples_;
  std::vector<float> errors_;
};

bool Continues(const Piece& upper, const Piece& lower) {
  constexpr double kGap_px = 3, kBend_px = 5, kClimb_px = 4;
  const double slope = (upper.to - upper.from) / (kStrip_px - 1);
  const int skipped = lower.strip - upper.strip - 1;
  const double expected = upper.to + slope * (1 + skipped * kStrip_px);
  return std::abs(lower.from - expected) <= kGap_px * (1 + skipped) &&
         std::abs((lower.to - lower.from) - (upper.to - upper.from)) <= kBend_px &&
         std::abs(lower.above_px - upper.above_px) <= kClimb_px * (1 + skipped);
}

/// Keeps the pieces of chains long enough.
std::vector<Piece> Chained(std::vector<Piece> pieces) {
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
  std::vector<int> size(pieces.size(), 0);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    ++size[std::size_t(find(int(k)))];
  }
  std::vector<Piece> kept;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (size[std::size_t(find(int(k)))] >= kLeastPieces) {
      kept.push_back(pieces[k]);
    }
  }
  return kept;
}

}  // namespace

std::vector<ThinPiece> FindThinStructures(const SceneView& view, const SceneGround& ground) {
  std::vector<ThinPiece> found;
  if (ground.empty()) {
    return found;
  }
  PieceMatcher matcher(view, ground);
  Strips strips;
  strips.marks = MarkDifferences(*view.left, ground);
  LineSums lines;
  for (const bool transposed : {false, true}) {
    if (transposed) {
      strips.marks = Transposed(strips.marks);
      strips.transposed = true;
    }
    std::vector<Piece> matched;
    for (int strip = 0; (strip + 1) * kStrip_px <= strips.marks.height(); ++strip) {
      lines.Add(strips.marks, strip * kStrip_px);
      for (Piece& piece : Candidates(lines, strips.marks.width(), strip)) {
        if (matcher.Match(strips, piece)) {
          matched.push_back(piece);
        }
      }
    }
    for (const Piece& piece : Chained(std::move(matched))) {
      ThinPiece thin;
      const auto end = [&](double share) {
        const Eigen::Vector2d p = strips.Pixel(piece, share);
        const int i = std::clamp(static_cast<int>(p.x()) / kBlock_px, 0, ground.cols() - 1);
        const int j = std::clamp(static_cast<int>(p.y()) / kBlock_px, 0, ground.rows() - 1);
        return PointAt(view, p.x(), p.y(),
                       static_cast<double>(ground.disparity_px.at(i, j)) + piece.above_px);
      };
      thin.from_W = end(0);
      thin.to_W = end(1);
      found.push_back(thin);
    }
  }
  return found;
}

}  // namespace palace
