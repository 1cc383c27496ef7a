#include "engine/slad/thin_structures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
constexpr int kLeastPieces = 3;
// Lines along the baseline.
constexpr int kRidge_px = 3;
constexpr int kLeastRidgeSum = 185;
constexpr double kMostRidgeAside_px = 2;  // over a strip: 3.7 degrees
constexpr double kLeastRidgeShare = 0.6;  // of the picture's width

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

/// Marks of thin lines along the rows: what is darker, or brighter, than three rows above and
/// below.
ImageU8 MarkRidges(const ImageU8& left) {
  const int width = left.width(), height = left.height();
  ImageU8 marks(width, height, 0);
  std::vector<int> ridge(static_cast<std::size_t>(width));
  // The usual height of ridges, tile by tile along a band of rows.
  for (int band = kRidge_px; band < height - kRidge_px; band += kTile_px) {
    const int end = std::min(band + kTile_px, height - kRidge_px);
    std::vector<float> sum(static_cast<std::size_t>(width / kTile_px + 1), 0.0F);
    for (const bool marking : {false, true}) {
      for (int y = band; y < end; y += marking ? 1 : 4) {
        const std::uint8_t *up = left.row(y - kRidge_px), *here = left.row(y),
                           *down = left.row(y + kRidge_px);
        for (int x = 0; x < width; ++x) {
          const int dark = std::min(up[x], down[x]) - here[x];
          const int bright = here[x] - std::max(up[x], down[x]);
          ridge[static_cast<std::size_t>(x)] = std::max(0, std::max(dark, bright));
        }
        for (int x0 = 0; x0 < width; x0 += kTile_px) {
          const int x1 = std::min(x0 + kTile_px, width);
          float& total = sum[static_cast<std::size_t>(x0 / kTile_px)];
          const float rows = static_cast<float>((end - band + 3) / 4);
          const float mean = total / (rows * static_cast<float>(x1 - x0));
          const float gain = kMarksPerMean / std::max(kLeastMean_grey, mean);
          for (int x = x0; x < x1; ++x) {
            const float value = static_cast<float>(ridge[static_cast<std::size_t>(x)]);
            if (marking) {
              marks.at(x, y) = static_cast<std::uint8_t>(
                  std::min(value * gain, static_cast<float>(kLargestMark)));
            } else {
              total += value;
            }
          }
        }
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

/// Keeps the pieces of chains of at least `least` of them.
std::vector<Piece> Chained(const std::vector<Piece>& pieces, int least) {
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
    if (size[std::size_t(find(int(k)))] >= least) {
      kept.push_back(pieces[k]);
    }
  }
  return kept;
}

/// Ends in W of the pieces, at the disparity beyond the ground's.
void AddPieces(const SceneView& view, const SceneGround& ground, const Strips& strips,
               const std::vector<Piece>& pieces, bool height_known, std::vector<ThinPiece>& found) {
  for (const Piece& piece : pieces) {
    const auto end = [&](double share) {
      const Eigen::Vector2d p = strips.Pixel(piece, share);
      const int i = std::clamp(static_cast<int>(p.x()) / kBlock_px, 0, ground.cols() - 1);
      const int j = std::clamp(static_cast<int>(p.y()) / kBlock_px, 0, ground.rows() - 1);
      return PointAt(view, p.x(), p.y(),
                     static_cast<double>(ground.disparity_px.at(i, j)) + piece.above_px);
    };
    found.push_back({end(0), end(1), height_known});
  }
}

}  // namespace

std::vector<ThinPiece> FindThinStructures(const SceneView& view, const SceneGround& ground) {
  std::vector<ThinPiece> found;
  if (ground.empty()) {
    return found;
  }
  PieceMatcher matcher(view, ground);
  LineSums lines;
  Strips upright{MarkDifferences(*view.left, ground), false};
  const Strips across{Transposed(upright.marks), true};
  for (const Strips* strips : {&std::as_const(upright), &across}) {
    std::vector<Piece> matched;
    for (int strip = 0; (strip + 1) * kStrip_px <= strips->marks.height(); ++strip) {
      lines.Add(strips->marks, strip * kStrip_px);
      for (Piece& piece : Candidates(lines, strips->marks.width(), strip)) {
        if (matcher.Match(*strips, piece)) {
          matched.push_back(piece);
        }
      }
    }
    AddPieces(view, ground, *strips, Chained(matched, kLeastPieces), true, found);
  }

  const Strips ridges{Transposed(MarkRidges(*view.left)), true};
  const int strips_across = ridges.marks.height() / kStrip_px;
  std::vector<Piece> level;
  for (int strip = 0; strip < strips_across; ++strip) {
    lines.Add(ridges.marks, strip * kStrip_px);
    for (const Piece& piece : Candidates(lines, ridges.marks.width(), strip)) {
      if (piece.sum >= kLeastRidgeSum && std::abs(piece.to - piece.from) <= kMostRidgeAside_px) {
        level.push_back(piece);
      }
    }
  }
  const int least = static_cast<int>(std::ceil(kLeastRidgeShare * strips_across));
  AddPieces(view, ground, ridges, Chained(level, std::max(least, kLeastPieces)), false, found);
  return found;
}

}  // namespace palace
