// Random commands and faults for thousands of steps; what must never be broken is checked at each.
#include <set>

#include "engine/core/random.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

bool Holds(MissionState state, std::initializer_list<MissionState> states) {
  return std::find(states.begin(), states.end(), state) != states.end();
}

/// Faults come and go; each lasts a random while.
void Disturb(MissionRig& rig, RandomStream& random) {
  const auto toggle = [&](bool& good, double fail, double heal) {
    good = good ? random.Uniform() >= fail : random.Uniform() < heal;
  };
  toggle(rig.link_up, 0.002, 0.1);
  toggle(rig.cameras_up, 0.002, 0.1);
  toggle(rig.pose_up, 0.002, 0.1);
  toggle(rig.maps_up, 0.002, 0.1);
  toggle(rig.recorder_ok, 0.001, 0.1);
  toggle(rig.tracker_locks, 0.002, 0.2);
  toggle(rig.vehicle.answers, 0.01, 0.3);
  rig.tracker.coherence = random.Uniform() < 0.01 ? NAN : 0.95;
  if (random.Uniform() < 0.002) {
    rig.site_slope_rad = Rad(12);
  } else if (random.Uniform() < 0.1) {
    rig.site_slope_rad = 0;
  }
  if (random.Uniform() < 0.001) {
    rig.settings_hash += 1;
  }
  if (random.Uniform() < 0.0005) {
    ++rig.vehicle.boot_id;
    rig.vehicle.accepted_id = 0;
    rig.vehicle.Set(VehicleMode::kHover);
    rig.vehicle.approval_id = 0;
    rig.vehicle.height_m = 20;
  }
  if (rig.vehicle.mode == VehicleMode::kHold || rig.vehicle.mode == VehicleMode::kHover) {
    rig.vehicle.height_m = std::max(rig.vehicle.height_m, 12.0);
  }
}

struct Request {
  CommandAction action;
  CommandOrigin origin = CommandOrigin::kOperator;
};

std::optional<Request> RandomRequest(const MissionRig& rig, RandomStream& random) {
  if (random.Uniform() > 0.25) {
    return std::nullopt;
  }
  const std::uint64_t site =
      random.Uniform() < 0.8 ? 101 : 102 + static_cast<std::uint64_t>(random.Index(2));
  const std::uint64_t sequence = rig.sequence - static_cast<std::uint64_t>(random.Index(3));
  const CommandOrigin origin =
      random.Uniform() < 0.1
          ? CommandOrigin::kReplay
          : (random.Uniform() < 0.2 ? CommandOrigin::kScript : CommandOrigin::kOperator);
  switch (random.Index(60)) {
    case 0:
      return Request{DisarmSite{}, origin};
    case 1:
      return Request{RefuseSite{site}, origin};
    case 2:
      return Request{HoldHere{}, origin};
    case 3:
      return Request{WaveOff{}, origin};
    case 4:
    case 5:
    case 6:
      return Request{AcknowledgeWaveOff{}, origin};
    case 7:
    case 8:
    case 15:
    case 16:
    case 17:
    case 18:
      return Request{
          AcknowledgeAlarm{rig.mission.status().alarms.empty() ? "none"
                                                               : rig.mission.status().alarms[0].id},
          origin};
    case 9:
    case 10:
    case 11:
    case 12:
    case 13:
    case 14:
      return Request{SelectSite{site}, origin};
    case 23:
    case 24:
      return Request{TurnApproach{site, static_cast<int>(random.Index(10)) - 1}, origin};
    case 19:
    case 20:
    case 21:
    case 22:
      return Request{LookAtSite{site, sequence, 9}, origin};
    default:
      return Request{
          ApproveSite{rig.mission.status().armed ? rig.mission.status().armed->id : site, sequence},
          origin};
  }
}

class RandomMission : public testing::TestWithParam<int> {};

