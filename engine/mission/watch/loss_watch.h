// LossWatch: what was lost lately, for the alarms.
//
// Losses grow since the session began; an alarm is what came in the last ten seconds. Pictures are
// replaced by newer ones whenever a pass takes longer than a frame, by design: that matters when
// fewer than five pairs a second are left to look at, half of what maps and tracking are made for.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "engine/core/time.h"
#include "engine/model/channel.h"
#include "engine/model/mission/losses.h"

namespace palace {

/// Of the last ten seconds. NaN: too little was seen for a rate.
struct RecentLosses {
  double pairs_hz = NAN;     ///< stereo pairs looked at
  double replaced_hz = NAN;  ///< replaced by newer ones before anybody looked
  double undecodable = 0;    ///< messages, of the right version
  std::string channels{};    ///< that carried them since the session began, "VEHICLE_POSE 3"
  double unrecorded = 0;     ///< frames
  double unsent = 0;         ///< messages to the vehicle
  // Of a bus.
  double refused = 0;         ///< datagrams
  double refused_hz = NAN;    ///< the same a second
  std::string refused_why{};  ///< since the session began, "not LCM 3"
  double bus_load = NAN;  ///< most of any channel, in times of what it needs; of the last second
  std::string busiest{};  ///< that channel; "all channels"
  double overrun = 0;     ///< datagrams that this machine had no room for
  std::string other_version{};  ///< channels whose messages are of another version of their type
  std::string second_sender{};  ///< "VEHICLE_POSE from 10.0.0.9:6666"
  /// Of the messages of the senders in use, by the gaps in their numbers; 0 to 1.
  double lost_share = NAN;
  double stamps_refused = 0;       ///< messages, by the clock
  std::string stamped_channels{};  ///< that carried them since the session began
};

/// Share of the messages of pose, IMU, GPS and laser that is missing lately, of all together; NaN
/// where none of them is known. Pictures have counts of their own: newer ones replace them.
double LostShare(const std::vector<ChannelHealth>& channels);
/// Which channels lost how much of their own, the worst first: "IMU 85 %, GPS 8 %". Empty: none
/// did.
std::string LosersWords(const std::vector<ChannelHealth>& channels);
/// "51 % of messages lost in 5 s, limit 10 %: IMU 85 %, GPS 8 %".
std::string LossWords(double lost_share, const std::string& limit, const std::string& losers);

class LossWatch {
 public:
  static constexpr double kWindow_s = 10;

  /// Once a bundle. `pair`: the bundle has pictures.
  void Update(const Losses& losses, bool pair, Timestamp now);
  RecentLosses recent() const;

 private:
  struct Sample {
    Timestamp time;
    std::uint64_t pairs = 0;  ///< looked at
    std::uint64_t replaced = 0;
    std::uint64_t undecodable = 0;
    std::uint64_t unrecorded = 0;
    std::uint64_t unsent = 0;
    std::uint64_t other_version = 0;
    std::uint64_t refused = 0;
    std::uint64_t overrun = 0;
    std::uint64_t bus_received = 0;
    std::uint64_t bus_lost = 0;
    std::uint64_t stamps_refused = 0;
  };
  static Sample SampleOf(const Losses& losses, Timestamp now);
  std::deque<Sample> samples_;  ///< of the window, oldest first; the first is what counts from
  std::string channels_;        ///< that carried what could not be read
  std::string other_version_, stamped_channels_;
  BusTraffic bus_;  ///< newest
};

}  // namespace palace
