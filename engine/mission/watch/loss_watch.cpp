#include "engine/mission/watch/loss_watch.h"

#include <algorithm>
#include <map>

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kLeastWindow_s = 2;       ///< no rate is told from less
constexpr double kLeastShare = 0.01;       ///< of messages that came, to tell a rate from
constexpr double kLeastMessages = 50;      ///< no share either
constexpr double kLeastToldShare = 0.005;  ///< of a channel; less is told as 0 %

using Counts = std::map<std::string, std::uint64_t>;

/// "VEHICLE_POSE 3, GPS 1".
std::string WordsOf(const Counts& counts) {
  std::vector<std::string> words;
  for (const auto& [name, count] : counts) {
    words.push_back(name + " " + std::to_string(count));
  }
  return Joined(words);
}

std::uint64_t SumOf(const Counts& counts) {
  std::uint64_t sum = 0;
  for (const auto& [name, count] : counts) {
    sum += count;
  }
  return sum;
}

std::string SecondSenders(const BusTraffic& bus) {
  std::vector<std::string> words;
  for (const ChannelTraffic& channel : bus.channels) {
    if (!channel.second_sender.empty()) {
      words.push_back(channel.channel + " from " + channel.second_sender);
    }
  }
  return Joined(words);
}

void FindBusiest(const BusTraffic& bus, RecentLosses& recent) {
  const auto take = [&](double rate_hz, double most_hz, const std::string& name) {
    if (most_hz > 0 && !(rate_hz / most_hz <= recent.bus_load)) {
      recent.bus_load = rate_hz / most_hz;
      recent.busiest = name;
    }
  };
  for (const ChannelTraffic& channel : bus.channels) {
    take(channel.rate_hz, channel.most_hz, channel.channel);
  }
  take(bus.rate_hz, bus.most_hz, "all channels");
}

bool IsCounted(const ChannelHealth& channel) {
  const bool sample = channel.id == ChannelId::kVehiclePose || channel.id == ChannelId::kImu ||
                      channel.id == ChannelId::kGps || channel.id == ChannelId::kLaserRange;
  return sample && std::isfinite(channel.lost_share);
}

}  // namespace

double LostShare(const std::vector<ChannelHealth>& channels) {
  double lost = 0, sent = 0;
  for (const ChannelHealth& channel : channels) {
    if (IsCounted(channel)) {
      // What comes is what was sent, less what was lost.
      const double sent_hz = channel.rate_hz / std::max(1 - channel.lost_share, kLeastShare);
      sent += sent_hz;
      lost += sent_hz - channel.rate_hz;
    }
  }
  return sent > 0 ? lost / sent : NAN;
}

std::string LosersWords(const std::vector<ChannelHealth>& channels) {
  std::vector<const ChannelHealth*> losing;
  for (const ChannelHealth& channel : channels) {
    if (IsCounted(channel) && channel.lost_share >= kLeastToldShare) {
      losing.push_back(&channel);
    }
  }
  std::stable_sort(
      losing.begin(), losing.end(),
      [](const ChannelHealth* a, const ChannelHealth* b) { return a->lost_share > b->lost_share; });
  std::vector<std::string> words;
  for (const ChannelHealth* channel : losing) {
    words.push_back(ChannelName(channel->id) + WithNumbers(" %.0f %%", 100 * channel->lost_share));
  }
  return Joined(words);
}

std::string LossWords(double lost_share, const std::string& limit, const std::string& losers) {
  return WithNumbers("%.0f %% of messages lost in %.0f s, limit ", 100 * lost_share,
                     kLossWindow_s) +
         limit + (losers.empty() ? "" : ": " + losers);
}

LossWatch::Sample LossWatch::SampleOf(const Losses& losses, Timestamp now) {
  const std::uint64_t other_version = SumOf(losses.other_version);
  return {.time = now,
          .replaced = losses.pairs_replaced,
          .undecodable = losses.undecodable_messages() - other_version,
          .unrecorded = losses.records_dropped,
          .unsent = losses.messages_unsent,
          .other_version = other_version,
          .refused = losses.datagrams_refused,
          .overrun = losses.bus.overrun,
          .bus_received = losses.bus.received_of_used,
          .bus_lost = losses.bus.lost_of_used,
          .stamps_refused = losses.stamps_refused_messages()};
}

void LossWatch::Update(const Losses& losses, bool pair, Timestamp now) {
  Sample sample = SampleOf(losses, now);
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
  channels_ = WordsOf(losses.undecodable);
  other_version_ = WordsOf(losses.other_version);
  bus_ = losses.bus;
  stamped_channels_ = WordsOf(losses.stamps_refused);
}

RecentLosses LossWatch::recent() const {
  if (samples_.empty()) {
    return {};
  }
  const Sample &from = samples_.front(), &to = samples_.back();
  // A gap that closes makes a count smaller.
  const auto came = [&](std::uint64_t Sample::*count) {
    return to.*count > from.*count ? static_cast<double>(to.*count - from.*count) : 0.0;
  };
  const double span_s = SecondsBetween(from.time, to.time);
  const bool rated = span_s >= kLeastWindow_s;
  const double lost = came(&Sample::bus_lost), received = came(&Sample::bus_received);
  RecentLosses recent{
      .pairs_hz = rated ? came(&Sample::pairs) / span_s : NAN,
      .replaced_hz = rated ? came(&Sample::replaced) / span_s : NAN,
      .undecodable = came(&Sample::undecodable),
      .channels = channels_,
      .unrecorded = came(&Sample::unrecorded),
      .unsent = came(&Sample::unsent),
      .refused = came(&Sample::refused),
      .refused_hz = rated ? came(&Sample::refused) / span_s : NAN,
      .refused_why = WordsOf(bus_.refused_why),
      .overrun = came(&Sample::overrun),
      .other_version = came(&Sample::other_version) > 0 ? other_version_ : "",
      .second_sender = SecondSenders(bus_),
      .lost_share = lost + received >= kLeastMessages ? lost / (lost + received) : NAN,
      .stamps_refused = came(&Sample::stamps_refused),
      .stamped_channels = stamped_channels_};
  FindBusiest(bus_, recent);
  return recent;
}

}  // namespace palace
