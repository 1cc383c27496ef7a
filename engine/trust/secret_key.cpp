#include "engine/trust/secret_key.h"

#include <cstdio>
#include <new>

#include <sodium.h>

#include "engine/core/check.h"

namespace palace {
namespace {

static_assert(SecretKey::kBytes == crypto_auth_KEYBYTES && sizeof(Mac) == crypto_auth_BYTES);

constexpr std::string_view kIdLabel = "PALACE-KEY-ID-1";
constexpr std::string_view kSeedLabel = "PALACE-SEED-KEY-1";

std::span<const std::uint8_t> BytesOf(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

SecretKey::SecretKey() {
  PALACE_CHECK(sodium_init() >= 0);
  // Pages of its own, locked, left out of core dumps; sodium_free wipes them.
  auto* bytes = static_cast<std::uint8_t*>(sodium_malloc(kBytes));
  if (bytes == nullptr) {
    throw std::bad_alloc();  // as any allocation that fails; whoever survives those survives this
  }
  bytes_ = std::shared_ptr<std::uint8_t>(bytes, [](std::uint8_t* p) { sodium_free(p); });
}

void SecretKey::Name() {
  const Mac mac = Sign(BytesOf(kIdLabel));
  id_ = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    id_ = id_ << 8 | mac[i];
  }
}

SecretKey SecretKey::Random() {
  SecretKey key;
  randombytes_buf(key.bytes_.get(), kBytes);
  key.Name();
  return key;
}

SecretKey SecretKey::FromSeed(std::uint64_t seed) {
  SecretKey key;
  std::array<std::uint8_t, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(seed >> (56 - 8 * i));
  }
  crypto_generichash(key.bytes_.get(), kBytes, bytes.data(), bytes.size(),
                     BytesOf(kSeedLabel).data(), kSeedLabel.size());
  key.Name();
  return key;
}

SecretKey SecretKey::FromHex(std::string_view digits) {
  SecretKey key;
  std::size_t written = 0;
  const int read = sodium_hex2bin(key.bytes_.get(), kBytes, digits.data(), digits.size(), nullptr,
                                  &written, nullptr);
  PALACE_CHECK(read == 0 && written == kBytes && digits.size() == 2 * kBytes);
  key.Name();
  return key;
}

SecretKey SecretKey::Derive(std::span<const std::uint8_t> what) const {
  SecretKey key;
  crypto_auth(key.bytes_.get(), what.data(), what.size(), bytes_.get());
  key.Name();
  return key;
}

Mac SecretKey::Sign(std::span<const std::uint8_t> bytes) const {
  Mac mac{};
  crypto_auth(mac.data(), bytes.data(), bytes.size(), bytes_.get());
  return mac;
}

bool SecretKey::Verify(std::span<const std::uint8_t> bytes, const Mac& mac) const {
  return crypto_auth_verify(mac.data(), bytes.data(), bytes.size(), bytes_.get()) == 0;
}

void SecretKey::ToHex(std::array<char, 2 * kBytes + 1>& digits) const {
  sodium_bin2hex(digits.data(), digits.size(), bytes_.get(), kBytes);
}

void SecretKey::Wipe(void* bytes, std::size_t size) { sodium_memzero(bytes, size); }

std::string FingerprintText(std::uint64_t key_id) {
  char text[24];
  std::snprintf(text, sizeof text, "%04X-%04X-%04X-%04X", static_cast<unsigned>(key_id >> 48),
                static_cast<unsigned>(key_id >> 32 & 0xFFFF),
                static_cast<unsigned>(key_id >> 16 & 0xFFFF),
                static_cast<unsigned>(key_id & 0xFFFF));
  return text;
}

std::uint64_t RandomWord() {
  PALACE_CHECK(sodium_init() >= 0);
  std::uint64_t word = 0;
  while (word == 0) {
    randombytes_buf(&word, sizeof word);
  }
  return word;
}

}  // namespace palace
