// What goes wrong: what a fault stops in flight, what it drops before, and what blocks approval.
#include <functional>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

struct Fault {
  const char* name;
  std::function<void(MissionRig&)> inject;
  double within_s;  ///< a descent must hold by then
};

void SetImageTime(MissionRig& rig, double offset_s) {
  rig.navigation.image_time_right = {ImageTime::State::kOff, offset_s, 0.005};
}

void SetLaser(MissionRig& rig, LaserHealth::State state) {
  rig.navigation.laser = {state, 0.9, 0.5};
}

class DescentFaults : public testing::TestWithParam<Fault> {};

TEST_P(DescentFaults, HoldsInTime) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.Run(1);
  GetParam().inject(rig);
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, GetParam().within_s)) << rig.mission.status().why;
  EXPECT_FALSE(rig.mission.status().approval.has_value());
  rig.link_up = true;
  rig.Run(1);
  EXPECT_GE(rig.SentCount<HoldRequest>(), 1);
  EXPECT_FALSE(rig.ApproveNow().ok());
}

INSTANTIATE_TEST_SUITE_P(
    , DescentFaults,
    testing::Values(
        Fault{"SiteOverALimit", [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.5},
        Fault{"SiteOffTheMap", [](MissionRig& r) { r.sites.erase(r.sites.begin()); }, 0.5},
        Fault{"CamerasStop", [](MissionRig& r) { r.cameras_up = false; }, 1.3},
        Fault{"PoseStops", [](MissionRig& r) { r.pose_up = false; }, 1.3},
        // Maps may come or not: what counts is ground measured, 2 s above the commit height.
        Fault{"MapsStop", [](MissionRig& r) { r.maps_up = false; }, 2.3},
        Fault{"MapsWithoutNewGround", [](MissionRig& r) { r.ground_age_s = 2.4; }, 2.3},
        Fault{"LeftFrozen", [](MissionRig& r) { r.stereo.left_frozen = true; }, 0.5},
        Fault{"RightFrozen", [](MissionRig& r) { r.stereo.right_frozen = true; }, 0.5},
        Fault{"RightBlack", [](MissionRig& r) { r.stereo.right_blank = true; }, 0.5},
        Fault{"LeftBlack", [](MissionRig& r) { r.stereo.left_blank = true; }, 0.5},
        Fault{"CamerasSwapped", [](MissionRig& r) { r.stereo.suspect_swapped = true; }, 0.5},
        Fault{"PicturesDoNotPair",
              [](MissionRig& r) {
                r.stereo_up = false;
                r.arrival.left_alone = r.arrival.right_alone = AddSeconds(r.now, 1000);
              },
              1.3},
        Fault{"AttitudeInvalid",
              [](MissionRig& r) {
                r.pose_up = false;
                r.arrival.poses_invalid = 5;
              },
              0.8},
        Fault{"EverySecondAttitudeInvalid", [](MissionRig& r) { r.arrival.poses_invalid = 1; },
              0.8},
        Fault{"ClockSteps", [](MissionRig& r) { r.clock_offset_us += 3'000'000; }, 0.3},
        Fault{"ClockStepsLive",
              [](MissionRig& r) {
                r.arrival.clock = ClockReading{.estimating = false, .stepped_s = -5};
                r.jumped = true;
              },
              0.3},
        Fault{"ImageTimeOff", [](MissionRig& r) { SetImageTime(r, 0.1); }, 0.2},
        Fault{"LinkStops", [](MissionRig& r) { r.link_up = false; }, 5.3},
        Fault{"VehicleRestarts", [](MissionRig& r) { r.vehicle.boot_id = 78; }, 0.3},
        Fault{"VehicleHolds", [](MissionRig& r) { r.vehicle.Set(VehicleMode::kHold); }, 0.3},
        Fault{"Operator", [](MissionRig& r) { EXPECT_TRUE(r.Do(HoldHere{}).ok()); }, 0.1}),
    [](const auto& row) { return row.param.name; });

class ArmedFaults : public testing::TestWithParam<Fault> {};

TEST_P(ArmedFaults, DropsTheSelectionAndTheApproval) {
  for (const bool approve : {false, true}) {
    SCOPED_TRACE(approve ? "approved" : "armed");
    MissionRig rig;
    rig.Arm();
    if (approve) {
      ASSERT_TRUE(rig.ApproveNow().ok());
    }
    GetParam().inject(rig);
    rig.Run(GetParam().within_s);
    EXPECT_NE(rig.state(), MissionState::kArmed);
    EXPECT_NE(rig.state(), MissionState::kApproved);
    EXPECT_NE(rig.state(), MissionState::kDescending);
    EXPECT_FALSE(rig.mission.status().approval.has_value());
    EXPECT_FALSE(rig.mission.status().can_approve);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ArmedFaults,
    testing::Values(Fault{"SiteOverALimit", [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.5},
                    Fault{"LimitsChanged", [](MissionRig& r) { r.settings_hash ^= 1; }, 0.1},
                    Fault{"CalibrationChanged", [](MissionRig& r) { r.calibration_hash ^= 1; },
                          0.1},
                    Fault{"VehicleRestarts", [](MissionRig& r) { r.vehicle.boot_id = 78; }, 0.1},
                    Fault{"EverySecondAttitudeInvalid",
                          [](MissionRig& r) { r.arrival.poses_invalid = 1; }, 0.8},
                    Fault{"ClockSteps", [](MissionRig& r) { r.clock_offset_us += 3'000'000; }, 0.1},
                    Fault{"SettingsApplied",
                          [](MissionRig& r) { r.mission.DropApproval("Limits applied"); }, 0.1}),
    [](const auto& row) { return row.param.name; });

struct Block {
  const char* name;
  GuardId guard;
  std::function<void(MissionRig&)> inject;
  double run_s;
};

// What stops a descent proposes nothing either: not in the search, not after a hold.
TEST(Faults, NothingIsProposedWhileAStopStands) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  rig.stereo.left_frozen = rig.stereo.right_frozen = true;
  ASSERT_TRUE(rig.RunUntil(MissionState::kSearch, 1));
  EXPECT_EQ(rig.mission.status().why, "Both cameras repeat their pictures");
  rig.Run(5);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.stereo = {};
  rig.Run(2.4);  // no more than one of twenty pictures is repeated, then a win of its own
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "a proposal is won anew";
  EXPECT_TRUE(rig.RunUntil(MissionState::kProposed, 2));
}

// A record is re-lived as it was flown; mere pictures have no vehicle that could be stopped.
TEST(Faults, AReplayProposesNothingWhereTheFlightDidNot) {
  for (const SourceKind source : {SourceKind::kReplay, SourceKind::kImages}) {
    MissionRig rig;
    rig.source = source;
    rig.stereo.suspect_swapped = true;
    EXPECT_EQ(rig.RunUntil(MissionState::kProposed, 5), source == SourceKind::kImages);
  }
}

TEST(Faults, AHoldIsNotLeftWhileItsReasonStands) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.stereo.left_frozen = true;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 1));
  rig.Run(10);
  EXPECT_EQ(rig.state(), MissionState::kHold);
  rig.stereo = {};
  EXPECT_TRUE(rig.RunUntil(MissionState::kProposed, 5));
}

