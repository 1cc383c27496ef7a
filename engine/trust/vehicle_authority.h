// VehicleAuthority: the vehicle's side of a session. Who commands, and whether a message is theirs.
//
//   nobody commands      whoever asks with a pair key of this vehicle is granted a session
//   a station commands   who asks is refused, with the reason, be it that station itself; but not
//                        when no sealed message of it was heard for kSilent_s, or when the request
//                        is to take over
//   granted              a random session id; the session before it is dead at once
//   released             nobody commands
//
// A request names the vehicle's newest challenge, which changes with every grant and release: one
// that was recorded grants nothing again. Seals: constant-time mac, then session, then a counter
// above all seen on that channel (invariants I7, I9, I10). No clock: the vehicle's time is given.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/trust/message_bytes.h"

namespace palace {

/// Who this vehicle is, and whom it obeys.
struct VehicleTrust {
  std::uint64_t boot_id = 0;      ///< random at each start
  std::vector<SecretKey> keys{};  ///< one a station that may command it
  bool takes_unsealed = false;    ///< a bench: whoever speaks is obeyed, nothing is checked
  std::function<std::uint64_t()> random_word = RandomWord;
};

class VehicleAuthority {
 public:
  static constexpr double kSilent_s = 5;

  explicit VehicleAuthority(VehicleTrust trust);

  enum class Answer : std::uint8_t { kRefused, kGranted, kKept, kReleased };
  Answer Take(const SessionRequest& request, Timestamp now);
  /// Empty: the message is of the session that commands, and its counter is spent.
  std::string Check(SealedChannel channel, std::span<const std::uint8_t> bytes, const Seal& seal,
                    Timestamp now);
  /// What Check would answer; nothing is remembered.
  std::string WhyRefused(SealedChannel channel, std::span<const std::uint8_t> bytes,
                         const Seal& seal) const;
  /// The mac is of the session that commands, whatever the counter.
  bool IsOfSession(std::span<const std::uint8_t> bytes, const Seal& seal) const;

  AuthorityReport Report(Timestamp now) const;
  /// Something of the report, besides its time, is news.
  bool TakeNews();
  std::uint64_t boot_id() const { return trust_.boot_id; }
  bool takes_unsealed() const { return trust_.takes_unsealed; }

 private:
  struct Session {
    SecretKey pair, key;
    AuthorityReport told;  ///< its part of the report
    std::array<std::uint64_t, kSealedChannels> counters{};
  };
  std::string Grant(const SessionRequest& request, Timestamp now);
  const SecretKey* FindKey(std::uint64_t id) const;

  VehicleTrust trust_;
  std::uint64_t challenge_;
  std::optional<Session> session_;
  std::uint64_t refused_station_id_ = 0;
  std::string refusal_;
  bool news_ = true;
};

}  // namespace palace
