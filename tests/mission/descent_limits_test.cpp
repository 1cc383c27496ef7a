// Limits that people see: who acts on them, and that he does. The state machine is in
// transitions_test.cpp.
#include "engine/mission/descent_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

const LimitRow& Row(const MissionRig& rig, LimitId id) {
  const LimitRow* row = FindLimit(rig.mission.status().limits, id);
  PALACE_CHECK(row != nullptr, static_cast<int>(id));
  return *row;
}

const Alarm* FindAlarm(const MissionRig& rig, const std::string& id) {
  const auto& alarms = rig.mission.status().alarms;
  const auto alarm =
      std::find_if(alarms.begin(), alarms.end(), [&](const Alarm& a) { return a.id == id; });
  return alarm == alarms.end() ? nullptr : &*alarm;
}

void Descend(MissionRig& rig) {
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
}

TEST(WindGuard, BlocksApproveBeyondItsLimitOnly) {
  const struct {
    double wind_mps;
    bool may;
  } rows[] = {{0, true}, {8, true}, {8.1, false}, {14, false}, {NAN, true}};
  for (const auto& row : rows) {
    SCOPED_TRACE(row.wind_mps);
    MissionRig rig;
    rig.vehicle.wind_mps = row.wind_mps;
    rig.Arm();
    EXPECT_EQ(rig.mission.status().can_approve, row.may);
    EXPECT_EQ(rig.ApproveNow().ok(), row.may);
    EXPECT_EQ(rig.SentCount<Approval>() > 0 || !rig.mission.TakeMessages().empty(), row.may);
  }
  MissionRig rig;
  rig.vehicle.wind_mps = 9.24;
  rig.Arm();
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, "Wind 9.2 m/s, max 8.0 m/s");
  EXPECT_EQ(rig.mission.status().guards.back().id, GuardId::kWind);
  EXPECT_TRUE(Row(rig, LimitId::kWind).over);
  EXPECT_EQ(Row(rig, LimitId::kWind).enforced_by, EnforcedBy::kGuard);
}

TEST(WindGuard, NoWindComesFromNowhere) {
  for (const double wind_mps : {0.0, 0.4, 0.6, 5.0}) {
    MissionRig rig;
    rig.vehicle.wind_mps = wind_mps;
    rig.Arm();
    EXPECT_EQ(std::isfinite(Row(rig, LimitId::kOffWind).value), wind_mps >= 0.5) << wind_mps;
  }
}

TEST(OffWind, IsOfTheWayThatTheFiguresAreOf) {
  MissionRig rig;
  rig.vehicle.wind_mps = 5;
  rig.Site(101)->corridor_clear = true;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  ASSERT_FALSE(rig.mission.status().armed.has_value());
  EXPECT_TRUE(std::isfinite(Row(rig, LimitId::kOffWind).value));
  EXPECT_TRUE(std::isfinite(rig.mission.status().time_to_touchdown_s));
  rig.north_m = NAN;  // nobody tells where the vehicle is: no way to a site is known
  rig.Run(0.3);
  EXPECT_TRUE(std::isnan(Row(rig, LimitId::kOffWind).value));
  EXPECT_TRUE(std::isnan(rig.mission.status().time_to_touchdown_s));
}

TEST(WindGuard, AWindThatIsNotKnownIsForInformation) {
  MissionRig unknown;
  unknown.vehicle.wind_mps = NAN;
  unknown.Arm();
  EXPECT_EQ(Row(unknown, LimitId::kWind).enforced_by, EnforcedBy::kNobody);
  MissionRig stale;
  stale.vehicle.wind_mps = 14;
  stale.Arm();
  stale.link_up = false;
  stale.Run(1.3);
  EXPECT_TRUE(std::isnan(Row(stale, LimitId::kWind).value));
  EXPECT_FALSE(Row(stale, LimitId::kWind).over);
  EXPECT_FALSE(stale.mission.status().can_approve);  // by G1: the link is stale
}

// What a guard refuses by is known before the hold is pressed.
TEST(WindGuard, BeyondItsLimitAHoverSaysSo) {
  MissionRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  rig.Run(0.6);
  EXPECT_EQ(FindAlarm(rig, "wind"), nullptr);
  rig.vehicle.wind_mps = 8.04;
  rig.Run(0.6);
  const Alarm* alarm = FindAlarm(rig, "wind");
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->text, "Wind 8.1 m/s, limit 8.0 m/s. No site is approved in it: wait for less.");
  rig.vehicle.wind_mps = 7;
  rig.Run(0.6);
  alarm = FindAlarm(rig, "wind");
  EXPECT_TRUE(alarm == nullptr || !alarm->active);
}

