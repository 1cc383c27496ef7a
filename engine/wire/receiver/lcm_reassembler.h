// LcmReassembler: datagrams of LCM's UDP protocol become messages, whatever bytes come.
//
// This header and its source need the standard library only: no sockets, clocks, threads or other
// files. Take both into a vehicle that listens to PALACE (engine/wire/README.md shows the socket).
//
// The two formats, big-endian:
//   short     "LC02"  number u32  channel... 0  payload...
//   fragment  "LC03"  number u32  message size u32  offset u32  fragment u16  fragments u16
//             then, in fragment 0 only, channel... 0; then its part of the payload
// A sender numbers its messages in one row over all channels; every fragment of a message carries
// the same number. Size and offset count the payload alone.
//
// Promises, for any bytes from any number of senders:
//   * A message comes out once, whole, exactly as it was sent, or not at all: a fragment that comes
//     twice counts once, order does not matter, messages of one sender may interleave.
//   * No memory is taken for what a datagram claims, only for the bytes that it brings, and never
//     more than the limits. Sums are 64 bits wide.
//   * A message of a channel that nobody asked for, or over that channel's limit, is not kept.
//   * Nothing is dropped uncounted: every refusal has a reason, every gap in a sender's numbers is
//     counted as lost until the missing message comes after all.
//
// Source: LCM project, "LCM UDP Multicast Protocol Description". Deviations: no payload larger than
// its channel's limit; a sender whose number jumps by more than 100,000 counts as restarted.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palace {

/// Where a datagram came from: IPv4, host byte order.
struct SenderAddress {
  std::uint32_t ip = 0;
  std::uint16_t port = 0;
  friend auto operator<=>(const SenderAddress&, const SenderAddress&) = default;
};
/// "10.0.0.2:7667".
std::string ToText(const SenderAddress& address);

/// Why a datagram was refused.
enum class Refusal : std::uint8_t {
  kFormat,         ///< too short for a header, or no magic number of LCM
  kChannelName,    ///< not closed by a zero inside the datagram, not 1 to 63 printable characters
  kTooLarge,       ///< the message is over its channel's limit
  kFragment,       ///< fragment number or count makes no sense, or a part without bytes
  kOffset,         ///< the part reaches beyond the message
  kContradiction,  ///< does not agree with what other fragments of the message said
};
inline constexpr std::size_t kRefusalCount = 6;
/// For people.
constexpr const char* RefusalWords(Refusal refusal) {
  constexpr const char* kWords[kRefusalCount] = {"not LCM",
                                                 "no channel name",
                                                 "over the channel's size limit",
                                                 "fragment numbers make no sense",
                                                 "reaches beyond its message",
                                                 "contradicts its other fragments"};
  return kWords[static_cast<std::size_t>(refusal)];
}

struct ReassemblerLimits {
  std::size_t waiting_bytes = 24u << 20;             ///< in parts of messages, of all senders
  std::size_t waiting_bytes_per_sender = 12u << 20;  ///< at least the largest message
  std::size_t waiting_per_sender = 16;               ///< messages
  std::size_t senders = 64;                          ///< remembered
  double patience_s = 1;  ///< without a new part for this long a message is given up
};

struct ReceivedMessage {
  std::string channel;
  SenderAddress sender;
  std::uint32_t number = 0;
  std::vector<std::uint8_t> payload;
};

/// Counts of one sender or of one channel since the start. `lost` of a sender: gaps in its numbers
/// that are still open, and messages of which only a part came. `lost` of a channel: the latter,
/// where the channel was known; the numbers of LCM do not tell a gap's channel.
struct TrafficCount {
  std::uint64_t messages = 0;  ///< whole, and asked for
  std::uint64_t bytes = 0;     ///< of their payloads
  std::uint64_t lost = 0;
  std::uint64_t duplicated = 0;  ///< datagrams that had come before; dropped
  std::uint64_t reordered = 0;   ///< messages that came after a later one of their sender
  std::uint64_t refused = 0;     ///< datagrams
  std::uint64_t foreign = 0;     ///< datagrams of channels that nobody asked for
};

class LcmReassembler {
 public:
  explicit LcmReassembler(ReassemblerLimits limits = {});

  /// Messages of `channel` are wanted, up to `most_bytes` of payload each.
  void Allow(const std::string& channel, std::size_t most_bytes);

