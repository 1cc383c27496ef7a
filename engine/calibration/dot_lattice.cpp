#include "engine/calibration/dot_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <set>

namespace palace {
namespace {

constexpr double kSymmetry = 0.35;   // of a step: opposite neighbours of a seed
constexpr double kAcceptance = 0.3;  // of a step: a dot at its predicted place
constexpr double kMostSizeRatio =
    4.5;  // of the areas of neighbours; marks are up to 4 times larger
constexpr int kSeeds = 60;
constexpr int kReach = 3;  // grid steps over which places are predicted
constexpr int kGap = 2;    // dots that may miss in a row
constexpr std::size_t kLeastLattice = 9;

using Place = std::pair<int, int>;

/// Neighbours in the picture. Plain search: boards have hundreds of dots.
class Nearby {
 public:
  explicit Nearby(const std::vector<Dot>& dots) : dots_(dots) {}

  /// Nearest dot that `accept` takes within `radius_px`.
  template <typename Accept>
  std::optional<std::size_t> Nearest(const Eigen::Vector2d& at, double radius_px,
                                     Accept accept) const {
    std::optional<std::size_t> best;
    double least = radius_px * radius_px;
    for (std::size_t k = 0; k < dots_.size(); ++k) {
      const double square = (dots_[k].centre - at).squaredNorm();
      if (square <= least && accept(k)) {
        least = square;
        best = k;
      }
    }
    return best;
  }

  /// The `count` nearest to dot k, nearest first.
  std::vector<std::size_t> Around(std::size_t k, std::size_t count) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t other = 0; other < dots_.size(); ++other) {
      if (other != k) {
        order.emplace_back((dots_[other].centre - dots_[k].centre).squaredNorm(), other);
      }
    }
    const std::size_t kept = std::min(count, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept),
                      order.end());
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < kept; ++i) {
      near.push_back(order[i].second);
    }
    return near;
  }

 private:
  const std::vector<Dot>& dots_;
};

bool SimilarSize(const Dot& a, const Dot& b) {
  const double ratio = a.area_px / b.area_px;
  return ratio < kMostSizeRatio && ratio > 1 / kMostSizeRatio;
}

struct Seed {
  std::size_t dot = 0;
  Eigen::Vector2d step_i = Eigen::Vector2d::Zero();
  Eigen::Vector2d step_j = Eigen::Vector2d::Zero();
};

/// Two pairs of opposite neighbours, the shorter steps first.
std::optional<Seed> SeedAt(const std::vector<Dot>& dots, const Nearby& nearby, std::size_t k) {
  constexpr std::size_t kNeighbours = 10;
  std::vector<Eigen::Vector2d> steps;
  for (const std::size_t n : nearby.Around(k, kNeighbours)) {
    const Eigen::Vector2d step = dots[n].centre - dots[k].centre;
    if (!SimilarSize(dots[n], dots[k])) {
      continue;
    }
    const auto opposite =
        nearby.Nearest(dots[k].centre - step, kSymmetry * step.norm(),
                       [&](std::size_t o) { return o != k && SimilarSize(dots[o], dots[k]); });
    if (!opposite) {
      continue;
    }
    const Eigen::Vector2d mean = (step + dots[k].centre - dots[*opposite].centre) / 2;
    const bool known = std::any_of(steps.begin(), steps.end(), [&](const Eigen::Vector2d& s) {
      return std::abs(s.x() * mean.y() - s.y() * mean.x()) < 0.3 * s.norm() * mean.norm();
    });
    if (!known) {
      steps.push_back(mean);
    }
    if (steps.size() == 2) {
      Seed seed{k, steps[0], steps[1]};
      if (steps[0].x() * steps[1].y() - steps[0].y() * steps[1].x() < 0) {
        seed.step_j = -steps[1];
      }
      return seed;
    }
  }
  return std::nullopt;
}

/// A lattice that grows.
class Growth {
 public:
  Growth(const std::vector<Dot>& dots, const Nearby& nearby, const Seed& seed)
      : dots_(dots), nearby_(nearby), seed_(seed) {
    Assign({0, 0}, seed.dot);
  }

