// From a range map to decisions: fuse, judge, choose. Evaluates the limits in force, and beside
// them the previewed or recorded ones when they differ.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "engine/slad/hazards/terrain_figures.h"
#include "engine/slad/pictures/scene_flags.h"
#include "engine/slad/sites/site_selection.h"
#include "engine/slad/terrain/fusion.h"

namespace palace {

/// What the maps are made from, for one frame.
struct TerrainInput {
  std::shared_ptr<const RangeMap> range;
  RigidTransform X_WC;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  // The rectified pair the range map was made of, for flags; null: nothing is flagged from
  // pictures.
  std::shared_ptr<const ImageU8> left{};
  std::shared_ptr<const ImageU8> right{};
  double baseline_m = 0;
};

class TerrainStage {
 public:
  void Reset();
  /// Fuses a new range map. Evaluate then judges it. Under bounds from data, in modern mode, the
  /// cell doubles while the view is more than twice as wide as the map.
  void Add(const TerrainInput& input, const SladSettings& settings);
  bool has_map() const { return elevation_ != nullptr; }
  const std::shared_ptr<const ElevationMap>& elevation() const { return elevation_; }

  /// Judges the newest elevation map under the given settings. `keep_letters` false uses a copy of
  /// the letters, so that a preview never changes them.
  std::shared_ptr<const TerrainDecision> Evaluate(const Settings& settings, bool keep_letters);
  /// The same place on a newer decision; empty when it lies outside that map. `heading_rad`: of the
  /// approach that is planned to it, NaN straight from the vehicle.
  std::optional<LandingSite> Recheck(const TerrainDecision& decision, const LandingSite& site,
                                     const Settings& settings, double heading_rad) const;

 private:
  SiteContext Context(const Settings& settings) const;
  SladSettings FittedToView(const SladSettings& settings) const;
  void FitCellToView(const RangeMap& range, const SladSettings& settings);
  const TerrainFigures& FiguresFor(const SladSettings& settings);

  void FlagFromPictures();

  TerrainFusion fusion_;
  SceneFlags scene_flags_;
  SiteRegistry registry_;
  TerrainInput input_;
  int cell_factor_ = 1;  // power of two on the set cell, so that the map covers a high view
  std::shared_ptr<const ElevationMap> elevation_;
  // Of the newest map: for the settings in force and the previewed ones, newest last.
  std::vector<TerrainFigures> figures_;
};

}  // namespace palace
