// A vehicle that knows the keys of two stations.
#pragma once

#include "tests/trust/pair.h"

namespace palace {

inline SessionRequest Wish(StationSession& station, SessionRequest::Kind kind, Timestamp now) {
  VehicleMessage message = RequestOf(kind);
  station.Seal(message, now, SecondsBetween(kNow, now));
  return std::get<SessionRequest>(message);
}

struct TwoStations {
  SecretKey key = SecretKey::FromSeed(1), other_key = SecretKey::FromSeed(2);
  VehicleAuthority vehicle{VehicleOf({key, other_key})};
  StationSession alpha{StationOf(key, "alpha", 1)}, bravo{StationOf(other_key, "bravo", 2)};
  Timestamp now = kNow;
  double now_s() const { return SecondsBetween(kNow, now); }
  void Tell(StationSession& station) {
    now = AddSeconds(now, 0.1);
    station.Hear(vehicle.Report(now), now_s());
  }
};

}  // namespace palace