  enum class Outcome : std::uint8_t { kMessage, kPart, kDuplicate, kForeign, kRefused };
  struct Taken {
    Outcome outcome = Outcome::kRefused;
    Refusal reason = Refusal::kFormat;  ///< of kRefused
    std::string_view channel{};         ///< where known; lives until the next call
    ReceivedMessage message{};          ///< of kMessage
  };
  /// One datagram. `now_s` is any clock that does not run back.
  Taken Take(SenderAddress from, const std::uint8_t* data, std::size_t size, double now_s);
  /// What this sender brought is used by the reader: it stays remembered, whoever else comes, until
  /// it is silent or unused for ten seconds.
  void Keep(SenderAddress sender, double now_s);
  /// Gives up what waits for too long; Take does so too.
  void Age(double now_s);

  struct Sender {
    TrafficCount count{};
    double heard_s = 0;  ///< last
  };
  /// The senders remembered. Kept ones stay longest, then those whose first whole message of ours
  /// came earliest: nobody gets ahead of an old sender by sending much.
  std::map<SenderAddress, Sender> Senders() const;
  const std::map<std::string, TrafficCount, std::less<>>& channels() const { return counts_; }
  /// Of all senders and channels, forgotten ones too.
  const TrafficCount& total() const { return total_; }
  const std::array<std::uint64_t, kRefusalCount>& refusals() const { return refusals_; }
  std::uint64_t datagrams() const { return datagrams_; }
  /// Taken now for messages of which parts are missing.
  std::size_t waiting_bytes() const { return waiting_bytes_; }

 private:
  struct Header;
  struct Part {
    std::uint32_t offset = 0;
    std::vector<std::uint8_t> bytes;
  };
  struct Waiting {  ///< a message of which fragments are missing
    std::uint32_t number = 0;
    std::uint32_t size = 0;
    std::uint16_t fragments = 0;
    bool reordered = false;
    std::string channel;  ///< empty before fragment 0
    std::map<std::uint16_t, Part> parts;
    std::size_t bytes = 0;   ///< of payload in parts
    std::size_t memory = 0;  ///< with what they cost
    double newest_s = 0;
  };
  using WaitingList = std::vector<Waiting>;  ///< oldest first
  enum class Fate : std::uint8_t { kNone, kMissing, kOpen, kDone, kForeign, kRefused };
  struct Seen {  ///< what became of one number
    std::uint32_t number = 0;
    Fate fate = Fate::kNone;
    std::uint64_t digest = 0;  ///< of kDone what it was, of kRefused why
  };
  static constexpr std::size_t kWindow = 128;  ///< numbers remembered a sender
  struct Source {
    Sender known{};
    bool begun = false;
    double proven_s = std::numeric_limits<double>::infinity();  ///< first whole message of ours
    double kept_s = -std::numeric_limits<double>::infinity();
    std::uint32_t highest = 0;
    std::array<Seen, kWindow> seen{};
    WaitingList waiting;
    std::size_t memory = 0;
  };

  Source& FindSource(SenderAddress from, double now_s);
  void ForgetOne(double now_s);
  /// Counts gaps and latecomers. The slot of the number, emptied when it is new; `late` when it
  /// came after a higher one.
  Seen& Follow(Source& source, std::uint32_t number, bool& late);
  Taken TakeShort(Source& source, SenderAddress from, const Header& header);
  Taken TakeFragment(Source& source, SenderAddress from, const Header& header, double now_s);
  Taken Keep(Source& source, SenderAddress from, const Header& header, Seen& seen, bool late,
             double now_s);
  Taken Finish(Source& source, SenderAddress from, WaitingList::iterator whole, Seen& seen);
  Taken Deliver(Source& source, ReceivedMessage message, bool late);
  Taken Drop(Source& source, Outcome outcome, std::string_view channel);
  Taken Refuse(Source& source, Refusal reason, std::string_view channel);
  static WaitingList::iterator FindWaiting(Source& source, std::uint32_t number);
  /// Lost; the message after it is returned.
  WaitingList::iterator GiveUp(Source& source, WaitingList::iterator waiting);
  WaitingList::iterator Remove(Source& source, WaitingList::iterator waiting);
  /// Gives up the oldest of the sender that needs the room, then of who holds most, but never the
  /// message of that number. False: there is none.
  bool MakeRoom(Source& source, std::uint32_t number, std::size_t bytes);

  const ReassemblerLimits limits_;
  std::map<std::string, std::size_t, std::less<>> allowed_;
  std::size_t largest_ = 0;
  std::map<SenderAddress, Source> sources_;
  std::map<std::string, TrafficCount, std::less<>> counts_;
  TrafficCount total_;
  std::array<std::uint64_t, kRefusalCount> refusals_{};
  std::uint64_t datagrams_ = 0;
  std::size_t waiting_bytes_ = 0;
  double aged_s_ = 0;
};

}  // namespace palace
