#include "engine/slad/hazards/hidden_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

namespace palace {
namespace {

constexpr double kOverLimit = 1.2;  // of the limit: what counts as unsafe
constexpr double kNothing = -25;    // logarithm below which a place hides nothing
constexpr double kPowers = 40;      // up to which powers keep their digits
// Sizes of things over the limit and of those below it, as quarters of it, and their shares: each
// half as many as the one before (power law of rocks).
constexpr std::array kLarger = {4.0, 6.0, 10.0}, kSmaller = {1.0, 2.0, 3.0};
constexpr std::array kShares = {0.57, 0.29, 0.14};

constexpr int kPerCell = NarrowFigures::kPerCell;
constexpr int kPlaces = kPerCell * kPerCell;  // of a cell

double Figure(const GridF& layer, Cell place) { return static_cast<double>(layer.at(place)); }

/// Calls work(place) for the places of a cell.
template <typename Work>
void ForPlaces(Cell cell, Work work) {
  for (int i = 0; i < kPerCell; ++i) {
    for (int j = 0; j < kPerCell; ++j) {
      work(Cell{kPerCell * cell.row + i, kPerCell * cell.col + j});
    }
  }
}

/// Mean likelihoods of things over the limit, of smaller ones and of bare ground, over a common
/// one.
struct Likelihoods {
  double larger = 0, smaller = 0, bare = 0;
};

/// With a = r p / s^2 and b = r^2 / (2 s^2), of a thing k / 4 times the limit's: exp(k a / 4 - k^2
/// b / 16) against nothing seen with s. Where these are no large numbers two exponentials make them
/// all: `e` = exp(a / 4) and `f` = exp(-b / 16).
Likelihoods FromPowers(double e, double f, double bare) {
  const double e2 = e * e, e4 = e2 * e2, f2 = f * f, f4 = f2 * f2, f8 = f4 * f4, f16 = f8 * f8,
               f32 = f16 * f16;
  const std::array larger = {e4 * f16, e4 * e2 * f32 * f4, e4 * e4 * e2 * f32 * f32 * f32 * f4};
  const std::array smaller = {e * f, e2 * f4, e2 * e * f8 * f};
  Likelihoods of{0, 0, bare};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    of.larger += kShares[i] * larger[i];
    of.smaller += kShares[i] * smaller[i];
  }
  return of;
}

/// The same whatever the numbers, over the largest of them.
Likelihoods FromLogarithms(double a, double b, double log_bare) {
  const auto log_of = [&](double quarters) {
    return quarters * a / 4 - quarters * quarters * b / 16;
  };
  double most = log_bare;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    most = std::max({most, log_of(kLarger[i]), log_of(kSmaller[i])});
  }
  Likelihoods of{0, 0, std::exp(log_bare - most)};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    of.larger += kShares[i] * std::exp(log_of(kLarger[i]) - most);
    of.smaller += kShares[i] * std::exp(log_of(kSmaller[i]) - most);
  }
  return of;
}

/// q of things on one side.
double Hides(double prior, const Likelihoods& of, bool beside_hazard) {
  const double larger = beside_hazard ? std::min(of.larger, of.bare) : of.larger;
  const double all = of.bare + prior * (larger + of.smaller);
  return all > 0 ? prior * larger / all : 0;  // beside a hazard nothing else may be left
}

/// What is known at a place.
struct AtPlace {
  double shown_m;     ///< p
  double expected_m;  ///< r
  double share;
  double noise_m2, bumps_m2;  ///< squared sigmas of p
  /// s^2: of what a thing shows of whose height the bump under it is part.
  double ThingVariance() const { return noise_m2 + (1 - share) * (1 - share) * bumps_m2; }
  double BareVariance() const { return noise_m2 + bumps_m2; }
};

AtPlace Look(const NarrowView& view, Cell place) {
  const double noise_m = Figure(view.narrow.noise_m, place);
  const double sigma_m = Figure(view.narrow.sigma_m, place);
  const double share = Figure(view.narrow.share, place);
  const double bumps_m2 = sigma_m * sigma_m - noise_m * noise_m;
  return {Figure(view.narrow.prominence_m, place), kOverLimit * view.max_deviation_m * share, share,
          noise_m * noise_m, bumps_m2 < 0 ? 0 : bumps_m2};  // NaN stays
}

/// q of a rock and of a hole together.
double HidesAt(double prior, const AtPlace& at, bool beside_hazard) {
  const double variance_m2 = at.ThingVariance();
  const double per_m2 = at.expected_m / variance_m2;
  const double a = std::abs(at.shown_m) * per_m2, b = at.expected_m * per_m2 / 2;
  // Of bare ground, against nothing seen with s.
  const double wider = at.bumps_m2 > 0 ? variance_m2 / at.BareVariance() : 1;
  const double log_bare =
      wider < 1 ? std::log(wider) / 2 + at.shown_m * at.shown_m * (1 - wider) / (2 * variance_m2)
                : 0;
  if (a - b - log_bare < kNothing && std::abs(at.shown_m) < at.expected_m) {
    return 0;
  }
  if (a < kPowers && b < kPowers && log_bare < kPowers) {
    const double e = std::exp(a / 4), f = std::exp(-b / 16);
    const double bare = wider < 1 ? std::exp(log_bare) : 1;
    return Hides(prior, FromPowers(e, f, bare), beside_hazard) +
           Hides(prior, FromPowers(1 / e, f, bare), beside_hazard);
  }
  return Hides(prior, FromLogarithms(a, b, log_bare), beside_hazard) +
         Hides(prior, FromLogarithms(-a, b, log_bare), beside_hazard);
}

