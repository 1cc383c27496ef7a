#include "engine/world/families/hazard_lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector2d;

// The farthest from four corners of a square is half its diagonal; jitter adds at most its own.
constexpr double kApart_m = 1.6;
constexpr double kJitter_m = 0.22;
static_assert(kApart_m * 0.7072 + kJitter_m * 1.4143 <= kLatticeGap_m);

constexpr double kLow_m = -48, kSquare_m = 2;
constexpr int kSquares = 60;
constexpr double kReach_m = 0.9;  // of a mound with its bank

int SquareOf(double at_m) {
  return std::clamp(static_cast<int>((at_m - kLow_m) / kSquare_m), 0, kSquares - 1);
}

}  // namespace

std::vector<Vector2d> HazardLattice(RandomStream& random, const Vector2d& middle, double half_m) {
  const double turn = DrawAngle(random);
  const Vector2d along(std::cos(turn), std::sin(turn)), across(-along.y(), along.x());
  // Turned, it must reach the corners.
  const int reach = static_cast<int>(std::ceil(half_m * 1.4143 / kApart_m));
  std::vector<Vector2d> places;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const double u = i * kApart_m + random.Uniform(-kJitter_m, kJitter_m);
      const double v = j * kApart_m + random.Uniform(-kJitter_m, kJitter_m);
      const Vector2d place = middle + u * along + v * across;
      if ((place - middle).cwiseAbs().maxCoeff() < half_m) {
        places.push_back(place);
      }
    }
  }
  return places;
}

Mound DrawMound(RandomStream& random, const Vector2d& place_m) {
  const double radius_m = random.Uniform(0.2, 0.42), up_m = random.Uniform(0.28, 0.45);
  const bool hole = Chance(random, 0.5);
  return {Blob(random, place_m, radius_m, 0.12), hole ? -up_m : up_m, hole ? 0.07 : 0.12};
}

MoundsAndStones DrawHazards(RandomStream& random, const std::vector<Vector2d>& places, double share,
                            const std::function<bool(const Vector2d&)>& may_be_stone) {
  MoundsAndStones drawn;
  for (const Vector2d& place : places) {
    if (may_be_stone(place) && Chance(random, share)) {
      drawn.stones_at.push_back(place);
    } else {
      drawn.mounds.push_back(DrawMound(random, place));
    }
  }
  return drawn;
}

MoundField::MoundField(std::vector<Mound> mounds) : mounds_(std::move(mounds)) {
  near_.resize(static_cast<std::size_t>(kSquares * kSquares));
  for (std::uint32_t i = 0; i < mounds_.size(); ++i) {
    const Vector2d& at = mounds_[i].outline.middle_m();
    for (int row = SquareOf(at.x() - kReach_m); row <= SquareOf(at.x() + kReach_m); ++row) {
      for (int col = SquareOf(at.y() - kReach_m); col <= SquareOf(at.y() + kReach_m); ++col) {
        near_[static_cast<std::size_t>(row * kSquares + col)].push_back(i);
      }
    }
  }
}

double MoundField::Height(double north_m, double east_m) const {
  double up_m = 0;
  for (const std::uint32_t i :
       near_[static_cast<std::size_t>(SquareOf(north_m) * kSquares + SquareOf(east_m))]) {
    const Mound& mound = mounds_[i];
    const double share = WallShare(mound.outline.Inside(north_m, east_m), mound.bank_m);
    const double height = share * mound.up_m;
    up_m = std::abs(height) > std::abs(up_m) ? height : up_m;
  }
  return up_m;
}

}  // namespace palace
