// The bytes that a seal speaks of.
//
//   bytes = "PALACE-2 " + channel role + "\n" + fields
//   mac   = HMAC-SHA-512(key, bytes), its first 32 bytes
//
// The role is COMMAND, POSITION_ESTIMATE, SESSION_REQUEST or AUTHORITY, whatever the channel was
// renamed to. The fields are those of the message's .lcm file, in its order, as LCM sends them
// (big-endian, doubles by their IEEE bits, a text as its length with the closing zero, then its
// bytes and the zero), all but the mac, which comes last: so on the wire they are the payload
// without its first 8 bytes (the type's hash) and its last 32 (the mac).
//
// Key: of SESSION_REQUEST (ASK, TAKE_OVER) and AUTHORITY the pair key; of all else the session key,
//
//   session key = HMAC-SHA-512(pair key, "PALACE-2 SESSION\n" + boot_id + session_id + station_id
//                 + station's nonce + vehicle's challenge, 8 bytes each), its first 32 bytes
#pragma once

#include <cstdint>
#include <vector>

#include "engine/model/vehicle_message.h"
#include "engine/model/vehicle_state.h"
#include "engine/trust/secret_key.h"

namespace palace {

std::vector<std::uint8_t> SealedBytes(const Approval& approval);
std::vector<std::uint8_t> SealedBytes(const HoldRequest& hold);
std::vector<std::uint8_t> SealedBytes(const GoRequest& go);
std::vector<std::uint8_t> SealedBytes(const PositionEstimate& estimate);
std::vector<std::uint8_t> SealedBytes(const SessionRequest& request);
std::vector<std::uint8_t> SealedBytes(const AuthorityReport& report);

/// What a session's key is made of, besides the pair key.
struct SessionFacts {
  std::uint64_t boot_id = 0;
  std::uint64_t session_id = 0;
  std::uint64_t station_id = 0;
  std::uint64_t station_nonce = 0;
  std::uint64_t challenge = 0;  ///< the vehicle's, that the request named
};
SecretKey SessionKey(const SecretKey& pair, const SessionFacts& facts);

/// Counters rise apart on each of them.
enum class SealedChannel : std::uint8_t { kCommand, kEstimate, kSession };
inline constexpr std::size_t kSealedChannels = 3;

}  // namespace palace
