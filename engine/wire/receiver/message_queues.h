// MessageQueues: whole messages that wait to be handled. Each channel has its own bounded queue, so
// that a flooded one pushes out nothing but its own; across channels the order of arrival is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "engine/core/time.h"
#include "engine/wire/receiver/channel_limits.h"
#include "engine/wire/receiver/lcm_reassembler.h"

namespace palace {

struct QueuedMessage {
  ReceivedMessage message;
  Timestamp arrived;  ///< wall clock
};

class MessageQueues {
 public:
  void Open(const std::string& channel, const ChannelLimits& limits);
  /// Of a channel that is open.
  void Push(QueuedMessage message);
  /// The oldest of all.
  std::optional<QueuedMessage> Pop();
  bool empty() const { return waiting_ == 0; }
  /// Messages of the channel that had to go.
  std::uint64_t overflowed(const std::string& channel) const;

 private:
  struct Entry {
    std::uint64_t order = 0;
    QueuedMessage message;
  };
  struct Queue {
    ChannelLimits limits;
    std::deque<Entry> entries;
    std::size_t bytes = 0;
    std::uint64_t overflowed = 0;
  };
  void DropOldest(Queue& queue);

  std::map<std::string, Queue> queues_;
  std::uint64_t next_order_ = 0;
  std::size_t waiting_ = 0;
};

}  // namespace palace
