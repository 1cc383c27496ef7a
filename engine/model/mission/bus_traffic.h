// BusTraffic: what came over the bus, by channel and by sender, counted by our own receiver.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace palace {

/// One channel that we listen to. Counts since the session began; they only grow.
struct ChannelTraffic {
  std::string channel;         ///< its name on the bus
  std::uint64_t received = 0;  ///< whole messages
  std::uint64_t bytes = 0;     ///< of their payloads
  /// Messages of which only a part came. What got lost whole is known of a sender alone: senders
  /// number their messages over all channels.
  std::uint64_t lost = 0;
  std::uint64_t overflowed = 0;  ///< waited while so many came that the oldest had to go
  std::uint64_t duplicated = 0;
  std::uint64_t reordered = 0;  ///< came after a later one of its sender
  std::uint64_t refused = 0;    ///< datagrams
  double rate_hz = 0;           ///< of the last second, refused ones too
  double most_hz = 0;           ///< the fastest that a sender needs (engine/wire/README.md)
  std::string sender{};         ///< whose messages are used, "10.0.0.2:7667"; empty: nobody's yet
  std::string second_sender{};  ///< who sent here at the same time lately; refused
  friend bool operator==(const ChannelTraffic&, const ChannelTraffic&) = default;
};

/// One sender, by its address and port.
struct SenderTraffic {
  std::string address;
  bool used = false;           ///< its messages of some channel are the ones we use
  std::uint64_t received = 0;  ///< whole messages of our channels
  std::uint64_t bytes = 0;
  std::uint64_t lost = 0;  ///< gaps in its numbers; one is closed when the message comes after all
  std::uint64_t duplicated = 0;
  std::uint64_t reordered = 0;
  std::uint64_t refused = 0;  ///< datagrams
  std::uint64_t foreign = 0;  ///< datagrams of channels that we do not listen to
  double silent_s = NAN;      ///< since its last datagram
  friend bool operator==(const SenderTraffic&, const SenderTraffic&) = default;
};

/// Empty where no bus is received (simulation, replay, pictures).
struct BusTraffic {
  std::vector<ChannelTraffic> channels{};
  std::vector<SenderTraffic> senders{};  ///< used ones first; strangers with nothing of ours last
  std::uint64_t datagrams = 0;
  std::uint64_t refused = 0;
  std::map<std::string, std::uint64_t> refused_why{};  ///< by reason
  std::uint64_t foreign = 0;
  std::uint64_t overrun = 0;  ///< lost in this machine: the kernel's receive buffer was full
  double rate_hz = 0;         ///< datagrams of the last second
  double most_hz = 0;         ///< what all our channels need together
  /// Of the senders that are used, for the share of messages that is lost.
  std::uint64_t received_of_used = 0;
  std::uint64_t lost_of_used = 0;
  friend bool operator==(const BusTraffic&, const BusTraffic&) = default;
};

}  // namespace palace
