#include "engine/slad/sites/site_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/model/site_standing.h"
#include "engine/slad/hazards/safe_distance.h"

namespace palace {
namespace {

/// Places that touch and are as good as the best to within so many cells are equal.
constexpr double kEqual_cells = 0.75;
// Weights that break ties of safe distance, within one cell's worth of it, the resolution of the
// first criterion: of the cost, and of nearness to the middle of the picture.
constexpr double kCostWeight_cells = 0.4, kMiddleWeight_cells = 0.05;
constexpr double kDistanceWeight_per_m = 1e-3;  // breaks ties of cost
/// By which the score of one place over still ground changes from map to map.
constexpr double kNoise_cells = 2;
constexpr double kNoiseOfCost = 0.05;

/// Cost averaged over 3x3 cells, so that a lone cheap cell beside dear ones does not win (4.3.3).
double SmoothedCost(const GridF& cost, Cell cell) {
  double sum = 0;
  int count = 0;
  for (int r = std::max(0, cell.row - 1); r <= std::min(cost.rows() - 1, cell.row + 1); ++r) {
    for (int c = std::max(0, cell.col - 1); c <= std::min(cost.cols() - 1, cell.col + 1); ++c) {
      const float value = cost.at(r, c);
      sum += std::isnan(value) ? 1.0 : static_cast<double>(value);
      ++count;
    }
  }
  return sum / count;
}

/// Distance of a place from the middle of the picture as a share of the picture's half diagonal;
/// without a picture, 0.
class OffCentre {
 public:
  explicit OffCentre(const SiteContext& context)
      : camera_(context.camera), X_CW_(context.X_WC.Inverse()) {}

  double At(const ElevationMap& map, Cell cell) const {
    if (camera_.width == 0) {
      return 0;
    }
    const float height = map.height_m.at(cell);
    const Eigen::Vector3d p_WS(map.geometry.NorthOfRow(cell.row), map.geometry.EastOfCol(cell.col),
                               std::isnan(height) ? 0.0 : -static_cast<double>(height));
    const Eigen::Vector3d p_CS = X_CW_ * p_WS;
    if (!(p_CS.z() > 0)) {
      return 2;
    }
    const double x = camera_.fx_px * p_CS.x() / p_CS.z() / camera_.width;
    const double y = camera_.fy_px * p_CS.y() / p_CS.z() / camera_.height;
    return std::min(2.0, std::sqrt((x * x + y * y) / 0.5));
  }

 private:
  const PinholeCamera camera_;
  const RigidTransform X_CW_;
};

}  // namespace

double RankedRoom(double safe_distance_m, double hidden_things, double clear_radius_m) {
  const double tenfolds = std::log10(1 + hidden_things / kMostHidden);
  return std::isnan(tenfolds) ? safe_distance_m : safe_distance_m - clear_radius_m * tenfolds;
}

SiteCandidates::SiteCandidates(const ElevationMap& map, const HazardMaps& hazards,
                               const SladSettings& settings, const SiteContext& context)
    : rows_(static_cast<std::size_t>(map.geometry.rows)),
      spacing_cells_(settings.choice.spacing_m / std::max(map.geometry.cell_m, 1e-9)) {
  const OffCentre off_centre(context);
  const double cell_m = map.geometry.cell_m, clear_m = settings.lander.clear_radius_m();
  const bool farthest = settings.choice.ranking == SiteRanking::kFarthest;
  as_good_ = settings.mode == SladMode::kModern && farthest ? kEqual_cells * cell_m : 0;
  noise_ = farthest ? kNoise_cells * cell_m : kNoiseOfCost;
  cv::parallel_for_(cv::Range(0, map.geometry.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      Row& row = rows_[static_cast<std::size_t>(r)];
      const float* distances_m = hazards.safe_distance_m.row(r);
      for (int c = 0; c < map.geometry.cols; ++c) {
        const Cell cell{r, c};
        if (!CanBearLander(hazards, cell)) {
          continue;
        }
        const double distance_m =
            RankedRoom(static_cast<double>(distances_m[c]), HiddenThingsAt(hazards, cell), clear_m);
        const double cost = SmoothedCost(hazards.cost, cell);
        const double tie = -kMiddleWeight_cells * off_centre.At(map, cell);
        const double score = farthest ? distance_m + cell_m * (kCostWeight_cells * (1 - cost) + tie)
                                      : -cost + kDistanceWeight_per_m * (distance_m + tie);
        if (score > -HUGE_VAL) {
          row.left.push_back({c, false, score, 0});
        }
      }
      FindBest(row);
    }
  });
}

std::optional<double> SiteCandidates::ScoreAt(Cell cell) const {
  const Candidate* candidate = Find(cell);
  return candidate != nullptr ? std::optional(candidate->score - candidate->favour) : std::nullopt;
}

