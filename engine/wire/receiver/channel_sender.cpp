#include "engine/wire/receiver/channel_sender.h"

namespace palace {
namespace {
constexpr double kRemembered_s = 10;
}

bool ChannelSender::Admit(SenderAddress from, double now_s) {
  if (patience_s_ <= 0) {
    return true;
  }
  if (!in_use_ || (in_use_->address != from && now_s - in_use_->last_s > patience_s_)) {
    if (other_ && other_->address == from) {
      other_.reset();
    }
    in_use_ = Speaker{from, now_s, now_s};
    return true;
  }
  if (in_use_->address == from) {
    in_use_->last_s = now_s;
    return true;
  }
  if (!other_ || other_->address != from || now_s - other_->last_s > kRemembered_s) {
    other_ = Speaker{from, now_s, now_s};
  }
  other_->last_s = now_s;
  return false;
}

std::optional<SenderAddress> ChannelSender::in_use() const {
  return in_use_ ? std::optional(in_use_->address) : std::nullopt;
}

std::optional<SenderAddress> ChannelSender::second(double now_s) const {
  const bool both = other_ && in_use_ && in_use_->last_s > other_->first_s;
  return both && now_s - other_->last_s <= kRemembered_s ? std::optional(other_->address)
                                                         : std::nullopt;
}

}  // namespace palace