TEST(Faults, ARefusedHoldGoesOnAndSaysWhy) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.vehicle.refuses_holds = true;
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  rig.Run(2);
  const int sent = rig.SentCount<HoldRequest>();
  EXPECT_GE(sent, 3);
  const auto& events = rig.mission.events();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const Event& event) {
    return event.text == "Vehicle refused the hold: Of another session";
  }));
  rig.vehicle.refuses_holds = false;
  rig.Run(2);
  EXPECT_EQ(rig.vehicle.mode, VehicleMode::kHold);
}

// The window's own hold came first: the mission's copy is refused as an old one.
TEST(Faults, ACopyOfAHoldThatIsObeyedIsNoRefusal) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  ASSERT_TRUE(rig.Do(HoldHere{}).ok());
  rig.vehicle.Set(VehicleMode::kHold);
  rig.vehicle.refuses_holds = true;
  rig.Run(1);
  for (const Event& event : rig.mission.events()) {
    EXPECT_EQ(event.text.find("Vehicle refused the hold"), std::string::npos) << event.text;
  }
}

class Guards : public testing::TestWithParam<Block> {};

TEST_P(Guards, BlockApprovalAndNameTheReason) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.mission.status().can_approve);
  GetParam().inject(rig);
  rig.Run(GetParam().run_s);
  const auto& status = rig.mission.status();
  EXPECT_FALSE(status.can_approve);
  const GuardResult* guard = FindGuard(status.guards, GetParam().guard);
  ASSERT_NE(guard, nullptr);
  EXPECT_FALSE(guard->pass) << status.cannot_approve_reason;
  EXPECT_FALSE(guard->reason.empty());
  const std::size_t events_before = rig.mission.events().size();
  const Status answer = rig.ApproveNow();
  ASSERT_FALSE(answer.ok());
  EXPECT_FALSE(answer.error().message.empty());
  EXPECT_GT(rig.mission.events().size(), events_before);
  EXPECT_EQ(rig.SentCount<Approval>(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    , Guards,
    testing::Values(
        Block{"Link", GuardId::kLink, [](MissionRig& r) { r.link_up = false; }, 1.2},
        Block{"Pose", GuardId::kAttitude, [](MissionRig& r) { r.pose_up = false; }, 0.4},
        Block{"Cameras", GuardId::kCameras, [](MissionRig& r) { r.cameras_up = false; }, 0.7},
        Block{"BlackCamera", GuardId::kCameras, [](MissionRig& r) { r.stereo.left_blank = true; },
              0.7},
        Block{"NoPairs", GuardId::kCameras,
              [](MissionRig& r) {
                r.stereo_up = false;
                r.arrival.left_alone = r.arrival.right_alone = AddSeconds(r.now, 1000);
              },
              0.7},
        Block{"AttitudeInvalid", GuardId::kAttitude,
              [](MissionRig& r) { r.arrival.poses_invalid = 1; }, 0.1},
        Block{"HalfIsLost", GuardId::kLink, [](MissionRig& r) { r.channels[2].lost_share = 0.52; },
              0.1},
        Block{"ClockUnsure", GuardId::kVehicle,
              [](MissionRig& r) { r.arrival.clock = ClockReading{.estimating = true}; }, 0.1},
        Block{"FrozenCamera", GuardId::kCameras,
              [](MissionRig& r) { r.stereo.right_frozen = true; }, 0.7},
        Block{"SwappedCameras", GuardId::kCameras,
              [](MissionRig& r) { r.stereo.suspect_swapped = true; }, 0.7},
        Block{"RowsApart", GuardId::kCameras, [](MissionRig& r) { r.stereo.row_error_px = 0.8; },
              0.7},
        Block{"LeftChannel", GuardId::kCameras, [](MissionRig& r) { r.channels[0].age_s = 1.8; },
              0.1},
        Block{"LeftChannelUnlisted", GuardId::kCameras,
              [](MissionRig& r) { r.channels.erase(r.channels.begin()); }, 0.1},
        Block{"RightChannelUnlisted", GuardId::kCameras,
              [](MissionRig& r) { r.channels.erase(r.channels.begin() + 1); }, 0.1},
        Block{"PoseChannelUnlisted", GuardId::kAttitude,
              [](MissionRig& r) { r.channels.pop_back(); }, 0.1},
        Block{"NoChannelListed", GuardId::kCameras, [](MissionRig& r) { r.channels.clear(); }, 0.1},
        Block{"RightChannelNever", GuardId::kCameras,
              [](MissionRig& r) { r.channels[1].state = ChannelHealth::State::kNever; }, 0.1},
        Block{"ImageTime", GuardId::kAttitude, [](MissionRig& r) { SetImageTime(r, -0.05); }, 0.1},
        Block{"GpsJump", GuardId::kPosition,
              [](MissionRig& r) {
                r.navigation.gps_agreement = {true, false, 8};
              },
              0.1},
        Block{"LaserStuck", GuardId::kPosition,
              [](MissionRig& r) { SetLaser(r, LaserHealth::State::kStuck); }, 0.1},
        Block{"LaserWrong", GuardId::kPosition,
              [](MissionRig& r) { SetLaser(r, LaserHealth::State::kWrong); }, 0.1},
        Block{"AttitudeOffGravity", GuardId::kAttitude,
              [](MissionRig& r) {
                r.navigation.gravity = {true, 3};
              },
              0.1},
        Block{"LaserLostBelow15m", GuardId::kPosition,
              [](MissionRig& r) {
                SetLaser(r, LaserHealth::State::kLost);
                r.vehicle.height_m = 14.9;
              },
              0.1},
        Block{"LaserNeverHeardBelow15m", GuardId::kPosition,
              [](MissionRig& r) {
                SetLaser(r, LaserHealth::State::kNever);
                r.vehicle.height_m = 14.9;
              },
              0.1},
        Block{"Map", GuardId::kMap, [](MissionRig& r) { r.maps_up = false; }, 2.3},
        Block{"Position", GuardId::kPosition,
              [](MissionRig& r) { r.navigation.gps.estimate.healthy = false; }, 0.1},
        Block{"Tracker", GuardId::kPosition, [](MissionRig& r) { r.tracker_locks = false; }, 0.1},
        Block{"Coherence", GuardId::kPosition, [](MissionRig& r) { r.tracker.coherence = 0.3; },
              0.1},
        Block{"CoherenceUnknown", GuardId::kPosition,
              [](MissionRig& r) { r.tracker.coherence = NAN; }, 0.1},
        Block{"Site", GuardId::kSite, [](MissionRig& r) { r.site_slope_rad = Rad(12); }, 0.1},
        Block{"NoLink", GuardId::kAuthority, [](MissionRig& r) { r.can_transmit = false; }, 0.1},
        Block{"NoCommand", GuardId::kAuthority, [](MissionRig& r) { r.authority = {}; }, 0.1},
        Block{"Recorder", GuardId::kRecorder, [](MissionRig& r) { r.recorder_ok = false; }, 0.1},
        Block{"Unlabelled", GuardId::kSource, [](MissionRig& r) { r.simulated = false; }, 0.1}),
    [](const auto& row) { return row.param.name; });

TEST(BlockedByTheTracker, SaysWhatTheTrackerMisses) {
  MissionRig rig;
  rig.Arm();
  rig.tracker_locks = false;
  rig.tracker.why_not_locked = "3 of 41 features found again, min 6";
  rig.Run(0.1);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason,
            "Tracker not locked: 3 of 41 features found again, min 6");
}

