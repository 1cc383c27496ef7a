#include "engine/wire/receiver/lcm_reassembler.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

namespace palace {
namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;     // "LC02"
constexpr std::uint32_t kFragmentMagic = 0x4c433033;  // "LC03"
constexpr std::size_t kShortHeader = 8;
constexpr std::size_t kFragmentHeader = 20;
constexpr std::size_t kLongestChannel = 63;
constexpr std::size_t kPartCost = 128;  ///< bytes a part takes besides its payload, at most
/// Further apart than this, two numbers of one sender are no gap: it began anew.
constexpr std::int64_t kRestart = 100000;
constexpr double kProven_s = 10;  ///< a sender silent for longer gives way to others
constexpr double kAgeEvery_s = 0.1;

std::uint32_t Read32(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         std::uint32_t{at[3]};
}
std::uint16_t Read16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] << 8 | at[1]);
}

/// Tells a repeated datagram from another one under the same number; no defence against a forger.
std::uint64_t Digest(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t digest = 0xcbf29ce484222325 ^ size;
  std::size_t at = 0;
  for (; at + 8 <= size; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + at, 8);
    digest = (digest ^ word) * kPrime;
    digest ^= digest >> 29;
  }
  for (; at < size; ++at) {
    digest = (digest ^ data[at]) * kPrime;
  }
  return digest;
}

std::uint64_t Digest(std::uint32_t size, std::uint16_t fragments) {
  return (std::uint64_t{size} << 16 | fragments) ^ 0x9e3779b97f4a7c15;
}

}  // namespace

/// A datagram taken apart. `channel` is empty in all fragments but the first.
struct LcmReassembler::Header {
  std::uint32_t number = 0;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;
  std::uint16_t fragment = 0;
  std::uint16_t fragments = 0;
  std::string_view channel{};
  const std::uint8_t* data = nullptr;  ///< payload
  std::size_t bytes = 0;

  /// Takes the channel off the front of the payload; false when there is none.
  bool TakeChannel() {
    const std::size_t most = std::min(bytes, kLongestChannel + 1);
    const void* end = most > 0 ? std::memchr(data, 0, most) : nullptr;
    if (end == nullptr || end == data) {
      return false;
    }
    const auto length = static_cast<std::size_t>(static_cast<const std::uint8_t*>(end) - data);
    const bool printable =
        std::all_of(data, data + length, [](std::uint8_t c) { return c > ' ' && c <= '~'; });
    channel = {reinterpret_cast<const char*>(data), length};
    data += length + 1;
    bytes -= length + 1;
    return printable;
  }
};

std::string ToText(const SenderAddress& address) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(address.ip >> shift & 0xff) + (shift > 0 ? "." : ":");
  }
  return text + std::to_string(address.port);
}

LcmReassembler::LcmReassembler(ReassemblerLimits limits) : limits_(limits) {}

void LcmReassembler::Allow(const std::string& channel, std::size_t most_bytes) {
  allowed_[channel] = most_bytes;
  counts_[channel];
  largest_ = std::max(largest_, most_bytes);
}

LcmReassembler::Taken LcmReassembler::Take(SenderAddress from, const std::uint8_t* data,
                                           std::size_t size, double now_s) {
  if (now_s - aged_s_ >= kAgeEvery_s) {
    Age(now_s);
  }
  ++datagrams_;
  Source& source = FindSource(from, now_s);
  const std::uint32_t magic = size >= kShortHeader ? Read32(data) : 0;
  if (magic == kShortMagic) {
    Header header{.number = Read32(data + 4),
                  .fragments = 1,
                  .data = data + kShortHeader,
                  .bytes = size - kShortHeader};
    if (!header.TakeChannel()) {
      return Refuse(source, Refusal::kChannelName, {});
    }
    return TakeShort(source, from, header);
  }
  if (magic != kFragmentMagic || size < kFragmentHeader) {
    return Refuse(source, Refusal::kFormat, {});
  }
  Header header{.number = Read32(data + 4),
                .size = Read32(data + 8),
                .offset = Read32(data + 12),
                .fragment = Read16(data + 16),
                .fragments = Read16(data + 18),
                .data = data + kFragmentHeader,
                .bytes = size - kFragmentHeader};
  if (header.fragment == 0 && !header.TakeChannel()) {
    return Refuse(source, Refusal::kChannelName, {});
  }
  return TakeFragment(source, from, header, now_s);
}

