// Losses: what did not get through the doors, counted where it was lost.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/model/mission/bus_traffic.h"

namespace palace {

/// Counts since the session began; they only grow.
struct Losses {
  /// Stereo pairs overtaken by a newer pair before the engine looked at them.
  std::uint64_t pairs_replaced = 0;
  std::uint64_t pictures_unpaired = 0;   ///< no partner of the other camera within the tolerance
  std::uint64_t pairs_without_rig = 0;   ///< came before the sender had described its cameras
  std::uint64_t bundles_missing = 0;     ///< gaps in the sender's own numbers
  std::uint64_t samples_missing = 0;     ///< announced by the sender, never arrived
  std::uint64_t samples_overflowed = 0;  ///< came while so many waited that the oldest had to go
  std::uint64_t datagrams_refused = 0;   ///< before they were a message, or of a second sender
  std::map<std::string, std::uint64_t> undecodable{};  ///< messages refused, by channel on the bus
  /// Those of them that are of another version of their type, by channel.
  std::map<std::string, std::uint64_t> other_version{};
  /// Stamped ahead of or far behind the vehicle's clock, by channel on the bus: VehicleClock.
  std::map<std::string, std::uint64_t> stamps_refused{};
  std::uint64_t repeated = 0;  ///< messages whose stamp did not advance: copies, or out of order
  std::uint64_t messages_unsent = 0;  ///< to the vehicle, refused by the bus
  std::uint64_t records_dropped = 0;  ///< frames not written: the disk was too slow

  BusTraffic bus{};  ///< of a bus: by channel and by sender

  /// Messages refused, of all channels.
  std::uint64_t undecodable_messages() const { return Sum(undecodable); }
  std::uint64_t stamps_refused_messages() const { return Sum(stamps_refused); }
  friend bool operator==(const Losses&, const Losses&) = default;

 private:
  static std::uint64_t Sum(const std::map<std::string, std::uint64_t>& counts) {
    std::uint64_t sum = 0;
    for (const auto& [channel, count] : counts) {
      sum += count;
    }
    return sum;
  }
};

}  // namespace palace
