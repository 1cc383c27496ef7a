// StationSession: the station's side of a session. Asks the vehicle for command, seals what is sent
// in it, and tells messages of its own from others'.
//
//   asks by itself      when it first hears a vehicle that nobody commands, and again after that
//                       vehicle started anew while this station commanded
//   asks when told to   by a person: after another station commanded, or after a release
//
// A grant is the vehicle's AUTHORITY report that names this station and the nonce of its request,
// sealed with the pair key. Only such a report gives command, and while one is younger than
// kSure_s nothing that anybody could have sent takes it: what a vehicle that started anew, or one
// that obeys another key, says of itself counts that much later.
//
// No clock, no threads: seconds are any monotonic clock of the station.
// A restarted station is another station: it inherits neither command nor approval (I17).
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/mission/authority_status.h"
#include "engine/trust/message_bytes.h"

namespace palace {

/// What this station is, for as long as it runs.
struct StationTrust {
  std::uint64_t station_id = 0;  ///< random at each start
  std::string station_name;      ///< for people: 1 to 60 printable characters
  std::optional<SecretKey> key{};
  std::string key_name{};    ///< of its file
  std::string no_key_why{};  ///< why there is none, and what to do
  std::function<std::uint64_t()> random_word = RandomWord;
};

class StationSession {
 public:
  /// A sealed word of the vehicle stands alone for so long; it reports once a second.
  static constexpr double kSure_s = 3;

  explicit StationSession(StationTrust trust);

  /// What the vehicle said of itself. A report that is no newer than the last, of the same boot, or
  /// that is not sealed where it should be, changes nothing; nor does an unsealed one, or one of
  /// another boot, while a sealed one that names this session is younger than kSure_s.
  void Hear(const AuthorityReport& report, double now_s);
  /// A vehicle is there; it may be one that grants nothing.
  void HearVehicle(double now_s);
  /// What to send now, at most twice a second: a request for command, or a sign of life.
  std::optional<SessionRequest> Tick(Timestamp vehicle_now, double now_s);
  /// Seals what belongs to a session; completes a request for one. Without a session nothing is
  /// sealed, and no vehicle will take it.
  void Seal(VehicleMessage& message, Timestamp vehicle_now, double now_s);

  /// This station sent it, in this session, and its like was not heard longer ago than copies take.
  bool IsOwn(const VehicleMessage& message, double now_s);
  /// It carries the session of the station that commands, if that is another one: not ours to
  /// prove.
  bool IsOfHolder(const VehicleMessage& message) const;

  /// This station commands, by the vehicle's newest word, which is sealed.
  bool Holds() const;
  AuthorityStatus Status(double now_s) const;

 private:
  struct Granted {
    SecretKey key;
    std::uint64_t boot_id = 0;
    std::uint64_t session_id = 0;
    std::array<std::uint64_t, kSealedChannels> counters{};
  };
  struct HeardOnce {
    SealedChannel channel;
    std::uint64_t counter = 0;
    double at_s = 0;
  };
  struct HeardUpTo {
    std::uint64_t boot_id = 0;
    Timestamp time;
  };
  /// It may have been sent by anybody, or at another time, and something surer is known.
  bool IsDoubtful(const AuthorityReport& report, bool proven, double now_s) const;
  bool IsNews(const AuthorityReport& report, bool proven);
  void TakeGrant(const AuthorityReport& report, const SessionRequest& asked, double now_s);
  template <typename Message>
  void SealOne(SealedChannel channel, Message& message, Timestamp vehicle_now);
  template <typename Message>
  bool IsOwnSealed(SealedChannel channel, const Message& message, double now_s);
  bool IsOf(const std::optional<Granted>& session, std::uint64_t session_id,
            const std::vector<std::uint8_t>& bytes, const Mac& mac) const;
  void MakeRequest(SessionRequest& request);
  std::string WhyNot() const;

  StationTrust trust_;
  bool wants_ = true;
  bool take_over_ = false;  ///< as a person asked, until it is answered
  std::optional<AuthorityReport> report_;
  bool report_proven_ = false;  ///< sealed with the pair key
  double report_s_ = 0;
  std::map<std::uint64_t, Timestamp> proven_to_;  ///< by boot
  HeardUpTo unproven_to_;
  std::optional<double> vehicle_since_s_;
  std::deque<SessionRequest> asked_;  ///< not answered yet, the newest last
  std::optional<Granted> granted_;
  std::optional<Granted> before_;  ///< the grant before it: its last messages are still heard
  double granted_s_ = 0;
  double sent_s_ = -1e9;
  std::deque<HeardOnce> heard_;
  std::array<std::uint64_t, kSealedChannels> heard_to_{};
};

}  // namespace palace
