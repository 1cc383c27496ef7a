#include "engine/wire/receiver/message_queues.h"

#include <utility>

#include "engine/core/check.h"

namespace palace {

void MessageQueues::Open(const std::string& channel, const ChannelLimits& limits) {
  queues_[channel].limits = limits;
}

void MessageQueues::DropOldest(Queue& queue) {
  queue.bytes -= queue.entries.front().message.message.payload.size();
  queue.entries.pop_front();
  --waiting_;
}

void MessageQueues::Push(QueuedMessage message) {
  const auto found = queues_.find(message.message.channel);
  PALACE_CHECK(found != queues_.end(), message.message.channel);
  Queue& queue = found->second;
  const std::size_t bytes = message.message.payload.size();
  while (!queue.entries.empty() && (queue.entries.size() >= queue.limits.queue_messages ||
                                    queue.bytes + bytes > queue.limits.queue_bytes)) {
    DropOldest(queue);
    ++queue.overflowed;
  }
  queue.entries.push_back({next_order_++, std::move(message)});  // counted only once it is in
  queue.bytes += bytes;
  ++waiting_;
}

std::optional<QueuedMessage> MessageQueues::Pop() {
  Queue* oldest = nullptr;
  for (auto& [channel, queue] : queues_) {
    if (!queue.entries.empty() &&
        (oldest == nullptr || queue.entries.front().order < oldest->entries.front().order)) {
      oldest = &queue;
    }
  }
  if (oldest == nullptr) {
    return std::nullopt;
  }
  QueuedMessage message = std::move(oldest->entries.front().message);
  oldest->bytes -= message.message.payload.size();
  oldest->entries.pop_front();
  --waiting_;
  return message;
}

std::uint64_t MessageQueues::overflowed(const std::string& channel) const {
  const auto found = queues_.find(channel);
  return found != queues_.end() ? found->second.overflowed : 0;
}

}  // namespace palace
