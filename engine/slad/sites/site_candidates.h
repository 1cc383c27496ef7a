// The cells of one map that could be a site, by score. Internal to the SLAD room.
//
// kFarthest scores metres: the safe distance, less a clear radius for each tenfold by which more
// may hide there than under a confirmed site (RankedRoom), and, within one cell's worth of it, the
// cost and the nearness to the middle of the picture. So ground that is known goes before wide and
// blind ground, and what is known well enough is ranked by its room. kCost scores the smoothed
// cost, less is better.
#pragma once

#include <optional>
#include <vector>

#include "engine/slad/sites/site_selection.h"

namespace palace {

struct ScoredCell {
  Cell cell;
  double score = 0;
};

/// Room that a place is ranked by, metres: d - R log10(1 + H / kMostHidden) of its safe distance d,
/// the clear radius R and what may hide within it, H (hidden_things.h). An H that is not known
/// takes nothing away. Source: ours.
double RankedRoom(double safe_distance_m, double hidden_things, double clear_radius_m);

/// The best cell of each row is at hand: the best that is left is found without sorting, and taking
/// one touches only the rows around it. Sites keep choice.spacing_m from each other.
class SiteCandidates {
 public:
  SiteCandidates(const ElevationMap& map, const HazardMaps& hazards, const SladSettings& settings,
                 const SiteContext& context);

  /// Less than this between two scores of one place is noise of its own figure.
  double noise() const { return noise_; }
  /// Nothing where no lander can stand, and where a place that was taken is too near.
  std::optional<double> ScoreAt(Cell cell) const;
  /// The best score left within the spacing of the cell.
  double BestNear(Cell cell) const;
  /// The cell counts for the noise more than its score: a place that is known before others that
  /// are as good.
  void Favour(Cell cell);
  void Take(Cell cell);
  /// Of the best cell left; nothing when none is.
  std::optional<double> BestScore() const;
  /// The best place left. In modern mode kFarthest takes the middle of the touching cells within
  /// 3/4 of a cell of the best score, unless the best is a known place.
  std::optional<ScoredCell> TakeBest();

 private:
  struct Candidate {
    int col = -1;
    bool counted = false;  ///< by MiddleOfPlateau
    double score = -HUGE_VAL;
    double favour = 0;  ///< contained in the score
  };
  struct Row {
    std::vector<Candidate> left;  ///< from west to east
    Candidate best;
  };

  std::optional<Cell> Best() const;
  Candidate* Find(Cell cell);
  const Candidate* Find(Cell cell) const;
  Cell MiddleOfPlateau(Cell best);
  static void FindBest(Row& row);

  std::vector<Row> rows_;
  double spacing_cells_ = 0;
  double as_good_ = 0;  ///< scores that differ by less are equal; metres
  double noise_ = 0;
};

}  // namespace palace
