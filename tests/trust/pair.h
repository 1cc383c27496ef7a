// A vehicle and its stations for tests: both ends of a session, with nothing between them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/random.h"
#include "engine/trust/approval_verifier.h"
#include "engine/trust/station_session.h"

namespace palace {

inline constexpr std::uint64_t kBoot = 9;
inline constexpr Timestamp kNow{2'000'000'000};

/// Numbers as a seed gives them: never 0.
inline std::function<std::uint64_t()> Words(std::uint64_t seed) {
  auto words = std::make_shared<RandomStream>(seed, "words");
  return [words] { return words->NextBits() | 1; };
}

inline VehicleTrust VehicleOf(std::vector<SecretKey> keys, std::uint64_t boot_id = kBoot,
                              std::uint64_t seed = 1) {
  return {.boot_id = boot_id, .keys = std::move(keys), .random_word = Words(seed)};
}

inline StationTrust StationOf(std::optional<SecretKey> key, std::string name,
                              std::uint64_t station_id) {
  return {.station_id = station_id,
          .station_name = std::move(name),
          .key = std::move(key),
          .key_name = "heli-1",
          .no_key_why = "No key",
          .random_word = Words(station_id)};
}

/// Hears the vehicle, asks, hears the answer. True when it commands.
inline bool Ask(StationSession& station, VehicleAuthority& vehicle, Timestamp& now,
                double seconds = 1) {
  now = AddSeconds(now, seconds);
  const auto now_s = [&] { return SecondsBetween(kNow, now); };
  station.Hear(vehicle.Report(now), now_s());
  if (const auto request = station.Tick(now, now_s())) {
    vehicle.Take(*request, now);
    now = AddSeconds(now, 0.01);
    station.Hear(vehicle.Report(now), now_s());
  }
  return station.Holds();
}

inline Approval GoodApproval(std::uint64_t id = 71) {
  Approval a;
  a.id = id;
  a.site_id = 101;
  a.map_hash = 11;
  a.settings_hash = 12;
  a.calibration_hash = 13;
  a.vehicle_boot_id = kBoot;
  a.approved_at = kNow;
  a.expires_at = AddSeconds(kNow, 30);
  a.p_WS = {10, 2, 0.5};
  a.approach_heading_rad = 0.5;
  a.glide_slope_rad = 0.7;
  a.descent_rate_mps = 1;
  a.clear_radius_m = 2.3;
  return a;
}

inline VehicleSituation Hovering(Timestamp now = AddSeconds(kNow, 1)) {
  return {now, {0, 0, -15}, 0.0};
}

inline SessionRequest RequestOf(SessionRequest::Kind kind) {
  SessionRequest request;
  request.kind = kind;
  return request;
}

template <typename Message>
Message Sealed(StationSession& station, Message message) {
  VehicleMessage sealed = std::move(message);
  station.Seal(sealed, kNow, 0);
  return std::get<Message>(sealed);
}

/// A vehicle whose station commands it.
struct Pair {
  explicit Pair(std::uint64_t seed = 1, std::uint64_t boot_id = kBoot)
      : key(SecretKey::FromSeed(seed)),
        vehicle(VehicleOf({key}, boot_id, seed)),
        station(StationOf(key, "alpha", 100 + seed)),
        verifier(vehicle) {
    commands = Ask(station, vehicle, now);
  }
  SecretKey key;
  VehicleAuthority vehicle;
  StationSession station;
  ApprovalVerifier verifier;
  Timestamp now = kNow;
  bool commands = false;
};

}  // namespace palace
