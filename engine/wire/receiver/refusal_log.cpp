#include "engine/wire/receiver/refusal_log.h"

#include <algorithm>
#include <utility>

namespace palace {
namespace {
constexpr int kMostASecond = 10;
constexpr std::size_t kMostKinds = 256;
constexpr std::size_t kMostKept = 100;  ///< while nobody takes them
}  // namespace

void RefusalLog::Add(const Refused& refused, Timestamp wall, double now_s) {
  const std::string name = refused.reason + "|" + refused.channel;
  auto kind = kinds_.find(name);
  const bool fresh = kind == kinds_.end();
  if (fresh) {
    if (kinds_.size() >= kMostKinds) {
      kinds_.clear();
    }
    kind = kinds_.emplace(name, Kind{}).first;
  }
  if (now_s - second_s_ >= 1) {
    second_s_ = now_s;
    in_second_ = 0;
  }
  const bool due = fresh || now_s - kind->second.kept_s >= 1;
  if (!due || in_second_ >= kMostASecond || kept_.size() >= kMostKept) {
    ++kind->second.skipped;
    return;
  }
  ++in_second_;
  const std::size_t head = std::min(refused.size, kRefusedBytesKept);
  kept_.push_back({.time = wall,
                   .sender = refused.sender,
                   .channel = refused.channel,
                   .reason = refused.reason,
                   .bytes = static_cast<std::uint32_t>(refused.size),
                   .like_it = kind->second.skipped + 1,
                   .head = {refused.data, refused.data + head}});
  kind->second = {now_s, 0};
}

std::vector<RefusedDatagram> RefusalLog::Take() { return std::exchange(kept_, {}); }

}  // namespace palace