TEST(WindGuard, ARecordedApprovalMetItsOwnWind) {
  MissionRig rig;
  rig.source = SourceKind::kReplay;
  rig.can_transmit = rig.recorder_ok = false;
  rig.vehicle.wind_mps = 12;
  ASSERT_TRUE(rig.RunUntil(MissionState::kProposed));
  ASSERT_TRUE(rig.Do(SelectSite{101}, CommandOrigin::kReplay).ok());
  rig.Run(1.5);
  EXPECT_TRUE(rig.ApproveNow(CommandOrigin::kReplay).ok());
}

struct LimitCase {
  const char* alarm;
  LimitId limit;
  std::function<void(MissionRig&)> exceed;
  const char* text;
};

class DescentAlarms : public testing::TestWithParam<LimitCase> {};

// The limit on the screen, the one in the alarm's text and the one that raised it are one number.
TEST_P(DescentAlarms, ComeWhenTheRowIsOver) {
  const LimitCase& c = GetParam();
  MissionRig rig;
  Descend(rig);
  EXPECT_EQ(FindAlarm(rig, c.alarm), nullptr);
  c.exceed(rig);
  rig.Run(0.6);
  ASSERT_EQ(rig.state(), MissionState::kDescending) << rig.mission.status().why;
  EXPECT_TRUE(Row(rig, c.limit).over);
  EXPECT_EQ(Row(rig, c.limit).enforced_by, EnforcedBy::kAlarm);
  const Alarm* alarm = FindAlarm(rig, c.alarm);
  ASSERT_NE(alarm, nullptr);
  EXPECT_EQ(alarm->level, AlarmLevel::kCaution);
  EXPECT_EQ(alarm->text, c.text);
}

INSTANTIATE_TEST_SUITE_P(
    , DescentAlarms,
    testing::Values(
        LimitCase{"wind", LimitId::kWind, [](MissionRig& r) { r.vehicle.wind_mps = 9; },
                  "Wind 9.0 m/s, limit 8.0 m/s. Watch the descent, hold or wave off."},
        LimitCase{"off_path", LimitId::kOffPath, [](MissionRig& r) { r.east_m += 1.5; },
                  "Off the path by 1.6 m, limit 1.2 m. Hold or wave off."},
        LimitCase{"off_centre", LimitId::kFromCentre,
                  [](MissionRig& r) {
                    r.vehicle.Set(VehicleMode::kSink);
                    r.east_m += 0.5;
                  },
                  "Sinks 0.71 m off the site's centre, limit 0.50 m. Watch it: beyond 0.75 m and "
                  "lower than 1 m it is waved off."},
        LimitCase{"descent_rate", LimitId::kDescentRate,
                  [](MissionRig& r) { r.navigation.gps.estimate.v_WB.z() = 1.6; },
                  "Sinks at 1.60 m/s, limit 1.50 m/s. Hold or wave off."},
        LimitCase{"vision_residual", LimitId::kResidual,
                  [](MissionRig& r) {
                    r.navigation.vision.residual_sigma = 2.6;
                    r.navigation.vision.max_residual_sigma = 2.15;
                  },
                  "Vision is 2.60 σ off the estimate, limit 2.15 σ: measurement refused. Watch the "
                  "estimate."}),
    [](const auto& row) { return row.param.alarm; });

// What is half as much again over its limit is no caution any more.
TEST(DescentWarnings, BeginAtHalfAsMuchAgain) {
  for (const auto& [wind_mps, level] :
       {std::pair(11.9, AlarmLevel::kCaution), std::pair(12.1, AlarmLevel::kWarning)}) {
    MissionRig rig;
    Descend(rig);
    rig.vehicle.wind_mps = wind_mps;
    rig.Run(0.6);
    ASSERT_NE(FindAlarm(rig, "wind"), nullptr);
    EXPECT_EQ(FindAlarm(rig, "wind")->level, level) << wind_mps;
  }
  MissionRig hover;
  ASSERT_TRUE(hover.RunUntil(MissionState::kProposed));
  hover.vehicle.wind_mps = 14;
  hover.Run(0.6);
  ASSERT_NE(FindAlarm(hover, "wind"), nullptr);
  EXPECT_EQ(FindAlarm(hover, "wind")->level, AlarmLevel::kCaution) << "nothing is flown in it yet";
}

