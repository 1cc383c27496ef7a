#include "engine/slad/pictures/along_baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "engine/slad/pictures/line_marks.h"
#include "engine/slad/pictures/line_parallax.h"
#include "engine/slad/pictures/line_pieces.h"
#include "engine/slad/pictures/thin_piece.h"

namespace palace {
namespace {

using Chain = std::vector<LinePiece>;

constexpr double kMostClimb = 0.58;  // rows a column: 30 degrees
constexpr int kLeastSum = 110;       // of 224
constexpr std::size_t kLeastPieces = 4;
// With its height.
constexpr double kRowsAgree_px = 0.3;        // of a rig, one sigma
constexpr double kLeastContrast_grey = 2.5;  // sensor noise
constexpr double kFoundAgain = 0.5;          // of the line's contrast in the left picture, at least
constexpr double kNoStronger = 1.5;          // and at most
constexpr double kAlone = 0.6;               // of it, what is found elsewhere
constexpr double kNotAtGround = 0.8;         // of its contrast where it is found again
// Without.
constexpr double kMostLevel_px = 2;  // over a strip
constexpr double kLeastShare = 0.6;  // of the picture's width
constexpr double kSure_sigmas = 3;   // … of the height that motion tells

/// Mean grey across a chain, row by row from kReach above the line to kReach below it.
struct Profile {
  static constexpr int kReach = kMostAside_px + 1 + kRidge_px;  // and a row for the parabola
  std::array<double, 2 * kReach + 1> grey{};