LcmReassembler::Taken LcmReassembler::TakeShort(Source& source, SenderAddress from,
                                                const Header& header) {
  bool late = false;
  Seen& seen = Follow(source, header.number, late);
  const std::uint64_t digest =
      Digest(header.data, header.bytes) ^
      Digest(reinterpret_cast<const std::uint8_t*>(header.channel.data()), header.channel.size());
  if (seen.fate == Fate::kDone && seen.digest == digest) {
    return Drop(source, Outcome::kDuplicate, header.channel);
  }
  const auto allowed = allowed_.find(header.channel);
  if (allowed == allowed_.end()) {
    seen.fate = Fate::kForeign;
    return Drop(source, Outcome::kForeign, header.channel);
  }
  if (header.bytes > allowed->second) {
    seen.fate = Fate::kRefused;
    seen.digest = static_cast<std::uint64_t>(Refusal::kTooLarge);
    return Refuse(source, Refusal::kTooLarge, header.channel);
  }
  seen.fate = Fate::kDone;
  seen.digest = digest;
  return Deliver(source,
                 {allowed->first, from, header.number, {header.data, header.data + header.bytes}},
                 late);
}

LcmReassembler::Taken LcmReassembler::TakeFragment(Source& source, SenderAddress from,
                                                   const Header& header, double now_s) {
  bool late = false;
  Seen& seen = Follow(source, header.number, late);
  if (seen.fate == Fate::kDone && seen.digest == Digest(header.size, header.fragments)) {
    return Drop(source, Outcome::kDuplicate, header.channel);
  }
  const bool first = header.fragment == 0;
  const auto allowed = allowed_.find(header.channel);
  if (first ? allowed == allowed_.end() : seen.fate == Fate::kForeign) {
    // Parts that came before the first, and told no channel, are let go.
    if (const auto kept = FindWaiting(source, header.number); kept != source.waiting.end()) {
      Remove(source, kept);
    }
    seen.fate = Fate::kForeign;
    return Drop(source, Outcome::kForeign, header.channel);
  }
  if (seen.fate == Fate::kRefused && !first) {
    return Refuse(source, Refusal{static_cast<std::uint8_t>(seen.digest)}, {});
  }
  if (header.size > (first ? allowed->second : largest_)) {
    seen.fate = first ? Fate::kRefused : seen.fate;
    seen.digest = static_cast<std::uint64_t>(Refusal::kTooLarge);
    return Refuse(source, Refusal::kTooLarge, header.channel);
  }
  // Every part of a message of several brings at least one byte of it.
  if (header.fragment >= header.fragments ||
      (header.fragments > 1 && (header.bytes == 0 || header.fragments > header.size))) {
    return Refuse(source, Refusal::kFragment, header.channel);
  }
  if (std::uint64_t{header.offset} + header.bytes > header.size) {
    return Refuse(source, Refusal::kOffset, header.channel);
  }
  return Keep(source, from, header, seen, late, now_s);
}

LcmReassembler::WaitingList::iterator LcmReassembler::FindWaiting(Source& source,
                                                                  std::uint32_t number) {
  return std::find_if(source.waiting.begin(), source.waiting.end(),
                      [number](const Waiting& w) { return w.number == number; });
}