// What steers may follow something that moves: a person is told, while there is ground enough in
// the pictures for more to agree.
TEST(TrackersApart, AreToldBeforeAndInADescentUntilTheCommitHeight) {
  MissionRig rig;
  rig.Arm();
  rig.why_not_trusted = "2 trackers agree, min 3";
  rig.Run(0.6);
  ASSERT_NE(FindAlarm(rig, "trackers_apart"), nullptr);
  EXPECT_EQ(
      FindAlarm(rig, "trackers_apart")->text,
      "Trackers are not trusted: 2 trackers agree, min 3. What holds the site may drift: watch "
      "it before you approve.");
  ASSERT_TRUE(rig.ApproveNow().ok()) << "a caution blocks nothing";
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.Step();
  EXPECT_TRUE(FindAlarm(rig, "trackers_apart")->text.ends_with("watch it, hold or wave off."));
  while (rig.vehicle.height_m > 2.2) {
    rig.Run(0.1);
  }
  EXPECT_FALSE(FindAlarm(rig, "trackers_apart")->active);
}

/// In a descent, with the skids so high above the site.
void SinkTo(MissionRig& rig, double height_m) {
  Descend(rig);
  while (rig.vehicle.height_m > height_m) {
    rig.Run(0.1);
  }
  ASSERT_EQ(rig.state(), MissionState::kDescending) << rig.mission.status().why;
}

// Nobody judged the ground there: no vehicle is put down on it. A gust is no such place.
TEST(BesideTheSite, AVehicleThatIsNearlyDownGoesAround) {
  MissionRig rig;
  SinkTo(rig, 0.9);
  EXPECT_EQ(Row(rig, LimitId::kBeside).enforced_by, EnforcedBy::kHold);
  rig.east_m += 0.7;  // 0.86 m off
  rig.Run(0.2);
  ASSERT_EQ(rig.state(), MissionState::kDescending) << "for a moment only";
  EXPECT_TRUE(Row(rig, LimitId::kBeside).over);
  rig.Run(0.4);
  EXPECT_EQ(rig.state(), MissionState::kAborting);
  EXPECT_EQ(rig.mission.status().why,
            "0.86 m beside site A, limit 0.75 m: nobody judged the ground there");
  EXPECT_GE(rig.SentCount<AbortRequest>(), 1);
}

TEST(BesideTheSite, AGustEndsNothingNorDoesAnythingHigherUp) {
  MissionRig gust;
  SinkTo(gust, 0.9);
  gust.east_m += 0.7;
  gust.Run(0.2);
  gust.east_m -= 0.7;
  EXPECT_TRUE(gust.RunUntil(MissionState::kLanded)) << gust.mission.status().why;
  MissionRig higher;
  SinkTo(higher, 1.7);
  higher.east_m += 0.7;
  higher.Run(0.4);
  EXPECT_EQ(higher.state(), MissionState::kDescending) << higher.mission.status().why;
  EXPECT_TRUE(std::isnan(Row(higher, LimitId::kBeside).value));
}

TEST(DescentLimits, NothingIsOverOutsideOfItsTime) {
  DescentFigures f;
  f.off_path_m = f.from_centre_m = f.descent_rate_mps = f.off_wind_rad = 99;
  f.approved_rate_mps = 1;
  f.nav_error_m = 0.5;
  for (const MissionState state : {MissionState::kSearch, MissionState::kArmed, MissionState::kHold,
                                   MissionState::kAborting, MissionState::kLanded}) {
    f.state = state;
    for (const LimitRow& row : LimitsOfDescent(f)) {
      EXPECT_FALSE(row.over) << row.label << " in " << MissionStateName(state);
    }
  }
}

// A wave-off ends no wind: its alarm is not over while it blows, and asks for nothing of a descent.
TEST(WindAlarm, StandsWhileAWaveOffIsFlown) {
  MissionRig rig;
  Descend(rig);
  rig.vehicle.wind_mps = 14;
  rig.Run(0.6);
  ASSERT_NE(FindAlarm(rig, "wind"), nullptr);
  EXPECT_EQ(FindAlarm(rig, "wind")->level, AlarmLevel::kWarning);
  ASSERT_TRUE(rig.Do(WaveOff{}));
  rig.Run(1);
  ASSERT_EQ(rig.state(), MissionState::kAborting);
  const Alarm* alarm = FindAlarm(rig, "wind");
  ASSERT_NE(alarm, nullptr);
  EXPECT_TRUE(alarm->active);
  EXPECT_EQ(alarm->text, "Wind 14.0 m/s, limit 8.0 m/s. No site is approved in it: wait for less.");
}