struct Sentence {
  const char* name;
  AlarmId id;
  std::function<void(MissionRig&)> inject;
  const char* words;
};

class SensorAlarms : public testing::TestWithParam<Sentence> {};

TEST_P(SensorAlarms, NameTheSensorAndTheLimit) {
  MissionRig rig;
  rig.Arm();
  GetParam().inject(rig);
  rig.Run(0.4);
  for (const Alarm& alarm : rig.mission.status().alarms) {
    if (alarm.kind == GetParam().id) {
      EXPECT_EQ(alarm.text, GetParam().words);
      return;
    }
  }
  FAIL() << "not raised";
}

INSTANTIATE_TEST_SUITE_P(
    , SensorAlarms,
    testing::Values(
        Sentence{"ImageTime", AlarmId::kImageTime, [](MissionRig& r) { SetImageTime(r, 0.1); },
                 "Image time off by 100 ms against attitude: pictures of the right camera are "
                 "late, limit 35 ms. Approve is blocked."},
        Sentence{"Gravity", AlarmId::kGravity,
                 [](MissionRig& r) {
                   r.navigation.gravity = {true, 3.04};
                 },
                 "Attitude is 3.0° off gravity, limit 1.5° (or the accelerometer errs). "
                 "Approve is blocked."},
        Sentence{"GravityJustOver", AlarmId::kGravity,
                 [](MissionRig& r) {
                   r.navigation.gravity = {true, 1.51};
                 },
                 "Attitude is 1.6° off gravity, limit 1.5° (or the accelerometer errs). "
                 "Approve is blocked."},
        Sentence{"GravityAgreesAgain", AlarmId::kGravity,
                 [](MissionRig& r) {
                   r.navigation.gravity = {true, 0.21};
                 },
                 "Attitude must agree with gravity for 5 fixes again: 0.2° off now, limit 1.5° (or "
                 "the accelerometer errs). Approve is blocked."},
        Sentence{
            "GravityUnknown", AlarmId::kGravity,
            [](MissionRig& r) {
              r.navigation.gravity = {true, NAN};
            },
            "Attitude must agree with gravity for 5 fixes again: not known now, limit 1.5° (or "
            "the accelerometer errs). Approve is blocked."},
        Sentence{"GpsJump", AlarmId::kGpsJump,
                 [](MissionRig& r) {
                   r.navigation.gps_agreement = {true, false, 8};
                 },
                 "GPS is 8.0 m off the inertial prediction, limit 1.0 m. The position does not "
                 "follow it. Approve is blocked."},
        Sentence{"GpsJumpedBack", AlarmId::kGpsJump,
                 [](MissionRig& r) {
                   r.navigation.gps_agreement = {true, false, 0.04};
                 },
                 "GPS must agree with the inertial prediction for 5 fixes again: 0.0 m off now, "
                 "limit 1.0 m. The position does not follow it. Approve is blocked."},
        Sentence{"GpsNotCompared", AlarmId::kGpsJump,
                 [](MissionRig& r) {
                   r.navigation.gps_agreement = {true, false, NAN};
                 },
                 "GPS must agree with the inertial prediction for 5 fixes again: not compared now, "
                 "limit 1.0 m. The position does not follow it. Approve is blocked."},
        Sentence{"GpsDrift", AlarmId::kGpsJump,
                 [](MissionRig& r) {
                   r.navigation.gps_agreement = {true, true, 0.4};
                 },
                 "GPS drifts against its own velocity by more than 0.3 m in 5 s. The position does "
                 "not follow it. Approve is blocked."},
        Sentence{"GpsLost", AlarmId::kGpsLost,
                 [](MissionRig& r) {
                   r.channels.push_back(
                       {ChannelId::kGps, ChannelHealth::State::kStale, 2.4, 5, 5, 9, 0, ""});
                 },
                 "No GPS for 2.4 s, limit 2.0 s. Approve is blocked without a position."},
        Sentence{"LaserLost", AlarmId::kLaserLost,
                 [](MissionRig& r) { SetLaser(r, LaserHealth::State::kLost); },
                 "Laser lost for 0.9 s, limit 0.5 s. Heights come from stereo and vision. Approve "
                 "is blocked below 15.0 m."},
        Sentence{"LaserStuck", AlarmId::kLaserStuck,
                 [](MissionRig& r) { SetLaser(r, LaserHealth::State::kStuck); },
                 "Laser repeats its range for 0.9 s, limit 0.8 s. Heights come from stereo and "
                 "vision. Approve is blocked."},
        Sentence{"LaserWrong", AlarmId::kLaserWrong,
                 [](MissionRig& r) { SetLaser(r, LaserHealth::State::kWrong); },
                 "Laser reads 0.50 of the height that stereo and motion show, limit 0.85 to 1.15. "
                 "Heights come from stereo and vision. Approve is blocked."},
        Sentence{"LaserAgreesAgain", AlarmId::kLaserWrong,
                 [](MissionRig& r) {
                   SetLaser(r, LaserHealth::State::kWrong);
                   r.navigation.laser.ratio = 0.97;
                 },
                 "Laser must agree within 10 % for 5 pairs again: reads 0.97 of the height that "
                 "stereo and motion show, limit 0.85 to 1.15. Heights come from stereo and vision. "
                 "Approve is blocked."}),
    [](const auto& row) { return row.param.name; });

TEST(LostLaser, BlocksNothingFromHighEnough) {
  MissionRig rig;
  rig.Arm();
  SetLaser(rig, LaserHealth::State::kLost);
  rig.Run(0.2);
  EXPECT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
}

// Stereo beside a laser that lies is no reason to calibrate.
TEST(LyingLaser, RaisesNoAlarmOfTheScale) {
  for (const bool lies : {false, true}) {
    MissionRig rig;
    rig.Arm();
    if (lies) {
      SetLaser(rig, LaserHealth::State::kWrong);
    }
    rig.Wait();
    MissionInputs in = rig.Inputs();
    in.navigation.range_agreement = {2, 0.01, 20};
    for (int i = 0; i < 4; ++i) {
      rig.mission.Update(in);
    }
    const auto& alarms = rig.mission.status().alarms;
    EXPECT_EQ(std::any_of(alarms.begin(), alarms.end(),
                          [](const Alarm& a) { return a.kind == AlarmId::kRangeScale; }),
              !lies);
  }
}

}  // namespace
}  // namespace palace