  DotLattice Run() {
    while (!queue_.empty()) {
      const Place from = queue_.front();
      queue_.pop_front();
      for (const auto& [di, dj] : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}}) {
        for (int hop = 1; hop <= kGap + 1; ++hop) {
          if (TryPlace({from.first + hop * di, from.second + hop * dj})) {
            break;
          }
        }
      }
    }
    DropStrays();
    return lattice_;
  }

 private:
  struct Prediction {
    Eigen::Vector2d pixel;
    double step_px = 0;  ///< the shorter of the two steps here
  };

  void Assign(const Place& place, std::size_t dot) {
    lattice_[place] = dot;
    used_.insert(dot);
    queue_.push_back(place);
  }

  /// Where the dot of `place` should be: a plane through the dots placed nearby, pixel = p0 + i a +
  /// j b, near ones counting more. The seed's steps are part of the fit until dots outnumber them.
  std::optional<Prediction> Predict(const Place& place) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    int count = 0;
    for (int i = -kReach; i <= kReach; ++i) {
      for (int j = -kReach; j <= kReach; ++j) {
        const auto found = lattice_.find({place.first + i, place.second + j});
        if ((i == 0 && j == 0) || found == lattice_.end()) {
          continue;
        }
        const double weight = 1.0 / (i * i + j * j);
        const Eigen::Vector3d row(1, i, j);
        normal += weight * weight * row * row.transpose();
        right += weight * weight * row * dots_[found->second].centre.transpose();
        ++count;
      }
    }
    if (count == 0) {
      return std::nullopt;
    }
    constexpr double kSeedWeight = 1e-4;
    normal(1, 1) += kSeedWeight;
    normal(2, 2) += kSeedWeight;
    right.row(1) += kSeedWeight * seed_.step_i.transpose();
    right.row(2) += kSeedWeight * seed_.step_j.transpose();
    const Eigen::Matrix<double, 3, 2> plane = normal.ldlt().solve(right);
    return Prediction{plane.row(0).transpose(), std::min(plane.row(1).norm(), plane.row(2).norm())};
  }

  bool TryPlace(const Place& place) {
    if (lattice_.contains(place)) {
      return true;
    }
    const auto predicted = Predict(place);
    if (!predicted || !(predicted->step_px > 1)) {
      return false;
    }
    const auto dot =
        nearby_.Nearest(predicted->pixel, kAcceptance * predicted->step_px, [&](std::size_t k) {
          return !used_.contains(k) && SimilarSize(dots_[k], dots_[seed_.dot]);
        });
    if (!dot) {
      return false;
    }
    Assign(place, *dot);
    return true;
  }

  /// Dots that sit off the place their neighbours predict belong to something else.
  void DropStrays() {
    std::vector<Place> strays;
    for (const auto& [place, dot] : lattice_) {
      const auto predicted = Predict(place);
      if (!predicted ||
          (predicted->pixel - dots_[dot].centre).norm() > kAcceptance * predicted->step_px) {
        strays.push_back(place);
      }
    }
    for (const Place& place : strays) {
      lattice_.erase(place);
    }
  }

  const std::vector<Dot>& dots_;
  const Nearby& nearby_;
  const Seed seed_;
  DotLattice lattice_;
  std::set<std::size_t> used_;
  std::deque<Place> queue_;
};

double Fullness(const DotLattice& lattice) {
  const LatticeExtent extent = ExtentOf(lattice);
  return static_cast<double>(lattice.size()) /
         (static_cast<double>(extent.columns()) * extent.rows());
}

/// The basis with the fullest bounding box among those a slant can exchange.
DotLattice FullestBasis(const DotLattice& lattice) {
  // (i, j) -> (a i + b j, c i + d j), determinant 1.
  constexpr std::array<std::array<int, 4>, 5> kBases = {
      {{1, 0, 0, 1}, {1, 1, 0, 1}, {1, -1, 0, 1}, {1, 0, 1, 1}, {1, 0, -1, 1}}};
  DotLattice best;
  for (const auto& [a, b, c, d] : kBases) {
    DotLattice changed;
    for (const auto& [place, dot] : lattice) {
      changed[{a * place.first + b * place.second, c * place.first + d * place.second}] = dot;
    }
    if (best.empty() || Fullness(changed) > Fullness(best)) {
      best = std::move(changed);
    }
  }
  return best;
}

}  // namespace

LatticeExtent ExtentOf(const DotLattice& lattice) {
  LatticeExtent extent;
  bool first = true;
  for (const auto& [place, dot] : lattice) {
    const auto [i, j] = place;
    extent.i_min = first ? i : std::min(extent.i_min, i);
    extent.i_max = first ? i : std::max(extent.i_max, i);
    extent.j_min = first ? j : std::min(extent.j_min, j);
    extent.j_max = first ? j : std::max(extent.j_max, j);
    first = false;
  }
  return extent;
}

DotLattice FindLattice(const std::vector<Dot>& dots) {
  const Nearby nearby(dots);
  // Seeds from the middle of the dots outwards: the board's rim is the worst place to begin.
  std::vector<std::size_t> order(dots.size());
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < dots.size(); ++k) {
    order[k] = k;
    middle += dots[k].centre / static_cast<double>(dots.size());
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (dots[a].centre - middle).squaredNorm() < (dots[b].centre - middle).squaredNorm();
  });
  DotLattice best;
  std::set<std::size_t> covered;
  int seeds = 0;
  for (const std::size_t k : order) {
    if (covered.contains(k)) {
      continue;
    }
    const auto seed = SeedAt(dots, nearby, k);
    if (!seed || ++seeds > kSeeds) {
      continue;
    }
    DotLattice grown = Growth(dots, nearby, *seed).Run();
    for (const auto& [place, dot] : grown) {
      covered.insert(dot);
    }
    if (grown.size() > best.size()) {
      best = std::move(grown);
    }
    if (2 * best.size() > dots.size()) {
      break;  // no other lattice can be larger
    }
  }
  return best.size() < kLeastLattice ? DotLattice{} : FullestBasis(best);
}

DotLattice TurnLattice(const DotLattice& lattice, int quarters) {
  DotLattice turned = lattice;
  for (int q = 0; q < (quarters % 4 + 4) % 4; ++q) {
    DotLattice next;
    for (const auto& [place, dot] : turned) {
      next[{place.second, -place.first}] = dot;
    }
    turned = std::move(next);
  }
  return turned;
}

}  // namespace palace
