// AuthorityStatus: whether this station commands the vehicle, and what it heard of others who try.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

namespace palace {

enum class AuthorityStanding : std::uint8_t {
  kNone,      ///< no vehicle that could grant anything
  kNoKey,     ///< view only: this station has no key for the vehicle
  kNoGrant,   ///< the vehicle was never heard to grant sessions
  kAsking,    ///< asked, not yet answered
  kHeld,      ///< this station commands
  kOther,     ///< another station commands
  kReleased,  ///< nobody commands, and this station does not ask
};

/// Messages to the vehicle, heard on the bus, that this station did not send.
struct ForeignTraffic {
  std::uint64_t count = 0;
  std::string what;    ///< the newest: "APPROVE on COMMAND"
  std::string from;    ///< its sender's address; empty where the bus does not tell
  double age_s = NAN;  ///< of the newest; NaN: none
};

struct AuthorityStatus {
  AuthorityStanding standing = AuthorityStanding::kNone;
  std::string why_not;      ///< why this station does not command, and what to do; empty: it does
  std::string key_name;     ///< of the key file; empty without a key
  std::string fingerprint;  ///< of the key; empty without a key
  std::string holder;       ///< "bravo 3F2A-91C0-77B4-E0D2": who commands; empty: nobody
  double holder_silent_s = NAN;   ///< how long the vehicle has not heard who commands
  bool holder_is_silent = false;  ///< by the vehicle's limit: command may be asked for
  bool can_ask = false;           ///< a person may ask for command, or take it over
  std::string refusal;            ///< the vehicle's answer to this station's last request
  ForeignTraffic foreign;

  bool commands() const { return standing == AuthorityStanding::kHeld; }
};

}  // namespace palace
