// SessionRole: what a session is to the mission, and what may therefore be done in it.
//
//   role                 select, sign   send   follows a record   starts anew after a jump
//   none                 no             yes    no                 no
//   live, simulated      yes            yes    no                 no
//   pictures             no             no     no                 yes
//   replayed, replayed   no             no     yes                yes
//     after a jump
//
// Nobody asks which role it is; everybody asks one of the questions below (invariant I7: nothing of
// a record or of mere pictures may reach a vehicle, whoever holds a link).
#pragma once

#include <cstdint>

#include "engine/model/source_kind.h"

namespace palace {

enum class SessionRole : std::uint8_t {
  kNone,  ///< no source was heard yet
  kLive,
  kSimulated,
  kPictures,  ///< a folder, cameras or a film, and no vehicle
  kReplayed,
  kReplayedAfterJump  ///< a log whose mission was not seen from its start
};

/// `jumped`: a replay was entered by a jump, so what led to its state is not known.
constexpr SessionRole RoleOf(SourceKind kind, bool jumped) {
  switch (kind) {
    case SourceKind::kNone:
      return SessionRole::kNone;
    case SourceKind::kLive:
      return SessionRole::kLive;
    case SourceKind::kSimulation:
      return SessionRole::kSimulated;
    case SourceKind::kReplay:
      return jumped ? SessionRole::kReplayedAfterJump : SessionRole::kReplayed;
    case SourceKind::kImages:
    case SourceKind::kCameras:
    case SourceKind::kVideo:
      return SessionRole::kPictures;
  }
  return SessionRole::kNone;
}

/// Frames come from somewhere, and their end means something.
constexpr bool HasSource(SessionRole role) { return role != SessionRole::kNone; }
/// A vehicle is at the other end, and its silence means something.
constexpr bool HasVehicle(SessionRole role) {
  return role == SessionRole::kLive || role == SessionRole::kSimulated;
}
/// Its vehicle must say of itself that it is a simulated one.
constexpr bool MustBeLabelled(SessionRole role) { return role == SessionRole::kSimulated; }
/// A person may select and approve a site.
constexpr bool MaySelect(SessionRole role) { return HasVehicle(role); }
/// Approvals are signed, so that a vehicle may take them.
constexpr bool MaySign(SessionRole role) { return HasVehicle(role); }
/// Messages may leave. Before the first source too: a wave-off waits for nothing (I5).
constexpr bool MaySend(SessionRole role) { return HasVehicle(role) || role == SessionRole::kNone; }
/// Recorded commands act, and the vehicle speaks of approvals that another session numbered.
constexpr bool FollowsRecord(SessionRole role) {
  return role == SessionRole::kReplayed || role == SessionRole::kReplayedAfterJump;
}
/// The mission re-lives what led to its state; after a jump the record tells the state instead.
constexpr bool SeenFromStart(SessionRole role) { return role != SessionRole::kReplayedAfterJump; }
/// A jump in time leads to another place of a record: nothing is in flight on its other side.
constexpr bool StartsAnewAfterJump(SessionRole role) {
  return FollowsRecord(role) || role == SessionRole::kPictures;
}
/// There is no vehicle that could say anything.
constexpr bool HasPicturesOnly(SessionRole role) { return role == SessionRole::kPictures; }

/// Why nothing can be selected or commanded on this source; empty with a vehicle.
const char* WhyNoVehicle(SourceKind kind);

}  // namespace palace
