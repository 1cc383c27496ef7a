#include "engine/slad/pictures/thin_structures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/median.h"
#include "engine/slad/pictures/along_baseline.h"
#include "engine/slad/pictures/line_marks.h"
#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/terrain/air_seen.h"

namespace palace {
namespace {

constexpr int kLeastSum = 130;  // of 224
constexpr double kStep_px = 0.5;
constexpr double kAside_px = 4;
constexpr float kMostDifference_grey = 40;
constexpr std::size_t kLeastPieces = 3;
constexpr std::size_t kLeastSamples = kStrip_px / 2;
// What a piece's own pixels may differ by, as a share of the difference on the ground, of the
// lowest quarter of all disparities, and of the disparities kAside_px to both sides.
constexpr float kOfGround = 0.56F;
constexpr float kOfQuarter = 0.64F;
constexpr float kOfAside = 0.68F;

/// How well a piece's own pixels are found again at disparities beyond the ground's.
class PieceMatcher {
 public:
  PieceMatcher(const SceneView& view, const SceneGround& ground)
      : left_(*view.left), right_(*view.right), ground_(ground) {}

  bool Match(const MarkStrips& strips, LinePiece& piece) {
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
    if (samples_.size() < kLeastSamples) {
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
    const float quarter = UpperQuantile(sorted, 4);
    piece.above_px = kLeastAbove_px + best * kStep_px;
    // A sharp minimum: even ground hidden by a line fits a whole range of disparities.
    const float aside =
        std::min(Difference(piece.above_px - kAside_px), Difference(piece.above_px + kAside_px));
    return found < kOfGround * on_ground && found < kOfQuarter * quarter &&
           found < kOfAside * aside;
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

/// Along the baseline any disparity fits: what was found must lie aside of where it is not.
bool IsDisparitySeen(const MarkStrips& strips, const LinePiece& piece) {
  const double climb = (piece.to - piece.from) / (kStrip_px - 1);
  return !strips.transposed || std::abs(climb) * piece.above_px >= kLeastAside_px;
}

}  // namespace

bool CanTellThinStructures(const SceneView& view, const SceneGround& ground) {
  std::vector<float> known = ground.disparity_px.pixels();
  std::erase_if(known, [](float d) { return !std::isfinite(d); });
  if (known.empty()) {
    return false;
  }
  return view.range->FocalTimesBaseline() >=
         kNearestThin_m * static_cast<double>(UpperMedian(known));
}

std::vector<ThinPiece> FindThinStructures(const SceneView& view, const SceneGround& ground,
                                          const OlderViews& older) {
  std::vector<ThinPiece> found;
  if (!CanTellThinStructures(view, ground)) {
    return found;
  }
  PieceMatcher matcher(view, ground);
  LineSums lines;
  MarkStrips upright{MarkDifferences(*view.left, ground), false};
  const MarkStrips across{Transposed(upright.marks), true};
  for (const MarkStrips* strips : {&std::as_const(upright), &across}) {
    std::vector<LinePiece> matched;
    for (int strip = 0; strip < strips->count(); ++strip) {
      for (LinePiece& piece : FindPieces(*strips, strip, kLeastSum, lines)) {
        if (matcher.Match(*strips, piece) && IsDisparitySeen(*strips, piece)) {
          matched.push_back(piece);
        }
      }
    }
    for (const auto& chain : Chains(matched, kLeastPieces)) {
      AddPieces(view, ground, *strips, chain, ThinHeight::kKnown, found);
    }
  }
  const std::vector<ThinPiece> along = FindAlongBaseline(view, ground, older, lines);
  found.insert(found.end(), along.begin(), along.end());
  return found;
}

}  // namespace palace