TEST_P(RandomMission, NeverBreaksAnInvariant) {
  RandomStream random(static_cast<std::uint64_t>(GetParam()), "mission");
  MissionRig rig;
  for (const std::uint64_t id : {101, 102}) {
    rig.Site(id)->confirmed = id == 102;
    rig.Site(id)->look_height_m = id == 101 ? 9 : NAN;
  }
  std::set<std::uint64_t> dead;  // approval ids that were killed
  std::uint64_t last_id = 0;
  int approvals = 0, looked = 0, wave_offs = 0, holds = 0;
  for (int step = 0; step < 6000; ++step) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + " step " + std::to_string(step));
    Disturb(rig, random);
    if (rig.state() == MissionState::kLanded) {  // the next flight: somebody lifts it off
      rig.vehicle.Set(VehicleMode::kHover);
      rig.vehicle.height_m = 20;
      for (int i = 0; i < 20 && !rig.mission.status().why_no_wave_off.empty(); ++i) {
        rig.Step();
      }
      ASSERT_TRUE(rig.Do(WaveOff{}).ok());
    }
    const MissionStatus before = rig.mission.status();
    const std::size_t events_before = rig.mission.events().size();
    if (const auto request = RandomRequest(rig, random)) {
      const Status answer = rig.Do(request->action, request->origin);
      const MissionStatus& after = rig.mission.status();
      if (!answer.ok()) {  // I22
        ASSERT_FALSE(answer.error().message.empty());
        ASSERT_GT(rig.mission.events().size(), events_before);
        ASSERT_EQ(after.state, before.state);
      }
      if (request->origin == CommandOrigin::kReplay) {  // I7
        ASSERT_FALSE(answer.ok());
      } else if (std::holds_alternative<WaveOff>(request->action) &&
                 !before.why_no_wave_off.empty()) {  // it stands on the ground
        ASSERT_FALSE(answer.ok());
      } else if (std::holds_alternative<WaveOff>(request->action)) {  // I5, I21
        ASSERT_TRUE(answer.ok());
        ASSERT_EQ(after.state, MissionState::kAborting);
        auto messages = rig.mission.TakeMessages();
        ASSERT_TRUE(!messages.empty() && std::holds_alternative<AbortRequest>(messages.back()));
        for (auto& message : messages) {
          rig.vehicle.Take(message, rig.VehicleNow());
        }
        ++wave_offs;
      } else if ((std::holds_alternative<ApproveSite>(request->action) ||
                  std::holds_alternative<LookAtSite>(request->action)) &&
                 answer.ok()) {
        const bool looks = std::holds_alternative<LookAtSite>(request->action);
        ++(looks ? looked : approvals);
        ASSERT_EQ(after.approval->stop_height_m, looks ? 9 : 0);
        ASSERT_EQ(before.state, MissionState::kArmed);  // never without arming
        ASSERT_TRUE(before.can_approve);                // and only what the guards allowed (I3)
        ASSERT_TRUE(after.approval.has_value());
        ASSERT_EQ(after.approval->site_id, before.armed->id);         // I1, I2
        ASSERT_EQ(after.approval->settings_hash, rig.settings_hash);  // I1
        ASSERT_EQ(after.approval->vehicle_boot_id, rig.vehicle.boot_id);
        ASSERT_GT(after.approval->id, last_id);  // I9
        const auto lasts_us = after.approval->expires_at.us - after.approval->approved_at.us;
        if (before.approach->turned()) {  // and the way round
          ASSERT_EQ(after.approval->approach_heading_rad, HeadingFromSector(before.approach->side));
          ASSERT_GE(lasts_us, 30'000'000);
          ASSERT_LE(lasts_us, 120'000'000);
        } else {
          ASSERT_EQ(lasts_us, 30'000'000);
        }
        last_id = after.approval->id;
      }
    }
    const auto live_before = rig.mission.status().approval;
    rig.Step();
    const MissionStatus& status = rig.mission.status();
    ASSERT_FALSE(status.IsLook() && status.state == MissionState::kLanded);
    if (live_before && !(status.approval && status.approval->id == live_before->id)) {
      dead.insert(live_before->id);
    }
    if (status.approval) {
      ASSERT_EQ(dead.count(status.approval->id), 0U);  // I14
      ASSERT_TRUE(Holds(status.state, {MissionState::kApproved, MissionState::kDescending,
                                       MissionState::kLanded}));
    }
    if (Holds(status.state, {MissionState::kHold, MissionState::kAborting})) {
      ASSERT_FALSE(status.approval.has_value());  // I14
    }
    if (status.state == MissionState::kHold && before.state == MissionState::kDescending) {
      ++holds;
    }
    if (status.state == MissionState::kDescending) {  // I11, I12: what the vehicle says it does
      ASSERT_TRUE(status.approval.has_value() && status.armed.has_value());
      ASSERT_EQ(status.approval->site_id, status.armed->id);
    }
    if (status.can_approve) {  // I3
      ASSERT_EQ(status.state, MissionState::kArmed);
      ASSERT_TRUE(rig.tracker_locks && rig.tracker.coherence >= 0.7);
      ASSERT_TRUE(rig.recorder_ok || !status.alarms.empty());
      ASSERT_TRUE(rig.site_slope_rad == 0 || !rig.maps_up || !rig.cameras_up);
      ASSERT_EQ(FirstFailure(status.guards), nullptr);
    }
    if (before.state == MissionState::kAborting && status.state != MissionState::kAborting) {
      ASSERT_EQ(status.state, MissionState::kSearch);  // I21
    }
  }
  RecordProperty("approvals", approvals);
  RecordProperty("wave_offs", wave_offs);
  RecordProperty("holds", holds);
  EXPECT_GT(approvals, 3) << "the walk must reach what it checks";
  EXPECT_GT(wave_offs, 3);
  EXPECT_GT(holds, 0);
}

