// Safe landing area determination (thesis 4.3): THE order of calls, for flight, `analyze`,
// `evaluate` and re-decision alike. The same views under the same settings give the same maps,
// whoever asks.
//
//   Add      ViewCell::Fit         range map             -> cell with which the map holds the view
//            TerrainFusion::Add    range map, X_WC       -> elevation map
//            SceneFlags::Add       pictures, range map   -> its flags
//   Decide   MeasureTerrain        elevation map         -> planes, deviations, sigmas, before
//                                                           any limit is asked
//            JudgeTerrain          those, limits         -> hazard, cost and safe-distance maps
//            HashOfMaps            maps                  -> what an approval binds
//            SiteRegistry::Select  maps, vehicle         -> ranked sites, steady over maps
//            VerdictImage          range map, hazards    -> overlay for the left picture
//   Recheck  RecheckSite           decision, older site  -> the same place on a newer map
//
// Deterministic; any one thread (rows of a map are shared among OpenCV's threads, to the same
// bits).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/model/terrain_decision.h"
#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/hazards/terrain_figures.h"
#include "engine/slad/pictures/scene_flags.h"
#include "engine/slad/sites/site_registry.h"
#include "engine/slad/terrain/fusion.h"
#include "engine/slad/terrain/view_cell.h"

namespace palace {

/// What the maps are made from, for one frame.
struct SladInput {
  SceneView view;  ///< a range map with pose and baseline; without pictures nothing is flagged
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< the vehicle then
};

/// Whose memory of sites a decision goes by and adds to: the flight's own, or a copy of it, so that
/// a preview or a re-decision never changes it. A copy gives no letter: what it lists and the
/// flight never listed is "+1", "+2" (IsNamedSite).
enum class Letters { kOfRecord, kOfCopy };

class Slad {
 public:
  /// Starts afresh; ids of sites are not used again.
  void Forget(SiteNames names);
  /// So many places had names before this one began.
  void GoOnNaming(std::uint64_t named) { registry_.GoOnNaming(named); }
  /// Those places were listed before (SiteRegistry::GoOnWith).
  void GoOnWith(const std::vector<RecordedPlace>& places, const SladSettings& settings) {
    registry_.GoOnWith(places, settings);
  }

  /// Whether the first list waits for the memory of the maps (SiteRegistry::WaitForMemory): in a
  /// flight, not for the pictures of a folder, which may be few.
  void WaitForMemory(bool waits) { registry_.WaitForMemory(waits); }

  /// Fuses a new range map and flags it from its pictures; Decide then judges the map. Thesis mode
  /// fuses nothing and flags nothing: its map is that of the newest frame.
  void Add(const SladInput& input, const SladSettings& settings);
  /// The pictures of now are none, and those shortly before may have been none: what is seen next
  /// is not compared with them (SceneFlags::DoubtViews).
  void DoubtViews() { scene_flags_.DoubtViews(); }
  /// Takes a finished elevation map (a survey) in place of what was fused. Sites then have no
  /// vehicle, no picture and no straight approach.
  void Take(ElevationMap map);

  bool has_map() const { return elevation_ != nullptr; }
  /// Null before the first map.
  const std::shared_ptr<const ElevationMap>& elevation() const { return elevation_; }

  /// That site is selected: it stays in the list while it can bear the lander, and the map about
  /// it. Null: none.
  void Keep(const LandingSite* site) {
    registry_.Keep(site != nullptr ? site->id : 0);
    kept_ = site != nullptr ? std::optional<Eigen::Vector2d>(site->p_WS.head<2>()) : std::nullopt;
  }
  /// Judges the newest elevation map, which must be there, under the given settings.
  std::shared_ptr<const TerrainDecision> Decide(const Settings& settings, Letters letters);
  /// The same place on a newer decision; empty when it lies outside that map. `heading_rad`: of the
  /// approach that is planned to it, NaN straight from the vehicle.
  std::optional<LandingSite> Recheck(const TerrainDecision& decision, const LandingSite& site,
                                     const Settings& settings, double heading_rad) const;

 private:
  SiteContext Context(const Settings& settings) const;
  const TerrainFigures& FiguresFor(const SladSettings& settings);
  void FlagFromPictures();

  ViewCell view_cell_;
  TerrainFusion fusion_;
  SceneFlags scene_flags_;
  SiteRegistry registry_;
  std::optional<Eigen::Vector2d> kept_;  ///< where the selected site lies
  SladInput input_;                      ///< the newest; without a range map for a survey
  std::shared_ptr<const ElevationMap> elevation_;
  // Of the newest map: for the settings in force and the previewed ones, newest last.
  std::vector<TerrainFigures> figures_;
};

}  // namespace palace
