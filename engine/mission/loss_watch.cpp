#include "engine/mission/loss_watch.h"

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

std::vector<AlarmCondition> LossWatch::Alarms(bool vehicle) const {
  const Sample from = samples_.empty() ? Sample{} : samples_.front();
  const Sample to = samples_.empty() ? Sample{} : samples_.back();
  const double span_s = SecondsBetween(from.time, to.time);
  const auto came = [&](std::uint64_t Sample::*count) {
    return static_cast<double>(to.*count - from.*count);
  };
  const double replaced = came(&Sample::replaced), pairs = came(&Sample::pairs);
  const double pairs_hz = span_s > 0 ? pairs / span_s : 0;
  return {
      {"pictures_replaced", AlarmLevel::kCaution,
       vehicle && replaced > 0 && span_s >= kLeastWindow_s && pairs_hz < kLeastPairs_hz,
       WithNumbers("The station looks at %.1f stereo pairs a second, limit %.1f, and misses %.1f. "
                   "Close other programs or make fewer maps.",
                   pairs_hz, kLeastPairs_hz, span_s > 0 ? replaced / span_s : 0)},
      {"undecodable", AlarmLevel::kCaution, came(&Sample::undecodable) > 0,
       WithNumbers("%.0f messages of the last %.0f s could not be read: ",
                   came(&Sample::undecodable), kWindow_s) +
           channels_ + " in all. Is the sender of another version?"},
      {"records_dropped", AlarmLevel::kCaution, came(&Sample::unrecorded) > 0,
       WithNumbers("%.0f frames of the last %.0f s are not in the record: the disk is too "
                   "slow. Free it, or record elsewhere.",
                   came(&Sample::unrecorded), kWindow_s)},
      {"messages_unsent", AlarmLevel::kCaution, came(&Sample::unsent) > 0,
       WithNumbers("%.0f messages of the last %.0f s could not be sent. Check the network link.",
                   came(&Sample::unsent), kWindow_s)},
  };
}

}  // namespace palace
