// LinkFaults: what a failed link makes of the messages on the way to the station. Pure: the same
// seed, messages and faults give the same bytes.
//
// Struck are the vehicle's messages, one by one; TRUTH never is. What a station sends goes its way.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "engine/core/random.h"
#include "engine/faults/fault.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

class LinkFaults {
 public:
  explicit LinkFaults(std::uint64_t seed, ChannelNames channels = {})
      : random_(seed, "faults of the link"), channels_(std::move(channels)) {}

  std::vector<WireMessage> Apply(std::vector<WireMessage> messages,
                                 const std::vector<Fault>& faults, double now_s);

 private:
  struct Delayed {
    int after;  ///< messages that still overtake it
    WireMessage message;
  };
  bool Strikes(const Fault& fault, const WireMessage& message) const;
  void Send(WireMessage message, std::vector<WireMessage>& arrived);

  RandomStream random_;
  ChannelNames channels_;
  std::deque<Delayed> delayed_;
};

}  // namespace palace
