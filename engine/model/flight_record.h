// FlightRecord: what a recorded flight decided at the time, for the Review timeline.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/channel.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// One STATION_STATUS: one a bundle.
struct FlightRecordSample {
  Timestamp time;
  std::uint64_t sequence = 0;
  MissionState state = MissionState::kNoLive;
  std::uint64_t settings_hash = 0;
  std::uint64_t decision_hash = 0;
  std::string best_site;              ///< letter, empty: none
  double best_safe_distance_m = NAN;  ///< NaN without a site
  double height_above_site_m = NAN;   ///< skid above the site; NaN without a site
  double distance_to_site_m = NAN;    ///< horizontal; NaN without a site
  double height_m = NAN;              ///< body above the origin of W, up-positive
  int alarms = 0;                     ///< active
  bool vision_in_force = false;
  int armed = -1;  ///< index into FlightRecord::armed_sites; -1: none armed
  /// Above the site, of a look that was approved: MissionStatus::stop_height_m. 0: none was.
  double stop_height_m = 0;
  bool new_map = false;  ///< a map came with it: the figures of the best site were measured now
};

/// Limits in force from a time on.
struct SettingsInForce {
  Timestamp from;
  Settings settings;
};

/// The last of `all`, in order of `time_of`, that is not after `time`; null without one.
template <typename T>
const T* NewestAt(const std::vector<T>& all, Timestamp T::*time_of, Timestamp time) {
  const auto after =
      std::upper_bound(all.begin(), all.end(), time,
                       [&](Timestamp t, const T& entry) { return t < entry.*time_of; });
  return after == all.begin() ? nullptr : &*(after - 1);
}

/// A place that a map proposed, with the figures that were on the screen then.
struct RecordedPlace {
  std::uint64_t id = 0;
  std::string letter;
  Eigen::Vector2d north_east_m{NAN, NAN};
  double safe_distance_m = NAN;
  Figure slope_rad{NAN, NAN};
  Figure roughness_m{NAN, NAN};
};
/// One SITE_PROPOSAL: the places of one map, best first.
struct RecordedProposal {
  Timestamp map_time;
  std::vector<RecordedPlace> places;

  /// Null where it does not list that place.
  const RecordedPlace* Place(const std::string& letter) const;
};

/// Ids of the places that stood refused from a time on.
struct RecordedRefusals {
  Timestamp from;
  std::vector<std::uint64_t> site_ids;
};

/// Skid centre to the site at touchdown, horizontal.
struct RecordedTouchdown {
  Timestamp time;
  Eigen::Vector3d p_WS{NAN, NAN, NAN};
  double miss_m = NAN;       ///< by the estimate
  double true_miss_m = NAN;  ///< by TRUTH; NaN where none is recorded
};

/// A stretch in which nothing was heard of vehicle or cameras, seconds after the first bundle.
struct RecordGap {
  double from_s = 0;
  double to_s = 0;
};

struct FlightRecord {
  std::string path;
  std::vector<FlightRecordSample> samples;    ///< in order of time; empty for foreign logs
  std::vector<Event> events;                  ///< in order of time
  std::vector<RecordedProposal> proposals;    ///< in order of time
  std::vector<LandingSite> armed_sites;       ///< as proposed when the operator selected them
  std::vector<RecordedRefusals> refusals;     ///< in order of time
  std::vector<RecordedTouchdown> touchdowns;  ///< in order of time
  /// Times of the bundles with which each channel came, by ChannelId, in order.
  std::array<std::vector<Timestamp>, kChannelCount> heard;
  std::vector<SettingsInForce> settings;  ///< in order of time; empty: none on record
  Settings settings_at_start;
  bool has_settings = false;  ///< false: settings_at_start holds the defaults
  double start_s = 0;         ///< of the first bundle, seconds of data time
  double duration_s = 0;
  std::vector<RecordGap> gaps;  ///< longer than a second, in order of time
  std::uint64_t file_bytes = 0;

  /// The newest that is not newer than `time`; null before the first.
  const FlightRecordSample* SampleAt(Timestamp time) const;
  const RecordedProposal* ProposalAt(Timestamp time) const;
  /// The site that was selected or flown to then; null without one.
  const LandingSite* ArmedAt(const FlightRecordSample& sample) const {
    const bool known =
        sample.armed >= 0 && static_cast<std::size_t>(sample.armed) < armed_sites.size();
    return known ? &armed_sites[static_cast<std::size_t>(sample.armed)] : nullptr;
  }
};

}  // namespace palace