// Who acts on the tracker and the wind follows the mission: nothing is blocked on the ground. A
// wind over its limit is told also while a wave-off is flown.
TEST(DescentLimits, CoherenceAndWindAreGuardedThenWatchedThenTold) {
  DescentFigures f;
  f.tracked = true;
  f.coherence = f.wind_mps = 1;
  const std::pair<MissionState, EnforcedBy> rows[] = {
      {MissionState::kSearch, EnforcedBy::kGuard},
      {MissionState::kArmed, EnforcedBy::kGuard},
      {MissionState::kApproved, EnforcedBy::kAlarm},
      {MissionState::kDescending, EnforcedBy::kAlarm},
      {MissionState::kHold, EnforcedBy::kAlarm},
      {MissionState::kAborting, EnforcedBy::kNobody},
      {MissionState::kLanded, EnforcedBy::kNobody}};
  for (const auto& [state, by] : rows) {
    f.state = state;
    const std::vector<LimitRow> limits = LimitsOfDescent(f);
    EXPECT_EQ(FindLimit(limits, LimitId::kCoherence)->enforced_by, by) << MissionStateName(state);
    EXPECT_EQ(FindLimit(limits, LimitId::kWind)->enforced_by,
              state == MissionState::kAborting ? EnforcedBy::kAlarm : by)
        << MissionStateName(state);
  }
}

TEST(DescentLimits, ThePlaceIsAskedAgainstPathOrCentre) {
  const struct {
    VehicleMode mode;
    LimitId id;
  } rows[] = {{VehicleMode::kDescend, LimitId::kOffPath},
              {VehicleMode::kSettle, LimitId::kOffPath},
              {VehicleMode::kSink, LimitId::kFromCentre},
              {VehicleMode::kLanded, LimitId::kFromCentre}};
  for (const auto& row : rows) {
    DescentFigures f;
    f.state = MissionState::kDescending;
    f.mode = row.mode;
    const auto limits = LimitsOfDescent(f);
    EXPECT_NE(FindLimit(limits, row.id), nullptr);
    EXPECT_EQ(
        FindLimit(limits, row.id == LimitId::kOffPath ? LimitId::kFromCentre : LimitId::kOffPath),
        nullptr);
  }
}

TEST(CameraLimits, AreTheOnesThatRaiseTheirAlarms) {
  const auto over = [](const StereoQuality& stereo, const RangeAgreement& range, LimitId id) {
    const PictureFaults standing{.rows_apart = stereo.row_error_px > AlarmLimits::row_error_px};
    return FindLimit(LimitsOfCameras(stereo, range, standing, MissionState::kArmed), id)->over;
  };
  StereoQuality good, rows, dark, bright;
  rows.row_error_px = 0.51;
  dark.exposure_ratio = 0.49;
  bright.exposure_ratio = 2.01;
  EXPECT_FALSE(over(good, {}, LimitId::kRowError));
  EXPECT_TRUE(over(rows, {}, LimitId::kRowError));
  EXPECT_FALSE(over(good, {}, LimitId::kExposure));
  EXPECT_TRUE(over(dark, {}, LimitId::kExposure));
  EXPECT_TRUE(over(bright, {}, LimitId::kExposure));
  EXPECT_TRUE(over(good, {1.03, 0.002, 40}, LimitId::kRangeScale));
  EXPECT_TRUE(over(good, {0.97, 0.002, 40}, LimitId::kRangeScale));
  EXPECT_FALSE(over(good, {1.03, 0.02, 40}, LimitId::kRangeScale));  // by chance
  EXPECT_FALSE(over(good, {}, LimitId::kRangeScale));                // not known

  // One pair alone is chance; once approved no guard asks any more, the alarm does.
  const LimitRow once =
      *FindLimit(LimitsOfCameras(rows, {}, {}, MissionState::kArmed), LimitId::kRowError);
  EXPECT_FALSE(once.over);
  EXPECT_EQ(once.enforced_by, EnforcedBy::kGuard);
  const LimitRow flying =
      *FindLimit(LimitsOfCameras(rows, {}, {.rows_apart = true}, MissionState::kDescending),
                 LimitId::kRowError);
  EXPECT_TRUE(flying.over);
  EXPECT_EQ(flying.enforced_by, EnforcedBy::kAlarm);
}