  double At(int row) const { return grey[static_cast<std::size_t>(row + kReach)]; }
  /// How much darker the row is than those beside it.
  double Darker(int row) const { return (At(row - kRidge_px) + At(row + kRidge_px)) / 2 - At(row); }
};

/// Rows a column, through the middles of the pieces.
double ClimbOf(const Chain& chain) {
  double mean_strip = 0, mean_row = 0;
  for (const LinePiece& piece : chain) {
    mean_strip += piece.strip;
    mean_row += (piece.from + piece.to) / 2;
  }
  mean_strip /= static_cast<double>(chain.size());
  mean_row /= static_cast<double>(chain.size());
  double product = 0, square = 0;
  for (const LinePiece& piece : chain) {
    const double strip = piece.strip - mean_strip;
    product += strip * ((piece.from + piece.to) / 2 - mean_row);
    square += strip * strip;
  }
  return square > 0 ? product / (square * kStrip_px) : 0;
}

/// Nothing when hardly any of the chain has ground on both sides in both pictures.
std::optional<Profile> ProfileOf(const ImageU8& picture, const SceneGround& ground,
                                 const MarkStrips& strips, const Chain& chain) {
  Profile profile;
  int count = 0;
  for (const LinePiece& piece : chain) {
    for (int k = 0; k < kStrip_px; ++k) {
      const Eigen::Vector2d pixel = strips.Pixel(piece, k / double(kStrip_px - 1));
      const int x = static_cast<int>(std::lround(pixel.x()));
      const int y = static_cast<int>(std::lround(pixel.y()));
      if (y < Profile::kReach || y + Profile::kReach >= ground.rows() * kBlock_px ||
          x >= ground.cols() * kBlock_px || ground.usable.at(x / kBlock_px, y / kBlock_px) == 0) {
        continue;
      }
      ++count;
      for (int row = -Profile::kReach; row <= Profile::kReach; ++row) {
        profile.grey[static_cast<std::size_t>(row + Profile::kReach)] += picture.at(x, y + row);
      }
    }
  }
  if (count < static_cast<int>(kLeastPieces) * kStrip_px / 2) {
    return std::nullopt;
  }
  for (double& grey : profile.grey) {
    grey /= count;
  }
  return profile;
}

/// Disparity of a chain beyond the ground's; nothing where it lies on the ground, is not found
/// again or runs too nearly along the baseline.
std::optional<LineAbove> AboveGround(const ImageU8& left, const SceneGround& ground,
                                     const MarkStrips& strips, const Chain& chain) {
  const double climb = ClimbOf(chain);
  const double reach_px = std::min(std::abs(climb) * kMostAbove_px, double{kMostAside_px});
  if (reach_px < kLeastAside_px) {
    return std::nullopt;
  }
  const auto in_left = ProfileOf(left, ground, strips, chain);
  const auto in_right = ProfileOf(ground.right, ground, strips, chain);
  if (!in_left || !in_right) {
    return std::nullopt;
  }
  const double contrast = in_left->Darker(0);
  const auto found = [&](int row) {
    return contrast > 0 ? in_right->Darker(row) : -in_right->Darker(row);
  };
  const int side = climb > 0 ? 1 : -1;
  int best = side;
  for (int k = 1; k <= static_cast<int>(reach_px); ++k) {
    best = found(k * side) > found(best) ? k * side : best;
  }
  const double peak = found(best);
  if (std::abs(contrast) < kLeastContrast_grey || peak < kFoundAgain * std::abs(contrast) ||
      peak > kNoStronger * std::abs(contrast) || found(0) > kNotAtGround * peak) {
    return std::nullopt;
  }
  for (int k = -static_cast<int>(reach_px); k <= static_cast<int>(reach_px); ++k) {
    if (std::abs(k - best) > kRidge_px && found(k) > kAlone * peak) {
      return std::nullopt;
    }
  }
  const double before = found(best - 1), after = found(best + 1);
  const double bend = before - 2 * peak + after;
  const double aside_px =
      best + (bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0);
  if (std::abs(aside_px) < kLeastAside_px) {
    return std::nullopt;
  }
  return LineAbove{aside_px / climb, kRowsAgree_px / std::abs(climb)};
}

bool IsLevel(const LinePiece& piece) { return std::abs(piece.to - piece.from) <= kMostLevel_px; }

void SetAbove(Chain& chain, double above_px) {
  for (LinePiece& piece : chain) {
    piece.above_px = above_px;
  }
}

/// Whether it stands above the ground, by what the vehicle's own motion tells.
bool Stands(const LineAbove& above) { return above.px > kSure_sigmas * above.sigma_px; }
/// … and how high.
bool IsHeightTold(const LineAbove& above) { return above.px >= 2 * kSure_sigmas * above.sigma_px; }

/// Of a line that runs too nearly along the baseline for the pair.
ThinHeight HeightByMotion(const std::optional<LineAbove>& above, Chain& chain) {
  if (above && IsHeightTold(*above)) {
    SetAbove(chain, above->px);
    return ThinHeight::kKnown;
  }
  const bool lies =
      above && !Stands(*above) && above->px + kSure_sigmas * above->sigma_px < kLeastAbove_px;
  return lies ? ThinHeight::kOnGround : ThinHeight::kUnknown;
}

}  // namespace

std::vector<ThinPiece> FindAlongBaseline(const SceneView& view, const SceneGround& ground,
                                         const OlderViews& older, LineSums& lines) {
  const MarkStrips strips{Transposed(MarkRidges(*view.left)), true};
  Chain all;
  for (int strip = 0; strip < strips.count(); ++strip) {
    for (const LinePiece& piece : FindPieces(strips, strip, kLeastSum, lines)) {
      if (std::abs(piece.to - piece.from) <= kMostClimb * (kStrip_px - 1)) {
        all.push_back(piece);
      }
    }
  }
  // Made when a line asks for it.
  std::optional<LineParallax> made;
  const auto by_motion = [&](const Chain& chain) {
    const LineParallax& parallax = made ? *made : made.emplace(view, ground, older);
    return parallax.Above(strips, chain);
  };
  std::vector<ThinPiece> found;
  Chain level;  // of lines whose height the pair does not tell
  for (Chain& chain : Chains(all, kLeastPieces)) {
    const auto by_pair = AboveGround(*view.left, ground, strips, chain);
    if (!by_pair) {
      std::copy_if(chain.begin(), chain.end(), std::back_inserter(level), IsLevel);
      continue;
    }
    const auto moved = by_motion(chain);
    const bool better = moved && moved->sigma_px < by_pair->sigma_px && IsHeightTold(*moved);
    SetAbove(chain, better ? moved->px : by_pair->px);
    AddPieces(view, ground, strips, chain, ThinHeight::kKnown, found);
  }
  const auto least = static_cast<std::size_t>(std::ceil(kLeastShare * strips.count()));
  for (Chain& chain : Chains(level, std::max(least, kLeastPieces))) {
    const ThinHeight height = HeightByMotion(by_motion(chain), chain);
    AddPieces(view, ground, strips, chain, height, found);
  }
  return found;
}

}  // namespace palace
