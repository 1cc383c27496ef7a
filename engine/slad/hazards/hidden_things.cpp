#include "engine/slad/hazards/hidden_things.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/slad/terrain/narrow_relief.h"

namespace palace {
namespace {

constexpr double kOverLimit = 1.2;    // of the limit: what counts as unsafe
constexpr double kRuledOut = -3.912;  // the logarithm of one in fifty
constexpr double kNothing = -25;      // logarithm below which a cell hides nothing

double Figure(const GridF& layer, Cell cell) { return static_cast<double>(layer.at(cell)); }

double LogRatio(double shown_m, double expected_m, double sigma_m) {
  return expected_m * (2 * shown_m - expected_m) / (2 * sigma_m * sigma_m);
}

/// q of things on one side, where `shown_m` counts towards it.
double Hides(double prior, double shown_m, double expected_m, double sigma_m, bool beside_hazard) {
  const double as_limit = LogRatio(shown_m, expected_m, sigma_m);
  if (as_limit < kNothing) {
    return 0;
  }
  // The best of the larger ones, and of the smaller ones, shows just what is there.
  const double at_best = shown_m > 0 ? shown_m * shown_m / (2 * sigma_m * sigma_m) : 0;
  const double larger = shown_m < expected_m ? as_limit : at_best;
  const double smaller = shown_m < expected_m ? at_best : as_limit;
  const double most = beside_hazard ? std::min(larger, 0.0) : larger;
  return 1 / (1 + std::exp(-most) / prior + std::exp(smaller - larger));
}

/// What a thing would show in the cell.
double Expected(const NarrowView& view, Cell cell) {
  return kOverLimit * view.max_deviation_m * Figure(view.narrow.share, cell);
}

/// Whether the ring around the cell may touch a hazard: 1.25 times as wide as a thing is smeared, a
/// cell for the hazard's own smear.
bool IsBesideHazard(const NarrowView& view, Cell cell) {
  if (view.safe_distance_m == nullptr) {
    return false;
  }
  const double smear_m = std::sqrt(SmearedOfShare(Figure(view.narrow.share, cell)));
  const double ring_m = std::max(2 * view.cell_m, kRingWindows * smear_m);
  return Figure(*view.safe_distance_m, cell) < ring_m + view.cell_m;
}

/// q of a rock and of a hole together.
double HidesInCell(const NarrowView& view, Cell cell, double prior) {
  const double shown_m = Figure(view.narrow.prominence_m, cell);
  if (std::isnan(shown_m)) {
    return 2 * prior;
  }
  const double sigma_m = Figure(view.narrow.sigma_m, cell), expected_m = Expected(view, cell);
  const bool beside = IsBesideHazard(view, cell);
  return Hides(prior, shown_m, expected_m, sigma_m, beside) +
         Hides(prior, -shown_m, expected_m, sigma_m, beside);
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
  const int rows = view.narrow.share.rows(), cols = view.narrow.share.cols();
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

double HiddenFromNearer(const NarrowView& view, const GridF& variance_m2, Cell centre,
                        double radius_m, double nearer, double enough) {
  constexpr double kOfBareGround = 1.5;  // of narrow relief, over the variance of its cell
  const double prior = kThingsPer_m2 / 2 * view.cell_m * view.cell_m;
  const double cell_m2 = view.cell_m * view.cell_m;
  const double squared = nearer * nearer;
  const int reach = static_cast<int>(radius_m / view.cell_m);
  double hidden = 0;
  int cells = 0, known = 0;
  for (int dr = -reach; dr <= reach && hidden <= enough; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      if ((dr * dr + dc * dc) * cell_m2 > radius_m * radius_m) {
        continue;
      }
      ++cells;
      const Cell cell{centre.row + dr, centre.col + dc};
      const bool inside = cell.row >= 0 && cell.col >= 0 && cell.row < view.narrow.share.rows() &&
                          cell.col < view.narrow.share.cols();
      if (!inside || std::isnan(view.narrow.prominence_m.at(cell))) {
        continue;
      }
      ++known;
      const double sigma_m2 = std::pow(Figure(view.narrow.sigma_m, cell), 2);
      const double noise_m2 = std::min(sigma_m2, kOfBareGround * Figure(variance_m2, cell));
      const double window_m2 =
          std::max(0.0, SmearedOfShare(Figure(view.narrow.share, cell)) - cell_m2);
      const double share = ShareOfSmeared(squared * window_m2 + cell_m2);
      const double then_m2 = sigma_m2 - noise_m2 + squared * squared * noise_m2;
      const double shows_m = kOverLimit * view.max_deviation_m * share;
      // q of a rock and of a hole, both far smaller than 1.
      hidden += 2 * prior * std::exp(-shows_m * shows_m / (2 * then_m2));
    }
  }
  return known > 0 ? hidden * cells / known : HUGE_VAL;
}

bool IsSeen(const NarrowView& view, Cell cell) {
  const double shown_m = std::abs(Figure(view.narrow.prominence_m, cell));
  // False of NaN: nothing is known.
  return LogRatio(shown_m, Expected(view, cell), Figure(view.narrow.sigma_m, cell)) <= kRuledOut;
}

}  // namespace palace