// What held the descent stands in the list, with value, limit and how long it must last.
TEST(DescentLimits, TheFigureThatHeldTheDescentHasItsRow) {
  MissionRig rig;
  Descend(rig);
  EXPECT_EQ(Row(rig, LimitId::kProbability).enforced_by, EnforcedBy::kHold);
  EXPECT_EQ(Row(rig, LimitId::kProbability).lasts, "0.4 s, or 3 of 5 maps");
  for (const LimitId id : {LimitId::kLeftCameraAge, LimitId::kPoseAge, LimitId::kGroundAge}) {
    EXPECT_EQ(Row(rig, id).enforced_by, EnforcedBy::kHold);
    EXPECT_FALSE(Row(rig, id).over);
  }
  rig.Site(101)->safe_probability = 0.308;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 1));
  EXPECT_NE(rig.mission.status().why.find("Safe as seen 0.308"), std::string::npos)
      << rig.mission.status().why;
  EXPECT_EQ(Row(rig, LimitId::kProbability).value, 0.308);
  EXPECT_TRUE(Row(rig, LimitId::kProbability).over);
}

TEST(DescentLimits, ABlockedApproachHoldsAndHasItsRow) {
  MissionRig rig;
  Descend(rig);
  EXPECT_EQ(Row(rig, LimitId::kApproach).enforced_by, EnforcedBy::kHold);
  EXPECT_FALSE(Row(rig, LimitId::kApproach).over);
  rig.Site(101)->corridor_clear = false;
  ASSERT_TRUE(rig.RunUntil(MissionState::kHold, 1));
  EXPECT_EQ(rig.mission.status().why, "Something stands in the approach");
  EXPECT_TRUE(Row(rig, LimitId::kApproach).over);
}

// Landed, or flying away: nothing of the site or of its tracker is watched, and nothing says so.
TEST(DescentLimits, OnTheGroundNoRowOfTheSiteClaimsAnEnforcer) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok());
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending));
  EXPECT_EQ(FindLimit(rig.mission.status().limits, LimitId::kSlope)->enforced_by,
            EnforcedBy::kHold);
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded));
  rig.Step();
  for (const LimitId id : {LimitId::kSlope, LimitId::kRoughness, LimitId::kClearRadius,
                           LimitId::kResidual, LimitId::kCoherence, LimitId::kWind}) {
    const LimitRow* row = FindLimit(rig.mission.status().limits, id);
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(row->enforced_by, EnforcedBy::kNobody) << row->label;
  }
}

TEST(DescentLimits, OnTheGroundTheFiguresAreTheLastOfTheDescent) {
  MissionRig rig;
  Descend(rig);
  double wind_mps = NAN, slope = NAN;
  while (rig.state() != MissionState::kLanded) {
    wind_mps = Row(rig, LimitId::kWind).value;
    slope = Row(rig, LimitId::kSlope).value;
    rig.Step();
  }
  ASSERT_TRUE(std::isfinite(wind_mps) && std::isfinite(slope));
  rig.vehicle.wind_mps += 14;
  rig.Run(1);
  EXPECT_EQ(Row(rig, LimitId::kWind).value, wind_mps);
  EXPECT_FALSE(Row(rig, LimitId::kWind).over);
  EXPECT_EQ(Row(rig, LimitId::kSlope).value, slope);
}

TEST(PlaceLimit, OnTheGroundIsThatOfTheTouchdownWhateverTheEstimateDoes) {
  MissionRig rig;
  Descend(rig);
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 60));
  rig.Step();
  ASSERT_TRUE(rig.mission.status().touchdown_miss_m.has_value());
  const double miss_m = *rig.mission.status().touchdown_miss_m;
  EXPECT_EQ(Row(rig, LimitId::kFromCentre).value, miss_m);
  EXPECT_TRUE(std::isnan(Row(rig, LimitId::kFromCentre).three_sigma));
  rig.link_up = false;  // the estimate drifts
  rig.Run(10);
  EXPECT_EQ(Row(rig, LimitId::kFromCentre).value, miss_m);
}

}  // namespace
}  // namespace palace