INSTANTIATE_TEST_SUITE_P(, RandomMission, testing::Range(1, 9));

TEST(MissionProperties, SameInputsGiveTheSameEvents) {
  const auto fly = [] {
    MissionRig rig;
    RandomStream random(3, "twice");
    for (int step = 0; step < 2000; ++step) {
      Disturb(rig, random);
      if (const auto request = RandomRequest(rig, random)) {
        const Status ignored = rig.Do(request->action, request->origin);
        static_cast<void>(ignored);
      }
      rig.Step();
    }
    std::string text;
    for (const Event& event : rig.mission.events()) {
      text += std::to_string(event.time.us) + event.text + "\n";
    }
    return text;
  };
  EXPECT_EQ(fly(), fly());
}

/// On the ground it is not offered: wave_off_test.
TEST(MissionProperties, WaveOffWorksInEveryStateOfTheAir) {
  using S = MissionState;
  const std::vector<std::pair<S, std::function<void(MissionRig&)>>> ways = {
      {S::kNoLive, [](MissionRig&) {}},
      {S::kSearch, [](MissionRig& r) { r.Step(); }},
      {S::kProposed, [](MissionRig& r) { r.RunUntil(S::kProposed); }},
      {S::kArmed, [](MissionRig& r) { r.Arm(); }},
      {S::kApproved,
       [](MissionRig& r) {
         r.Arm();
         ASSERT_TRUE(r.ApproveNow().ok());
       }},
      {S::kDescending,
       [](MissionRig& r) {
         r.Arm();
         ASSERT_TRUE(r.ApproveNow().ok());
         r.RunUntil(S::kDescending);
       }},
  };
  for (const auto& [state, reach] : ways) {
    SCOPED_TRACE(MissionStateName(state));
    MissionRig rig;
    reach(rig);
    ASSERT_EQ(rig.state(), state);
    rig.mission.TakeMessages();
    ASSERT_TRUE(rig.Do(WaveOff{}).ok());
    EXPECT_EQ(rig.state(), S::kAborting);
    const auto messages = rig.mission.TakeMessages();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<AbortRequest>(messages[0]));
    ASSERT_TRUE(rig.Do(WaveOff{}).ok());  // pressed again: sent again
    EXPECT_EQ(rig.mission.TakeMessages().size(), 1U);
  }
}

}  // namespace
}  // namespace palace
