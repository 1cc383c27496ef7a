// SiteRegistry: what the maps of a flight together say of the places to land at.
//
// One model. A PLACE is a point of the ground. It gets its letter when it is first listed and keeps
// it for the flight; a letter is never given to another place. Two points are one place when the
// newer lies within a quarter of the spacing of where the letter was given: a place that left the
// list, or is replaced, moves to such a point when that is listed. What is selected never moves.
//
//   listed     after it could bear the lander on 3 maps in a row (a flight's first map lists at
//              once); ends with the first map on which it cannot
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
// the newest map calls unsafe is never in the list. Under other limits all but places and letters
// starts anew. Source: ours.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/slad/sites/site_candidates.h"
#include "engine/slad/sites/site_selection.h"
#include "engine/slad/sites/steadiness.h"

namespace palace {

/// "A" to "Z" without I and O, then "A2" to "Z2", "A3", ...: of the nth place, from 0.
std::string SiteLetter(std::size_t n);

/// Letters after a Reset: within a flight none is given twice; another flight begins at A. Ids are
/// never used again.
enum class SiteNames { kGoOn, kAnew };

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
  void GoOnNaming(std::uint64_t named);
  /// A recorded flight goes on in which those places were listed, best first, under those limits.
  void GoOnWith(const std::vector<RecordedPlace>& places, const SladSettings& settings);
  /// From here on no letter is given: a place that has none is "+1", "+2", ... of its one list (a
  /// preview, a re-decision). The flight would give the same letter to another place.
  void GiveNoLetters() { gives_letters_ = false; }

 private:
  struct Place {
    std::uint64_t id = 0;  ///< 0: never listed yet
    std::string letter{};
    Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  ///< north, east
    Eigen::Vector2d named_at = p_W;                 ///< where the letter was given
    int rank = -1;                                  ///< in the list; -1: not listed
    int run = 0;                                    ///< maps in a row that it could bear the lander
    SteadyFigure score{};
    SteadyVerdict confirmed{}, air_shown{}, straight_clear{}, some_clear{}, roomy{};
    LastingClaim beaten{};
    double look_height_m = NAN;            ///< LandingSite::look_height_m, as it was told last
    int losses = 0;                        ///< maps that called it unsafe
    std::optional<Timestamp> shaken_at{};  ///< by the last of them
  };
  /// Where a place is looked at on one map.
  struct Chosen {
    std::size_t place = 0;
    ScoredCell at;
  };
  /// What was found there.
  struct Found {
    std::size_t place = 0;
    LandingSite site;
  };
  struct Map;

  std::vector<Found> Revisit(const Map& now, SiteCandidates& candidates);
  void Explore(const Map& now, SiteCandidates& candidates, std::vector<Found>& found);
  std::size_t Wanted(const Map& now, const std::vector<Found>& found,
                     const SiteCandidates& candidates) const;
  std::size_t PlaceAt(const Map& now, Cell cell);
  void Follow(const Map& now, const std::vector<Chosen>& chosen, const SiteCandidates& candidates,
              std::vector<Found>& found);
  std::vector<Found> Ranked(const Map& now, std::vector<Found> found, double noise) const;
  std::vector<Found> List(const Map& now, std::vector<Found> ranked);
  void Name(const Map& now, Place& fresh);
  bool HasLetter(const std::string& letter) const;
  void StartMap(const Map& now);
  void Lose(const Map& now, const std::vector<Found>& found);
  bool IsRipe(const Map& now, const Place& place) const;
  /// Seconds since a map called the place unsafe, while it stands behind the others for it; else
  /// NaN.
  static double ShakenFor(const Place& place, Timestamp now);
  bool IsKept(const Place& place) const { return place.id != 0 && place.id == kept_; }

  std::vector<Place> places_;
  std::vector<Eigen::Vector2d> replaced_;  ///< on this map
  std::uint64_t next_id_ = 1;
  std::uint64_t named_ = 0;
  bool gives_letters_ = true;
  std::uint64_t kept_ = 0;
  std::optional<Timestamp> time_;  ///< of the newest map
  SladSettings settings_;          ///< under which it was judged
};

}  // namespace palace
