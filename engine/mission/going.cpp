#include "engine/mission/going.h"

#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/mission/limits.h"
#include "engine/mission/searching.h"
#include "engine/mission/wording.h"

namespace palace {
namespace {

constexpr double kAnswer_s = 5;  // the vehicle refuses it afterwards
constexpr double kPause_s = 1;
constexpr const char* kNoPlace = "Where the vehicle is, is not known";

bool Hovers(VehicleMode mode) {
  return mode == VehicleMode::kHover || mode == VehicleMode::kHold || mode == VehicleMode::kGo;
}

bool IsPlaceKnown(const MissionMemory& m) {
  return m.facts.position_healthy && m.facts.p_WB.allFinite() && std::isfinite(m.facts.yaw_rad);
}

/// Of the level part of the way, by the newest map.
double Unseen(const MissionMemory& m, const Eigen::Vector3d& there_W) {
  return UnseenOfWay(m.facts.elevation.get(), m.facts.p_WB, there_W);
}

void End(MissionTurn& turn, EventKind kind, std::string why, Timestamp now) {
  MissionStatus& status = turn.memory.status;
  AddEvent(turn, now, kind, why);
  status.going.reset();
  status.selection_ended = std::move(why) + ".";
  turn.memory.went_at = now;
}

}  // namespace

std::string WhyNowhere(const MissionMemory& m, Timestamp now) {
  const MissionState state = m.status.state;
  if (IsFlying(state) || state == MissionState::kAborting) {
    return IsFlying(state) ? words::kApprovedHold : words::CannotGoIn(state);
  }
  const auto& vehicle = m.watch.vehicle();
  if (!vehicle || vehicle->on_ground || !Hovers(vehicle->mode)) {
    return "The vehicle does not hover";
  }
  if (std::string old = words::Older("Vehicle status", m.watch.LinkAge(now), GuardLimits::link_s);
      m.watch.LinkAge(now) > GuardLimits::link_s) {
    return old;
  }
  if (!IsPlaceKnown(m)) {
    return kNoPlace;
  }
  if (m.went_at && SecondsBetween(*m.went_at, now) < kPause_s) {
    return "The way before ended just now";  // a second press meant that one
  }
  return m.status.search_stopped;
}

std::string WhyNotThere(const MissionMemory& m, const FlyTo& there, Timestamp now) {
  if (std::string why = WhyNowhere(m, now); !why.empty()) {
    return why;
  }
  const MissionFacts& facts = m.facts;
  return WhyNotThatWay(
      {facts.p_WB, facts.yaw_rad, facts.elevation.get(), m.status.area ? &*m.status.area : nullptr,
       facts.settings.slad.lander, PlaceDoubt(facts.navigation)},
      there);
}

void StartGoing(MissionTurn& turn, const FlyTo& there, const char* who, Timestamp now) {
  MissionMemory& m = turn.memory;
  if (m.status.state == MissionState::kHold || m.status.state == MissionState::kArmed) {
    ForgetSite(m);
  }
  RememberLook(m, there);
  m.go_id = RequestNumber(turn.station.session_id, ++m.requests_made);
  const Eigen::Vector3d way = there.p_WB - m.facts.p_WB;
  m.status.going = Going{there.p_WB, there.heading_rad, now, way.norm(), Unseen(m, there.p_WB)};
  m.status.selection_ended.clear();
  m.status.next_look.reset();
  AddEvent(turn, now, EventKind::kDecision,
           words::SentTo(way, there.heading_rad, m.status.going->unseen_m, who));
  m.winner = {};  // of what is seen from there
  if (m.status.state != MissionState::kSearch && m.status.state != MissionState::kNoLive) {
    Enter(turn, MissionState::kSearch, "Flies to another hover", now);
  }
  SendUntilAnswered(turn,
                    GoRequest{m.go_id,
                              m.watch.boot_id(),
                              AddSeconds(m.watch.VehicleTime(now), kAnswer_s),
                              there.p_WB,
                              there.heading_rad,
                              {}},
                    now);
}

void StopGoing(MissionTurn& turn, const std::string& why, Timestamp now) {
  End(turn, EventKind::kDecision, why + " on the way to another hover", now);
  AskToHold(turn, why, now);
}

void TakeGoAnswer(MissionTurn& turn, const CommandAck& ack, Timestamp now) {
  MissionMemory& m = turn.memory;
  m.repeating.reset();
  if (ack.result == AckResult::kAccepted) {
    m.status.going->accepted = true;
  } else {
    End(turn, EventKind::kVehicle, "Vehicle does not fly there: " + ack.reason, now);
  }
}

void FollowGoing(MissionTurn& turn, Timestamp now) {
  MissionMemory& m = turn.memory;
  if (!m.status.going) {
    return;
  }
  Going& going = *m.status.going;
  const auto& vehicle = m.watch.vehicle();
  const VehicleMode mode = vehicle ? vehicle->mode : VehicleMode::kUnknown;
  going.to_go_m = (going.p_WB - m.facts.p_WB).norm();
  going.unseen_m = Unseen(m, going.p_WB);
  if (mode == VehicleMode::kGo) {
    going.accepted = going.flown = true;
    const bool ours = m.repeating && std::holds_alternative<GoRequest>(*m.repeating);
    if (ours) {
      m.repeating.reset();  // its answer was lost, its deed says the same
    }
  }
  if (m.watch.rebooted()) {
    m.repeating.reset();
    End(turn, EventKind::kVehicle, words::kRestarted, now);
  } else if (going.flown && mode == VehicleMode::kHover) {
    End(turn, EventKind::kVehicle, "Vehicle hovers where it was sent", now);
  } else if (going.flown && mode != VehicleMode::kGo) {
    End(turn, EventKind::kVehicle, "Vehicle stopped on the way to another hover", now);
  } else if (!IsPlaceKnown(m)) {
    StopGoing(turn, kNoPlace, now);
  } else if (!going.accepted && SecondsBetween(going.since, now) >= kAnswer_s) {
    m.repeating.reset();
    End(turn, EventKind::kVehicle,
        WithNumbers("Vehicle did not answer within %.0f s: it was not sent", kAnswer_s), now);
  }
}

}  // namespace palace
