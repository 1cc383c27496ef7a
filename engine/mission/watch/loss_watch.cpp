#include "engine/mission/watch/loss_watch.h"

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kLeastWindow_s = 2;  ///< no rate is told from less

std::string ChannelsOf(const Losses& losses) {
  std::vector<std::string> words;
  for (const auto& [channel, count] : losses.undecodable) {
    words.push_back(channel + " " + std::to_string(count));
  }
  return Joined(words);
}

}  // namespace

void LossWatch::Update(const Losses& losses, bool pair, Timestamp now) {
  Sample sample{now,
                0,
                losses.pairs_replaced,
                losses.undecodable_messages(),
                losses.records_dropped,
                losses.messages_unsent};
  if (samples_.empty()) {
    samples_.push_back({.time = now});
  } else if (now < samples_.back().time) {
    samples_ = {sample};  // time jumped: count from here
    return;
  }
  sample.pairs = samples_.back().pairs + (pair ? 1 : 0);
  samples_.push_back(sample);
  while (SecondsBetween(samples_[1].time, now) >= kWindow_s) {
    samples_.pop_front();
  }
  channels_ = ChannelsOf(losses);
}

RecentLosses LossWatch::recent() const {
  if (samples_.empty()) {
    return {};
  }
  const Sample &from = samples_.front(), &to = samples_.back();
  const auto came = [&](std::uint64_t Sample::*count) {
    return static_cast<double>(to.*count - from.*count);
  };
  const double span_s = SecondsBetween(from.time, to.time);
  const bool rated = span_s >= kLeastWindow_s;
  return {.pairs_hz = rated ? came(&Sample::pairs) / span_s : NAN,
          .replaced_hz = rated ? came(&Sample::replaced) / span_s : NAN,
          .undecodable = came(&Sample::undecodable),
          .channels = channels_,
          .unrecorded = came(&Sample::unrecorded),
          .unsent = came(&Sample::unsent)};
}

}  // namespace palace
