// The cells of one map that could be a site, by score. Internal to the SLAD room.
//
// kFarthest scores metres: the room seen, and, within one cell's worth of it, the cost and the
// nearness to the middle of the picture. Room is wide only over ground where a thing over the limit
// would show (IsSeen, hidden_things.h): the distance to the nearest hazard or cell about which
// most are not seen. Where that is little, a quarter of the safe distance, at most the clear
// radius: seen ground goes before wide and blind ground. kCost scores the smoothed cost, less is
// better.
#pragma once

#include <optional>
#include <vector>

#include "engine/slad/sites/site_selection.h"

namespace palace {

struct ScoredCell {
  Cell cell;
  double score = 0;
};

/// The best cell of each row is at hand: the best that is left is found without sorting, and taking
/// one touches only the rows around it. Sites keep choice.spacing_m from each other.
class SiteCandidates {
 public:
  SiteCandidates(const ElevationMap& map, const HazardMaps& hazards, const SladSettings& settings,
                 const SiteContext& context);

  /// What a place is ranked by; its safe distance where all is seen.
  double RoomAt(Cell cell) const { return static_cast<double>(room_m_.at(cell)); }
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
  /// 3/4 of a cell of the best distance, unless the best is a known place.
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
  GridF room_m_;
  double spacing_cells_ = 0;
  double as_good_ = 0;  ///< scores that differ by less are equal; metres
  double noise_ = 0;
};

}  // namespace palace