LcmReassembler::Taken LcmReassembler::Keep(Source& source, SenderAddress from, const Header& header,
                                           Seen& seen, bool late, double now_s) {
  auto waiting = FindWaiting(source, header.number);
  if (waiting == source.waiting.end()) {
    if (seen.fate == Fate::kOpen) {
      return {.outcome = Outcome::kPart, .channel = header.channel};  // was given up
    }
    seen.fate = Fate::kOpen;
    while (source.waiting.size() >= limits_.waiting_per_sender) {
      GiveUp(source, source.waiting.begin());
    }
    source.waiting.push_back({.number = header.number,
                              .size = header.size,
                              .fragments = header.fragments,
                              .reordered = late,
                              .channel = {},
                              .parts = {}});
    waiting = std::prev(source.waiting.end());
  }
  if (waiting->size != header.size || waiting->fragments != header.fragments) {
    return Refuse(source, Refusal::kContradiction, header.channel);
  }
  if (const auto part = waiting->parts.find(header.fragment); part != waiting->parts.end()) {
    const bool same = part->second.offset == header.offset &&
                      std::equal(part->second.bytes.begin(), part->second.bytes.end(), header.data,
                                 header.data + header.bytes);
    return same ? Drop(source, Outcome::kDuplicate, waiting->channel)
                : Refuse(source, Refusal::kContradiction, waiting->channel);
  }
  if (waiting->bytes + header.bytes > waiting->size) {
    return Refuse(source, Refusal::kContradiction, waiting->channel);
  }
  const std::size_t cost = header.bytes + kPartCost;
  const bool has_room = MakeRoom(source, header.number, cost);
  waiting = FindWaiting(source, header.number);
  if (!has_room) {
    GiveUp(source, waiting);
    return {.outcome = Outcome::kPart, .channel = header.channel};
  }
  waiting->parts[header.fragment] = {header.offset, {header.data, header.data + header.bytes}};
  waiting->bytes += header.bytes;
  waiting->memory += cost;
  waiting->newest_s = now_s;
  source.memory += cost;
  waiting_bytes_ += cost;
  if (header.fragment == 0) {
    waiting->channel = header.channel;
  }
  if (waiting->parts.size() < waiting->fragments) {
    return {.outcome = Outcome::kPart, .channel = waiting->channel};
  }
  return Finish(source, from, waiting, seen);
}

LcmReassembler::Taken LcmReassembler::Finish(Source& source, SenderAddress from,
                                             WaitingList::iterator whole, Seen& seen) {
  ReceivedMessage message{whole->channel, from, whole->number, {}};
  const auto known = allowed_.find(whole->channel);
  bool in_row = whole->bytes == whole->size;
  message.payload.reserve(in_row ? whole->size : 0);
  for (const auto& [number, part] : whole->parts) {
    in_row = in_row && part.offset == message.payload.size();
    if (in_row) {
      message.payload.insert(message.payload.end(), part.bytes.begin(), part.bytes.end());
    }
  }
  const bool late = whole->reordered;
  const std::uint64_t digest = Digest(whole->size, whole->fragments);
  Remove(source, whole);
  if (!in_row) {
    seen.fate = Fate::kRefused;
    seen.digest = static_cast<std::uint64_t>(Refusal::kContradiction);
    return Refuse(source, Refusal::kContradiction, known->first);
  }
  seen.fate = Fate::kDone;
  seen.digest = digest;
  return Deliver(source, std::move(message), late);
}

LcmReassembler::Taken LcmReassembler::Deliver(Source& source, ReceivedMessage message, bool late) {
  source.proven_s = std::min(source.proven_s, source.known.heard_s);
  const auto channel = counts_.find(message.channel);
  for (TrafficCount* count : {&source.known.count, &channel->second, &total_}) {
    ++count->messages;
    count->bytes += message.payload.size();
    count->reordered += late ? 1 : 0;
  }
  return {.outcome = Outcome::kMessage, .channel = channel->first, .message = std::move(message)};
}

LcmReassembler::Taken LcmReassembler::Drop(Source& source, Outcome outcome,
                                           std::string_view channel) {
  const auto field = outcome == Outcome::kDuplicate ? &TrafficCount::duplicated
                     : outcome == Outcome::kForeign ? &TrafficCount::foreign
                                                    : &TrafficCount::refused;
  ++(source.known.count.*field);
  ++(total_.*field);
  if (const auto known = counts_.find(channel); known != counts_.end()) {
    ++(known->second.*field);
    channel = known->first;
  }
  return {.outcome = outcome, .channel = channel};
}

LcmReassembler::Taken LcmReassembler::Refuse(Source& source, Refusal reason,
                                             std::string_view channel) {
  ++refusals_[static_cast<std::size_t>(reason)];
  Taken taken = Drop(source, Outcome::kRefused, channel);
  taken.reason = reason;
  return taken;
}

