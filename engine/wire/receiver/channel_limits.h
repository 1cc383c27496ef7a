// ChannelLimits: what one channel may bring, so that no sender can take more than its share.
#pragma once

#include <cstddef>
#include <string>

namespace palace {

struct ChannelLimits {
  std::size_t message_bytes = 64u << 10;  ///< largest payload
  std::size_t queue_messages = 256;       ///< more that wait push out the oldest
  std::size_t queue_bytes = 4u << 20;     ///< likewise; one message may always wait
  double most_hz = 100;                   ///< the fastest that a sender needs
  /// One sender is listened to until it is silent for this long; 0: whoever sends.
  double one_sender_s = 0;
  /// Who is listened to on that channel may speak on this one, nobody else; empty: see above.
  std::string with_sender_of{};
};

}  // namespace palace
