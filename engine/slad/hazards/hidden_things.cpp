#include "engine/slad/hazards/hidden_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/model/site_standing.h"
#include "engine/slad/side_by_side.h"

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

double ValueAt(const GridF& layer, Cell place) { return static_cast<double>(layer.at(place)); }

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
/// b / 16) against bare ground. Where these are no large numbers two exponentials make them all:
/// `e` = exp(a / 4) and `f` = exp(-b / 16).
Likelihoods FromPowers(double e, double f) {
  const double e2 = e * e, e4 = e2 * e2, f2 = f * f, f4 = f2 * f2, f8 = f4 * f4, f16 = f8 * f8,
               f32 = f16 * f16;
  const std::array larger = {e4 * f16, e4 * e2 * f32 * f4, e4 * e4 * e2 * f32 * f32 * f32 * f4};
  const std::array smaller = {e * f, e2 * f4, e2 * e * f8 * f};
  Likelihoods of{0, 0, 1};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    of.larger += kShares[i] * larger[i];
    of.smaller += kShares[i] * smaller[i];
  }
  return of;
}

/// The same whatever the numbers, over the largest of them.
Likelihoods FromLogarithms(double a, double b) {
  const auto log_of = [&](double quarters) {
    return quarters * a / 4 - quarters * quarters * b / 16;
  };
  double most = 0;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    most = std::max({most, log_of(kLarger[i]), log_of(kSmaller[i])});
  }
  Likelihoods of{0, 0, std::exp(-most)};
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

/// q of a rock and of a hole together.
double HidesAt(double prior, double shown_m, double expected_m, double sigma_m,
               bool beside_hazard) {
  const double per_m2 = expected_m / (sigma_m * sigma_m);
  const double a = std::abs(shown_m) * per_m2, b = expected_m * per_m2 / 2;
  if (a - b < kNothing && std::abs(shown_m) < expected_m) {
    return 0;
  }
  if (a < kPowers && b < kPowers) {
    const double e = std::exp(a / 4), f = std::exp(-b / 16);
    return Hides(prior, FromPowers(e, f), beside_hazard) +
           Hides(prior, FromPowers(1 / e, f), beside_hazard);
  }
  return Hides(prior, FromLogarithms(a, b), beside_hazard) +
         Hides(prior, FromLogarithms(-a, b), beside_hazard);
}

/// What a thing would show at the place.
double Expected(const NarrowView& view, Cell place) {
  return kOverLimit * view.max_deviation_m * ValueAt(view.narrow.share, place);
}

/// Whether the ground around the cell's places may touch a hazard, a cell for its smear.
bool IsBesideHazard(const NarrowView& view, Cell cell) {
  return view.safe_distance_m != nullptr &&
         ValueAt(*view.safe_distance_m, cell) < view.narrow.ring_m + view.cell_m;
}

/// The chance that a mark at the place is of a thing over the limit.
double MarkHides(const NarrowView& view, Cell place) {
  const double share =
      ValueAt(view.narrow.mark_from_m, place) / (kOverLimit * view.max_deviation_m);
  return ValueAt(view.narrow.mark, place) * std::min(1.0, share * share);
}

/// The most of the cell's places, for a thing covers several.
double MarkHidesInCell(const NarrowView& view, Cell cell) {
  double most = 0;
  if (!IsBesideHazard(view, cell)) {
    ForPlaces(cell, [&](Cell place) { most = std::max(most, MarkHides(view, place)); });
  }
  return most;
}

/// Sum of q over the cell's places, of a rock and of a hole together; `prior` is the cell's.
double HidesInCell(const NarrowView& view, Cell cell, double prior) {
  const bool beside = IsBesideHazard(view, cell);
  const double of_place = prior / kPlaces;
  double hides = 0;
  ForPlaces(cell, [&](Cell place) {
    const double shown_m = ValueAt(view.narrow.prominence_m, place);
    const double sigma_m = ValueAt(view.narrow.sigma_m, place), expected_m = Expected(view, place);
    if (std::isnan(shown_m) || !(sigma_m > 0) || !(expected_m > 0)) {
      hides += 2 * of_place;  // what cannot be said hides what unknown ground hides
      return;
    }
    hides += HidesAt(of_place, shown_m, expected_m, sigma_m, beside);
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

/// Sums of the cells' figures over the disc around each cell; a cell beyond the map has `outside`.
GridF OverDiscs(const NarrowView& view, double radius_m, float outside, const auto& of_cell) {
  const int rows = view.narrow.share.rows() / kPerCell, cols = view.narrow.share.cols() / kPerCell;
  const double radius = std::min(radius_m / view.cell_m, 1.0 * std::max(rows, cols));
  const int reach = static_cast<int>(radius);
  std::vector<std::vector<float>> sums(static_cast<std::size_t>(rows));
  ForEach(rows, [&](int r) {
    std::vector<float> in_cell(static_cast<std::size_t>(cols));
    for (int c = 0; c < cols; ++c) {
      in_cell[static_cast<std::size_t>(c)] = static_cast<float>(of_cell(Cell{r, c}));
    }
    SumAlong(in_cell.data(), cols, reach, outside, sums[static_cast<std::size_t>(r)]);
  });
  GridF in_disc(rows, cols, 0.0F);
  ForEach(rows, [&](int r) {
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

}  // namespace

GridF HiddenThings(const NarrowView& view, double radius_m, double things_per_m2) {
  const double prior = things_per_m2 / 2 * view.cell_m * view.cell_m;
  return OverDiscs(view, radius_m, static_cast<float>(2 * prior),
                   [&](Cell cell) { return HidesInCell(view, cell, prior); });
}

GridF MarkedThings(const NarrowView& view, double radius_m) {
  return OverDiscs(view, radius_m, 0, [&](Cell cell) { return MarkHidesInCell(view, cell); });
}

void FlagMarks(const NarrowView& view, double beyond, Grid<std::uint8_t>& flags) {
  const int rows = view.narrow.share.rows() / kPerCell, cols = view.narrow.share.cols() / kPerCell;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      if (!(MarkHidesInCell(view, {r, c}) > beyond)) {
        continue;
      }
      if (flags.empty()) {
        flags = Grid<std::uint8_t>(rows, cols, kFlagNone);
      }
      flags.at(r, c) |= kFlagUnexplained;
    }
  }
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
        const double noise_m2 = std::pow(ValueAt(view.narrow.noise_m, place), 2);
        const double bumps_m2 = std::pow(ValueAt(view.narrow.sigma_m, place), 2) - noise_m2;
        const double then_m2 = bumps_m2 + squared * squared * noise_m2;
        const double shows_m = Expected(view, place);
        // q of a rock and of a hole, both far smaller than 1.
        hidden += 2 * prior * std::exp(-shows_m * shows_m / (2 * then_m2));
      });
    }
  }
  return known > 0 ? hidden * places / known : HUGE_VAL;
}

}  // namespace palace