LcmReassembler::Seen& LcmReassembler::Follow(Source& source, std::uint32_t number, bool& late) {
  constexpr auto kOldest = static_cast<std::int64_t>(kWindow);
  Seen& seen = source.seen[number % kWindow];
  const std::int64_t ahead =
      source.begun ? std::int64_t{static_cast<std::int32_t>(number - source.highest)} : 1;
  const bool new_row = !source.begun || ahead > kRestart || ahead <= -kOldest;
  if (!new_row && ahead <= 0) {
    if (seen.fate == Fate::kMissing) {
      --source.known.count.lost;
      --total_.lost;
    } else if (seen.fate != Fate::kNone && seen.number == number) {
      return seen;
    }
    late = true;
    seen = {.number = number};
    return seen;
  }
  if (new_row) {
    source.seen.fill({});
  } else {
    source.known.count.lost += static_cast<std::uint64_t>(ahead - 1);
    total_.lost += static_cast<std::uint64_t>(ahead - 1);
    for (std::int64_t back = std::min(ahead, kOldest) - 1; back > 0; --back) {
      const std::uint32_t missing = number - static_cast<std::uint32_t>(back);
      source.seen[missing % kWindow] = {.number = missing, .fate = Fate::kMissing};
    }
  }
  source.begun = true;
  source.highest = number;
  seen = {.number = number};
  return seen;
}

void LcmReassembler::Keep(SenderAddress sender, double now_s) {
  if (const auto found = sources_.find(sender); found != sources_.end()) {
    found->second.kept_s = now_s;
  }
}

void LcmReassembler::ForgetOne(double now_s) {
  const auto worth = [&](const auto& entry) {
    const Source& s = entry.second;
    const bool speaks = now_s - s.known.heard_s < kProven_s;
    const bool kept = speaks && now_s - s.kept_s < kProven_s;
    return std::tuple(kept, speaks ? -s.proven_s : -std::numeric_limits<double>::infinity(),
                      s.known.heard_s);
  };
  const auto least =
      std::min_element(sources_.begin(), sources_.end(),
                       [&](const auto& a, const auto& b) { return worth(a) < worth(b); });
  while (!least->second.waiting.empty()) {
    GiveUp(least->second, least->second.waiting.begin());
  }
  sources_.erase(least);
}

LcmReassembler::Source& LcmReassembler::FindSource(SenderAddress from, double now_s) {
  const auto found = sources_.find(from);
  if (found != sources_.end()) {
    found->second.known.heard_s = now_s;
    return found->second;
  }
  if (sources_.size() >= limits_.senders) {
    ForgetOne(now_s);
  }
  Source& source = sources_[from];
  source.known.heard_s = now_s;
  return source;
}

LcmReassembler::WaitingList::iterator LcmReassembler::GiveUp(Source& source,
                                                             WaitingList::iterator waiting) {
  ++source.known.count.lost;
  ++total_.lost;
  if (const auto known = counts_.find(waiting->channel); known != counts_.end()) {
    ++known->second.lost;
  }
  return Remove(source, waiting);
}

LcmReassembler::WaitingList::iterator LcmReassembler::Remove(Source& source,
                                                             WaitingList::iterator waiting) {
  source.memory -= waiting->memory;
  waiting_bytes_ -= waiting->memory;
  return source.waiting.erase(waiting);
}

bool LcmReassembler::MakeRoom(Source& source, std::uint32_t number, std::size_t bytes) {
  const auto give_up_oldest = [&](Source& from) {
    const auto oldest =
        std::find_if(from.waiting.begin(), from.waiting.end(),
                     [&](const Waiting& w) { return &from != &source || w.number != number; });
    if (oldest == from.waiting.end()) {
      return false;
    }
    GiveUp(from, oldest);
    return true;
  };
  while (source.memory + bytes > limits_.waiting_bytes_per_sender) {
    if (!give_up_oldest(source)) {
      return false;
    }
  }
  while (waiting_bytes_ + bytes > limits_.waiting_bytes) {
    const auto most = std::max_element(
        sources_.begin(), sources_.end(),
        [](const auto& a, const auto& b) { return a.second.memory < b.second.memory; });
    if (!give_up_oldest(most->second)) {
      return false;
    }
  }
  return true;
}

void LcmReassembler::Age(double now_s) {
  aged_s_ = now_s;
  for (auto& [address, source] : sources_) {
    for (auto it = source.waiting.begin(); it != source.waiting.end();) {
      it = now_s - it->newest_s > limits_.patience_s ? GiveUp(source, it) : it + 1;
    }
  }
}

std::map<SenderAddress, LcmReassembler::Sender> LcmReassembler::Senders() const {
  std::map<SenderAddress, Sender> senders;
  for (const auto& [address, source] : sources_) {
    senders[address] = source.known;
  }
  return senders;
}

}  // namespace palace
