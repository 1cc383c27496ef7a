// SiteRegistry: what the maps of a flight together say of the places to land at.
//
// One model. A PLACE is a point of the ground. It gets its letter when it is first listed and keeps
// it for the flight; a letter is never given to another place. Two points are one place when the
// newer lies within a quarter of the spacing of where the letter was given: a place that left the
// list, or is replaced, moves to such a point when that is listed. What is selected never moves.
//
//   listed     after it could bear the lander on 3 maps in a row; ends with the first map on which
//              it cannot. What begins lists at once, or, where it waits for the memory of its maps
//              (WaitForMemory), with the map that remembers frames_fused frames: what each of the
//              first frames adds moves places about
//   rank       by the steady score (steadiness.h); one passes another only when it is better by
//              more than the noise of a score. A place that a map called unsafe, and a new one
//              within the spacing of it, counts for 30 s, each time longer by 30 s, as one where
//              ten times as much may hide: a clear radius less of room
//   replaced   when another point within the spacing is better by more than that on as many maps in
//              a row as it stood before, from 2 to 24; never the place that is selected
//   confirmed  as the maps say, 3 of 5 against it, 5 in a row for it again
//   look       from where it would be settled, as it was told until maps differ by over a metre
//   air        likewise: what cannot be approved from here, for its air, comes after what can
//   approach   likewise: blocked ones come after clear ones
//   tight      with less than a cell beyond its clear radius it comes after those that have more:
//              a map that sees the nearest hazard a cell nearer makes it no site
//   old        ground last measured longer ago than an approval allows (2 s) comes after all that
//              is still in view
//
// So a single map with a false cell lists and names nothing and moves no ring, while a place that
// the newest map calls unsafe is never in the list. Under other limits what was counted over maps
// starts anew and new places are listed at once; a place that was listed keeps its row while it can
// bear the lander, until another is better by more than the noise. Source: ours.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/slad/sites/site_candidates.h"
#include "engine/slad/sites/site_naming.h"
#include "engine/slad/sites/site_place.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {

class SiteRegistry {
 public:
  /// The sites of the newest map, best first, with letters. The same map again changes nothing.
  SiteSelection Select(const ElevationMap& map, const HazardMaps& hazards,
                       const SladSettings& settings, const SiteContext& context);
  /// That place is selected: while it can bear the lander it is listed. 0: none.
  void Keep(std::uint64_t site_id) { kept_ = site_id; }
  /// Nothing of the ground holds any more: another frame, another clock, another flight.
  void Reset(SiteNames names);
  /// A flight goes on in which so many places were named already.
  void GoOnNaming(std::uint64_t named) { naming_.GoOnNaming(named); }
  /// A recorded flight goes on in which those places were listed, best first, under those limits.
  void GoOnWith(const std::vector<RecordedPlace>& places, const SladSettings& settings);
  /// More maps follow: the first list waits until they remember all that they will.
  void WaitForMemory(bool waits) { waits_ = waits; }
  /// From here on no letter is given: a place that has none is "+1", "+2", ... of its one list (a
  /// preview, a re-decision). The flight would give the same letter to another place.
  void GiveNoLetters() { gives_letters_ = false; }

 private:
  /// Where a place is looked at on one map.
  struct Chosen {
    std::size_t place = 0;
    ScoredCell at;
  };
  struct Map;

  std::vector<FoundSite> Revisit(const Map& now, SiteCandidates& candidates);
  void Explore(const Map& now, SiteCandidates& candidates, std::vector<FoundSite>& found);
  std::size_t Wanted(const Map& now, const std::vector<FoundSite>& found,
                     const SiteCandidates& candidates) const;
  std::size_t PlaceAt(const Map& now, Cell cell);
  void Follow(const Map& now, const std::vector<Chosen>& chosen, const SiteCandidates& candidates,
              std::vector<FoundSite>& found);
  std::vector<FoundSite> List(const Map& now, std::vector<FoundSite> ranked);
  void StartMap(const Map& now);
  void Lose(const Map& now, const std::vector<FoundSite>& found);
  bool IsRipe(const Map& now, const SitePlace& place) const;
  bool IsKept(const SitePlace& place) const { return place.id != 0 && place.id == kept_; }

  std::vector<SitePlace> places_;
  std::vector<Eigen::Vector2d> replaced_;  ///< on this map
  SiteNaming naming_;
  bool gives_letters_ = true;
  bool waits_ = false;  ///< for the memory of the maps
  bool lists_ = false;  ///< it has waited long enough, or need not
  int maps_ = 0;        ///< since it began
  std::uint64_t kept_ = 0;
  std::optional<Timestamp> time_;  ///< of the newest map
  SladSettings settings_;          ///< under which it was judged
};

}  // namespace palace