double SiteCandidates::BestNear(Cell cell) const {
  double best = -HUGE_VAL;
  const int reach = static_cast<int>(std::min(spacing_cells_, 1e6));
  const int last = std::min(static_cast<int>(rows_.size()) - 1, cell.row + reach);
  for (int r = std::max(0, cell.row - reach); r <= last; ++r) {
    for (const Candidate& near : rows_[static_cast<std::size_t>(r)].left) {
      const double dr = r - cell.row, dc = near.col - cell.col;
      if (dr * dr + dc * dc < spacing_cells_ * spacing_cells_) {
        best = std::max(best, near.score - near.favour);
      }
    }
  }
  return best;
}

void SiteCandidates::Favour(Cell cell) {
  if (Candidate* candidate = Find(cell); candidate != nullptr && candidate->favour == 0) {
    candidate->favour = noise_;
    candidate->score += noise_;
    FindBest(rows_[static_cast<std::size_t>(cell.row)]);
  }
}

/// The best cell left, of equals the northernmost, then westernmost; nothing when none is left.
std::optional<Cell> SiteCandidates::Best() const {
  std::optional<Cell> cell;
  double score = -HUGE_VAL;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Candidate& best = rows_[r].best;
    if (best.score > score) {
      cell = Cell{static_cast<int>(r), best.col};
      score = best.score;
    }
  }
  return cell;
}

std::optional<double> SiteCandidates::BestScore() const {
  const std::optional<Cell> best = Best();
  return best ? ScoreAt(*best) : std::nullopt;
}

std::optional<ScoredCell> SiteCandidates::TakeBest() {
  const std::optional<Cell> best = Best();
  if (!best) {
    return std::nullopt;
  }
  const Cell cell = Find(*best)->favour > 0 ? *best : MiddleOfPlateau(*best);
  const ScoredCell taken{cell, *ScoreAt(*best)};
  Take(cell);
  return taken;
}

const SiteCandidates::Candidate* SiteCandidates::Find(Cell cell) const {
  if (cell.row < 0 || cell.row >= static_cast<int>(rows_.size())) {
    return nullptr;
  }
  const std::vector<Candidate>& left = rows_[static_cast<std::size_t>(cell.row)].left;
  const auto at = std::lower_bound(left.begin(), left.end(), cell.col,
                                   [](const Candidate& a, int col) { return a.col < col; });
  return at != left.end() && at->col == cell.col ? &*at : nullptr;
}

SiteCandidates::Candidate* SiteCandidates::Find(Cell cell) {
  return const_cast<Candidate*>(std::as_const(*this).Find(cell));
}

/// Along a ridge of safe distance it is chance, of a centimetre, which cell is the best: taken is
/// the cell nearest to the middle of all that touch it and are as good.
Cell SiteCandidates::MiddleOfPlateau(Cell best) {
  if (as_good_ == 0) {
    return best;
  }
  const double least = Find(best)->score - as_good_;
  std::vector<Cell> equals{best};
  Find(best)->counted = true;
  std::int64_t row_sum = 0, col_sum = 0;
  for (std::size_t next = 0; next < equals.size(); ++next) {
    const Cell cell = equals[next];
    row_sum += cell.row;
    col_sum += cell.col;
    for (int k = 0; k < 9; ++k) {
      const Cell near{cell.row + k / 3 - 1, cell.col + k % 3 - 1};
      Candidate* candidate = Find(near);
      if (candidate != nullptr && !candidate->counted && candidate->score >= least) {
        candidate->counted = true;
        equals.push_back(near);
      }
    }
  }
  const auto n = static_cast<std::int64_t>(equals.size());
  const auto off2 = [&](Cell cell) {  // whole numbers, so that a turned map has the same ties
    const auto dr = static_cast<double>(n * cell.row - row_sum);
    const auto dc = static_cast<double>(n * cell.col - col_sum);
    return dr * dr + dc * dc;
  };
  Cell middle = best;
  for (const Cell& cell : equals) {
    Candidate& candidate = *Find(cell);
    candidate.counted = false;
    const double nearer = off2(middle) - off2(cell);
    if (nearer > 0 || (nearer == 0 && candidate.score > Find(middle)->score)) {
      middle = cell;
    }
  }
  return middle;
}

/// Drops the cell and all nearer to it than the spacing.
void SiteCandidates::Take(Cell cell) {
  const int reach = static_cast<int>(std::min(spacing_cells_, 1e6)) + 1;
  const double square = spacing_cells_ * spacing_cells_;
  const int last = std::min(static_cast<int>(rows_.size()) - 1, cell.row + reach);
  for (int r = std::max(0, cell.row - reach); r <= last; ++r) {
    Row& row = rows_[static_cast<std::size_t>(r)];
    std::erase_if(row.left, [&](const Candidate& near) {
      const double dr = r - cell.row, dc = near.col - cell.col;
      return dr * dr + dc * dc < square || Cell{r, near.col} == cell;
    });
    FindBest(row);
  }
}

void SiteCandidates::FindBest(Row& row) {
  row.best = {};
  for (const Candidate& candidate : row.left) {
    if (candidate.score > row.best.score) {
      row.best = candidate;
    }
  }
}

}  // namespace palace
