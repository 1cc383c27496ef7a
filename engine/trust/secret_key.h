// SecretKey: 32 secret bytes, and what is made of them.
//
//   mac          HMAC-SHA-512 of the bytes, its first 32 bytes (libsodium's crypto_auth)
//   derived key  the mac of what names it
//   id           first 8 bytes of the mac of "PALACE-KEY-ID-1": not secret; people see it as the
//                fingerprint, four groups of four hexadecimal digits
//
// The bytes lie in memory that is never swapped out, never part of a core dump and wiped at the
// end. Copies share them.
// Source: RFC 2104 (HMAC), RFC 6234 (SHA-512), by libsodium.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace palace {

using Mac = std::array<std::uint8_t, 32>;

class SecretKey {
 public:
  static constexpr std::size_t kBytes = 32;

  /// From the operating system's random numbers.
  static SecretKey Random();
  /// The same seed gives the same key: for lockstep simulation only, which no bus reaches.
  static SecretKey FromSeed(std::uint64_t seed);
  /// Takes 64 hexadecimal digits; anything else is a bug of the caller.
  static SecretKey FromHex(std::string_view digits);
  /// The key that `what` names, of this one.
  SecretKey Derive(std::span<const std::uint8_t> what) const;

  Mac Sign(std::span<const std::uint8_t> bytes) const;
  /// Takes the same time whatever differs.
  bool Verify(std::span<const std::uint8_t> bytes, const Mac& mac) const;
  std::uint64_t id() const { return id_; }

  /// For the key file only: hands the 64 digits to `write` and wipes them.
  template <typename Write>
  auto WithHex(Write write) const {
    std::array<char, 2 * kBytes + 1> digits{};
    ToHex(digits);
    auto result = write(std::string_view(digits.data(), 2 * kBytes));
    Wipe(digits.data(), digits.size());
    return result;
  }

 private:
  SecretKey();
  void Name();
  void ToHex(std::array<char, 2 * kBytes + 1>& digits) const;
  static void Wipe(void* bytes, std::size_t size);

  std::shared_ptr<std::uint8_t> bytes_;
  std::uint64_t id_ = 0;
};

/// "3F2A-91C0-77B4-E0D2"
std::string FingerprintText(std::uint64_t key_id);
/// Of the operating system, never 0.
std::uint64_t RandomWord();

}  // namespace palace
