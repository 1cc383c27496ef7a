// What a hostile or broken sender puts on a bus: the storms of the attack tests, by seed.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "engine/wire/channels.h"
#include "tests/support/lcm_datagrams.h"

namespace palace {

class BusStorm {
 public:
  /// `payloads`: whole payloads of our types, channel first, to be spoilt.
  BusStorm(std::uint32_t seed, std::vector<std::pair<std::string, Bytes>> payloads)
      : random_(seed), payloads_(std::move(payloads)) {}

  /// The two that ended liblcm's process: an offset that wraps 32 bits.
  static std::vector<Bytes> Killing(const std::string& channel) {
    return {FragmentDatagram({.number = 1, .size = 1000, .fragments = 2}, channel, Bytes(100, 1)),
            FragmentDatagram(
                {.number = 1, .size = 1000, .offset = 0xffffff00, .fragment = 1, .fragments = 2},
                "", Bytes(400, 1))};
  }
  /// 43 bytes or so that claim a message of 63 MB in one fragment.
  Bytes Claim() {
    const std::string& channel = Channel();
    return FragmentDatagram({.number = number_++, .size = 63u << 20}, channel,
                            Bytes(channel.size() < 22 ? 22 - channel.size() : 1, 7));
  }
  /// Rubbish, with the magic numbers and our channels often enough to get beyond the header.
  Bytes Random() {
    const auto kind = random_() % 8;
    if (kind == 0) {
      return Rubbish(1 + random_() % 100);
    }
    if (kind < 3) {
      return ShortDatagram(static_cast<std::uint32_t>(random_()),
                           kind == 1 ? Rubbish(random_() % 90) : NameBytes(Channel()),
                           Rubbish(random_() % 400));
    }
    const FragmentFields fields{static_cast<std::uint32_t>(random_() % 50), Wild32(), Wild32(),
                                Wild16(), Wild16()};
    return FragmentDatagram(fields, Channel(), Rubbish(random_() % 1500));
  }
  /// A whole message of one of our types: cut, with bits turned, or with counts, stamps and numbers
  /// replaced by the worst there are.
  Bytes Payload() {
    auto [channel, payload] = payloads_[random_() % payloads_.size()];
    switch (random_() % 4) {
      case 0:
        payload.resize(random_() % (payload.size() + 1));
        break;
      case 1:
        for (auto flips = 1 + random_() % 8; flips-- > 0 && !payload.empty();) {
          payload[random_() % payload.size()] ^= static_cast<std::uint8_t>(1u << random_() % 8);
        }
        break;
      case 2:
        channel = Channel();
        break;
      default:
        Spoil(payload);
    }
    return ShortDatagram(number_++, channel, payload);
  }

 private:
  const std::string& Channel() { return payloads_[random_() % payloads_.size()].first; }
  Bytes Rubbish(std::size_t size) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random_());
    }
    return bytes;
  }
  std::uint32_t Wild32() {
    constexpr std::uint32_t kWorst[] = {0,         1,          100,        1000,      1u << 20,
                                        63u << 20, 0x7fffffff, 0xffffff00, 0xffffffff};
    return random_() % 3 == 0 ? static_cast<std::uint32_t>(random_())
                              : kWorst[random_() % std::size(kWorst)];
  }
  std::uint16_t Wild16() {
    constexpr std::uint16_t kWorst[] = {0, 1, 2, 3, 1000, 0x7fff, 0xffff};
    return kWorst[random_() % std::size(kWorst)];
  }
  /// Four or eight bytes behind the type's hash become an extreme count, stamp or number.
  void Spoil(Bytes& payload) {
    constexpr std::uint64_t kWorst[] = {0,
                                        1,
                                        0xffffffffffffffff,
                                        0x7fffffffffffffff,
                                        0x8000000000000000,
                                        0x7ff8000000000000,  // NaN
                                        0x7ff0000000000000,  // infinity
                                        0x7fffffff7fffffff,
                                        0x4000000040000000};
    if (payload.size() < 16) {
      return;
    }
    const std::uint64_t worst = kWorst[random_() % std::size(kWorst)];
    const std::size_t at = random_() % 3 == 0 ? 8 : 8 + random_() % (payload.size() - 15);
    for (std::size_t i = 0; i < 8; ++i) {
      payload[at + i] = static_cast<std::uint8_t>(worst >> (56 - 8 * i));
    }
  }

  std::mt19937 random_;
  std::vector<std::pair<std::string, Bytes>> payloads_;
  std::uint32_t number_ = 1;
};

}  // namespace palace