/// Whether the ground around the cell's places may touch a hazard, a cell for its smear.
bool IsBesideHazard(const NarrowView& view, Cell cell) {
  return view.safe_distance_m != nullptr &&
         Figure(*view.safe_distance_m, cell) < view.narrow.ring_m + view.cell_m;
}

/// Sum of q over the cell's places, of a rock and of a hole together; `prior` is the cell's.
double HidesInCell(const NarrowView& view, Cell cell, double prior) {
  const bool beside = IsBesideHazard(view, cell);
  const double of_place = prior / kPlaces;
  double hides = 0;
  ForPlaces(cell, [&](Cell place) {
    const AtPlace at = Look(view, place);
    if (std::isnan(at.shown_m) || !(at.ThingVariance() > 0) || !(at.expected_m > 0)) {
      hides += 2 * of_place;  // what cannot be said hides what unknown ground hides
      return;
    }
    hides += HidesAt(of_place, at, beside);
  });
  return hides;
}

/// Sums from a row's beginning, `reach` cells wider than it on both sides, where every cell hides
/// `outside`.
void SumAlong(const float* row, int cols, int reach, float outside, std::vector<float>& sum) {
  sum.assign(static_cast<std::size_t>(cols + 2 * reach + 1), 0.0F);
  float total = 0;
  for (int c = -reach; c < cols + reach; ++c) {
    total += c >= 0 && c < cols ? row[c] : outside;
    sum[static_cast<std::size_t>(c + reach + 1)] = total;
  }
}

template <typename RowWork>
void ForRows(int rows, RowWork work) {
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      work(r);
    }
  });
}

}  // namespace

GridF HiddenThings(const NarrowView& view, double radius_m, double things_per_m2) {
  const int rows = view.narrow.share.rows() / kPerCell, cols = view.narrow.share.cols() / kPerCell;
  const double prior = things_per_m2 / 2 * view.cell_m * view.cell_m;
  const double radius = std::min(radius_m / view.cell_m, 1.0 * std::max(rows, cols));
  const int reach = static_cast<int>(radius);
  const float outside = static_cast<float>(2 * prior);
  std::vector<std::vector<float>> sums(static_cast<std::size_t>(rows));
  ForRows(rows, [&](int r) {
    std::vector<float> in_cell(static_cast<std::size_t>(cols));
    for (int c = 0; c < cols; ++c) {
      in_cell[static_cast<std::size_t>(c)] = static_cast<float>(HidesInCell(view, {r, c}, prior));
    }
    SumAlong(in_cell.data(), cols, reach, outside, sums[static_cast<std::size_t>(r)]);
  });
  GridF in_disc(rows, cols, 0.0F);
  ForRows(rows, [&](int r) {
    float* out = in_disc.row(r);
    for (int dr = -reach; dr <= reach; ++dr) {
      const int half = static_cast<int>(std::sqrt(radius * radius - dr * dr));
      const bool inside = r + dr >= 0 && r + dr < rows;
      const float* sum = inside ? sums[static_cast<std::size_t>(r + dr)].data() + reach : nullptr;
      for (int c = 0; c < cols; ++c) {
        out[c] +=
            inside ? sum[c + half + 1] - sum[c - half] : static_cast<float>(2 * half + 1) * outside;
      }
    }
  });
  return in_disc;
}

double HiddenFromNearer(const NarrowView& view, Cell centre, double radius_m, double nearer,
                        double enough) {
  const double prior = kThingsPer_m2 / 2 * view.cell_m * view.cell_m / kPlaces;
  const double squared = nearer * nearer;
  const int rows = view.narrow.share.rows() / kPerCell, cols = view.narrow.share.cols() / kPerCell;
  const int reach = static_cast<int>(radius_m / view.cell_m);
  double hidden = 0;
  int places = 0, known = 0;
  for (int dr = -reach; dr <= reach && hidden <= enough; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      if (std::hypot(dr, dc) * view.cell_m > radius_m) {
        continue;
      }
      places += kPlaces;
      const Cell cell{centre.row + dr, centre.col + dc};
      if (cell.row < 0 || cell.col < 0 || cell.row >= rows || cell.col >= cols) {
        continue;
      }
      ForPlaces(cell, [&](Cell place) {
        if (std::isnan(view.narrow.prominence_m.at(place))) {
          return;
        }
        ++known;
        AtPlace then = Look(view, place);
        then.noise_m2 *= squared * squared;
        const double thing_m2 = then.ThingVariance();
        // q of a rock and of a hole, both far smaller than 1.
        hidden += 2 * prior * std::sqrt(then.BareVariance() / thing_m2) *
                  std::exp(-then.expected_m * then.expected_m / (2 * thing_m2));
      });
    }
  }
  return known > 0 ? hidden * places / known : HUGE_VAL;
}

}  // namespace palace
