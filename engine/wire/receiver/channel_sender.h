// ChannelSender: whose messages of one channel are used.
//
// A channel of a sensor has one sender. The first that speaks is listened to until it is silent
// for `patience_s`; who speaks in between is refused, so that a stranger's message neither mixes
// with the true ones nor ages them. LCM has no signatures: this notices a second sender and keeps
// it out while the first lives. It cannot tell which of the two is the true one.
#pragma once

#include <optional>

#include "engine/wire/receiver/lcm_reassembler.h"

namespace palace {

class ChannelSender {
 public:
  /// `patience_s` 0: everybody is let in.
  explicit ChannelSender(double patience_s = 0) : patience_s_(patience_s) {}
  /// One whole message came. False: of another sender than the one in use.
  bool Admit(SenderAddress from, double now_s);
  /// Nobody yet, or everybody is let in.
  std::optional<SenderAddress> in_use() const;
  /// Who was refused within the last ten seconds while the one in use went on speaking. A sender
  /// that takes over from one that fell silent is none.
  std::optional<SenderAddress> second(double now_s) const;

 private:
  struct Speaker {
    SenderAddress address;
    double first_s = 0;
    double last_s = 0;
  };
  double patience_s_ = 0;
  std::optional<Speaker> in_use_;
  std::optional<Speaker> other_;
};

}  // namespace palace
