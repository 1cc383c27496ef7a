#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "engine/wire/bundle_assembler.h"
#include "engine/wire/convert.h"
#include "engine/wire/decode.h"
#include "engine/wire/receiver/lcm_reassembler.h"
#include "engine/wire/sensor_messages.h"
#include "engine/wire/session_messages.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/wire_types.h"

namespace palace {
namespace {

/// The fields after the right hash, so that a mutation does not have to guess it.
template <typename T>
std::vector<std::uint8_t> WithHash(Bytes fields) {
  std::vector<std::uint8_t> payload;
  const auto hash = static_cast<std::uint64_t>(T::getHash());
  for (int shift = 56; shift >= 0; shift -= 8) {
    payload.push_back(static_cast<std::uint8_t>(hash >> shift));
  }
  payload.insert(payload.end(), fields.begin(), fields.end());
  return payload;
}

using Maker = std::vector<std::uint8_t> (*)(Bytes);
template <std::size_t... I>
constexpr auto MakersOf(std::index_sequence<I...>) {
  return std::array<Maker, sizeof...(I)>{&WithHash<std::tuple_element_t<I, WireTypes>>...};
}
constexpr auto kMakers = MakersOf(std::make_index_sequence<std::tuple_size_v<WireTypes>>());

/// First byte: the type; the rest: its fields. What decodes must encode to the same bytes.
template <std::size_t I>
void DecodeType(Bytes fields) {
  using T = std::tuple_element_t<I, WireTypes>;
  const std::vector<std::uint8_t> payload = WithHash<T>(fields);
  const Result<T> decoded = DecodePayload<T>(payload);
  if (decoded && EncodePayload(*decoded).size() != payload.size()) {
    __builtin_trap();
  }
}
template <std::size_t... I>
void DecodeAny(std::size_t type, Bytes fields, std::index_sequence<I...>) {
  ((type == I ? DecodeType<I>(fields) : void()), ...);
}

void Message(Bytes input) {
  if (!input.empty()) {
    DecodeAny(input[0] % kMakers.size(), input.subspan(1),
              std::make_index_sequence<kMakers.size()>());
  }
}

/// The channel that carries the type of that number; its conversion is the one fuzzed.
void Converted(Bytes input) {
  if (input.empty()) {
    return;
  }
  const ChannelNames channels;
  for (const std::string& channel : channels.ToVehicle()) {
    (void)DecodeVehicleMessage({channel, {}, kMakers[input[0] % kMakers.size()](input.subspan(1))},
                               channels);
  }
  const WireMessage message{"ANY", {}, kMakers[input[0] % kMakers.size()](input.subspan(1))};
  (void)DecodeCommand(message);
  (void)DecodeEvent(message);
  (void)DecodeSettings(message);
  (void)DecodeProposal(message);
  (void)DecodeTracker(message);
  (void)DecodeStationStatus(message);
  (void)DecodeTruth(message);
  (void)DecodeRefused(message);
  (void)ArrivalFromWire(message);
  (void)AuthorityFromWire(message);
}

/// A stream: channel and type, length (16 bits), fields, again and again.
void Stream(Bytes input) {
  const ChannelNames names;
  const std::vector<std::string> channels = StreamChannels(names);
  BundleAssembler assembler(names, {.pair_window_s = 0.005, .drop_repeated = input.size() % 2 > 0});
  while (input.size() >= 4) {
    const std::size_t length =
        std::min<std::size_t>(input.size() - 4, input[2] * std::size_t{256} + input[3]);
    (void)assembler.Push({channels[input[0] % channels.size()],
                          {},
                          kMakers[input[1] % kMakers.size()](input.subspan(4, length))});
    input = input.subspan(4 + length);
  }
  (void)assembler.TakePending({1});
}

/// Datagrams: sender, length (16 bits), bytes, again and again. Memory stays within its limit, and
/// no message is larger than its channel's.
void Datagram(Bytes input) {
  constexpr ReassemblerLimits kLimits{.waiting_bytes = 8000,
                                      .waiting_bytes_per_sender = 4000,
                                      .waiting_per_sender = 3,
                                      .senders = 4};
  constexpr std::size_t kMost = 3000;
  LcmReassembler receiver(kLimits);
  receiver.Allow("GPS", 100);
  receiver.Allow("IMU", kMost);
  double now_s = 0;
  while (input.size() >= 3) {
    const std::size_t length =
        std::min<std::size_t>(input.size() - 3, input[1] * std::size_t{256} + input[2]);
    now_s += 0.02;
    const auto taken = receiver.Take({input[0], 1}, input.data() + 3, length, now_s);
    if (taken.message.payload.size() > kMost || receiver.waiting_bytes() > kLimits.waiting_bytes ||
        receiver.Senders().size() > kLimits.senders) {
      __builtin_trap();
    }
    input = input.subspan(3 + length);
  }
}

template <std::size_t... I>
std::vector<std::string> NamesOf(std::index_sequence<I...>) {
  return {std::tuple_element_t<I, WireTypes>::getTypeName()...};
}

}  // namespace

std::vector<std::string> FuzzedTypes() {
  return NamesOf(std::make_index_sequence<std::tuple_size_v<WireTypes>>());
}

std::vector<FuzzTarget> WireTargets() {
  return {{"message", &Message},
          {"conversion", &Converted},
          {"stream", &Stream},
          {"datagram", &Datagram}};
}

}  // namespace palace
