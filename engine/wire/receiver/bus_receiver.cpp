#include "engine/wire/receiver/bus_receiver.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "engine/core/time.h"

namespace palace {
namespace {

constexpr const char* kOtherSender = "another sender has the channel";
constexpr const char* kMemoryShort = "memory was short";
constexpr std::size_t kSendersShown = 16;

}  // namespace

void BusInbox::Open(const std::string& channel, const ChannelLimits& limits) {
  reassembler_.Allow(channel, limits.message_bytes);
  queues_.Open(channel, limits);
  Channel& opened = channels_[channel];
  opened.limits = limits;
  opened.sender = ChannelSender(limits.one_sender_s);
}

void BusInbox::Take(const UdpSocket::Datagram& datagram, Timestamp wall, double now_s) {
  LcmReassembler::Taken taken =
      reassembler_.Take(datagram.from, datagram.data, datagram.size, now_s);
  rate_.Add(now_s);
  const auto channel = channels_.find(taken.channel);
  using Outcome = LcmReassembler::Outcome;
  if (channel != channels_.end() && taken.outcome != Outcome::kPart) {
    channel->second.rate.Add(now_s);
  }
  if (taken.outcome == Outcome::kRefused) {
    refusals_.Add({ToText(datagram.from), std::string(taken.channel), RefusalWords(taken.reason),
                   datagram.data, datagram.size},
                  wall, now_s);
  } else if (taken.outcome == Outcome::kMessage) {
    Accept(channel->second, std::move(taken.message), wall, now_s);
  }
}

bool BusInbox::IsListenedTo(Channel& channel, SenderAddress from, double now_s) const {
  const auto partner = channels_.find(channel.limits.with_sender_of);
  if (partner == channels_.end()) {
    return channel.sender.Admit(from, now_s);
  }
  const auto known = partner->second.sender.in_use();
  return !known || *known == from;
}

void BusInbox::Accept(Channel& channel, ReceivedMessage message, Timestamp wall, double now_s) {
  if (IsListenedTo(channel, message.sender, now_s)) {
    if (channel.sender.in_use()) {
      reassembler_.Keep(message.sender, now_s);
    }
    queues_.Push({std::move(message), wall});
    return;
  }
  ++channel.of_other_senders;
  ++of_other_senders_;
  refusals_.Add({ToText(message.sender), message.channel, kOtherSender, message.payload.data(),
                 message.payload.size()},
                wall, now_s);
}

void BusInbox::Take(const std::vector<UdpSocket::Datagram>& datagrams, Timestamp wall,
                    double now_s) {
  try {
    for (const UdpSocket::Datagram& datagram : datagrams) {
      Take(datagram, wall, now_s);
    }
    reassembler_.Age(now_s);
  } catch (const std::exception&) {
    // The thread that receives has nobody above it. Memory may be short for a moment.
    dropped_ += datagrams.size();
  }
}

BusTraffic BusInbox::Traffic(double now_s) {
  BusTraffic traffic;
  for (auto& [name, channel] : channels_) {
    const TrafficCount& count = reassembler_.channels().find(name)->second;
    const auto second = channel.sender.second(now_s);
    const auto in_use = channel.sender.in_use();
    traffic.channels.push_back({.channel = name,
                                .received = count.messages - channel.of_other_senders,
                                .bytes = count.bytes,
                                .lost = count.lost,
                                .overflowed = queues_.overflowed(name),
                                .duplicated = count.duplicated,
                                .reordered = count.reordered,
                                .refused = count.refused + channel.of_other_senders,
                                .rate_hz = channel.rate.Rate_hz(now_s),
                                .most_hz = channel.limits.most_hz,
                                .sender = in_use ? ToText(*in_use) : "",
                                .second_sender = second ? ToText(*second) : ""});
    traffic.most_hz += channel.limits.most_hz;
  }
  const TrafficCount& total = reassembler_.total();
  traffic.datagrams = reassembler_.datagrams();
  traffic.refused = total.refused + of_other_senders_ + dropped_;
  for (std::size_t i = 0; i < kRefusalCount; ++i) {
    if (reassembler_.refusals()[i] > 0) {
      traffic.refused_why[RefusalWords(static_cast<Refusal>(i))] = reassembler_.refusals()[i];
    }
  }
  if (of_other_senders_ > 0) {
    traffic.refused_why[kOtherSender] = of_other_senders_;
  }
  if (dropped_ > 0) {
    traffic.refused_why[kMemoryShort] = dropped_;
  }
  traffic.foreign = total.foreign;
  traffic.rate_hz = rate_.Rate_hz(now_s);
  CountSenders(traffic, now_s);
  return traffic;
}

void BusInbox::CountSenders(BusTraffic& traffic, double now_s) const {
  for (const auto& known : reassembler_.Senders()) {
    const auto& address = known.first;
    const auto& sender = known.second;
    const bool used = std::any_of(channels_.begin(), channels_.end(), [&](const auto& entry) {
      return entry.second.sender.in_use() == address;
    });
    const TrafficCount& count = sender.count;
    traffic.senders.push_back({.address = ToText(address),
                               .used = used,
                               .received = count.messages,
                               .bytes = count.bytes,
                               .lost = count.lost,
                               .duplicated = count.duplicated,
                               .reordered = count.reordered,
                               .refused = count.refused,
                               .foreign = count.foreign,
                               .silent_s = now_s - sender.heard_s});
    if (used) {
      traffic.received_of_used += count.messages;
      traffic.lost_of_used += count.lost;
    }
  }
  const auto rank = [](const SenderTraffic& s) {
    return std::pair(s.used, s.received + s.refused);
  };
  std::stable_sort(
      traffic.senders.begin(), traffic.senders.end(),
      [&](const SenderTraffic& a, const SenderTraffic& b) { return rank(a) > rank(b); });
  traffic.senders.resize(std::min(traffic.senders.size(), kSendersShown));
}

BusReceiver::BusReceiver(UdpSocket socket)
    : socket_(std::move(socket)), thread_([this](std::stop_token stop) { Run(stop); }) {}

BusReceiver::~BusReceiver() = default;

void BusReceiver::Open(const std::string& channel, const ChannelLimits& limits) {
  const std::lock_guard lock(mutex_);
  inbox_.Open(channel, limits);
}

void BusReceiver::Run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    const std::vector<UdpSocket::Datagram>& datagrams = socket_.Receive();
    const double now_s = MonotonicSeconds();
    const Timestamp wall = WallTime();
    const std::lock_guard lock(mutex_);
    inbox_.Take(datagrams, wall, now_s);
    overrun_ = socket_.overrun();
    if (!inbox_.empty()) {
      arrived_.notify_one();
    }
  }
}

std::optional<QueuedMessage> BusReceiver::Next(int timeout_ms) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, std::chrono::milliseconds(timeout_ms),
                    [this] { return !inbox_.empty(); });
  return inbox_.Pop();
}

BusTraffic BusReceiver::Traffic() const {
  const std::lock_guard lock(mutex_);
  BusTraffic traffic = inbox_.Traffic(MonotonicSeconds());
  traffic.overrun = overrun_;
  return traffic;
}

std::vector<RefusedDatagram> BusReceiver::TakeRefused() {
  const std::lock_guard lock(mutex_);
  return inbox_.TakeRefused();
}

}  // namespace palace
