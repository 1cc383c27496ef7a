// What the station says of a wave-off is what the vehicle said after it, never what it said before.
#include "engine/mission/wording.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

using Phase = WaveOffReport::Phase;

/// A descent under way.
struct WaveOffRig : MissionRig {
  WaveOffRig() {
    Arm();
    EXPECT_TRUE(ApproveNow().ok());
    EXPECT_TRUE(RunUntil(MissionState::kDescending, 10));
    Run(1);
  }
  const WaveOffReport& report() const { return mission.status().wave_off; }
  std::string AlarmText() const {
    for (const Alarm& alarm : mission.status().alarms) {
      if (alarm.kind == AlarmId::kWaveOff) {
        return alarm.text;
      }
    }
    return {};
  }
};

TEST(WaveOffTold, GoesFromSentOverClimbingToHovering) {
  WaveOffRig rig;
  EXPECT_EQ(rig.report().phase, Phase::kNone);
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  EXPECT_EQ(rig.report().phase, Phase::kSent);
  EXPECT_FALSE(rig.report().over);
  rig.Run(0.3);
  EXPECT_EQ(rig.report().phase, Phase::kClimbs);
  EXPECT_LE(rig.report().age_s, 0.1);
  rig.Run(4);
  EXPECT_EQ(rig.report().phase, Phase::kDone);
  EXPECT_TRUE(rig.report().over);
  EXPECT_NE(rig.AlarmText().find("Vehicle hovers."), std::string::npos) << rig.AlarmText();
}

// One that need not climb hovers again sooner than its hover is believed: nothing goes back.
TEST(WaveOffTold, NeverGoesBackToAcceptedOnceItIsUnderWay) {
  MissionRig hovering;
  hovering.vehicle.climb_mps = 0;
  hovering.Arm();
  ASSERT_TRUE(hovering.Do(WaveOff{}).ok());
  hovering.Run(0.5);
  const WaveOffReport& report = hovering.mission.status().wave_off;
  ASSERT_EQ(report.phase, Phase::kFlies);
  hovering.vehicle.Set(VehicleMode::kHover);
  for (int step = 0; step < 10; ++step) {
    hovering.Step();
    EXPECT_EQ(report.phase, Phase::kFlies) << step;
  }
  hovering.Run(2);
  EXPECT_EQ(report.phase, Phase::kDone);
}

// It is as high as it goes: what it flies is no climb.
TEST(WaveOffTold, OfAVehicleThatDoesNotRiseNoClimbIsTold) {
  MissionRig hovering;
  hovering.vehicle.climb_mps = 0.1;
  hovering.Arm();
  ASSERT_TRUE(hovering.Do(WaveOff{}).ok());
  hovering.Run(0.5);
  const WaveOffReport& report = hovering.mission.status().wave_off;
  EXPECT_EQ(report.phase, Phase::kFlies);
  EXPECT_EQ(words::WaveOffTold(report),
            ". Vehicle waves off. When it hovers, confirm \"Wave-off complete\".");
  hovering.vehicle.climb_mps = 0.4;
  hovering.Run(0.5);
  EXPECT_EQ(report.phase, Phase::kClimbs);
  hovering.Run(4);
  EXPECT_EQ(report.phase, Phase::kDone);
}

TEST(WaveOffTold, AVehicleThatIsNotHeardConfirmsNothingWhateverItSaidBefore) {
  // Its last word was that it hovers: that was before the wave-off.
  MissionRig hovering;
  hovering.Arm();
  hovering.link_up = false;
  hovering.Run(0.5);
  ASSERT_TRUE(hovering.Do(WaveOff{}).ok());
  ASSERT_TRUE(hovering.Do(AcknowledgeWaveOff{}).ok());
  hovering.Run(37);
  const WaveOffReport& report = hovering.mission.status().wave_off;
  EXPECT_EQ(report.phase, Phase::kUnanswered);
  EXPECT_NEAR(report.age_s, 37, 0.2);
  EXPECT_FALSE(report.over);
  EXPECT_EQ(hovering.state(), MissionState::kAborting);
}

TEST(WaveOffTold, AVehicleThatFallsSilentOnTheClimbIsQuotedWithTheAgeOfItsWord) {
  WaveOffRig rig;
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  rig.Run(0.5);
  rig.link_up = false;
  rig.Run(6);
  EXPECT_EQ(rig.report().phase, Phase::kClimbs);
  EXPECT_NEAR(rig.report().age_s, 6, 0.2);
  EXPECT_NE(rig.AlarmText().find("when it was heard last, 6.0 s ago"), std::string::npos)
      << rig.AlarmText();
}

// Answers can be forged; what the vehicle does shows in its status.
TEST(WaveOffTold, AnAnswerAloneDoesNotEndTheRepeats) {
  WaveOffRig rig;
  rig.vehicle.hears_aborts = false;
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  rig.Run(1);
  EXPECT_EQ(rig.report().phase, Phase::kAccepted);
  const int sent = rig.SentCount<AbortRequest>();
  rig.Run(2);
  EXPECT_GE(rig.SentCount<AbortRequest>(), sent + 2);
  rig.vehicle.hears_aborts = true;
  rig.Run(2);
  EXPECT_EQ(rig.report().phase, Phase::kClimbs);
  const int heard = rig.SentCount<AbortRequest>();
  rig.Run(6);
  EXPECT_EQ(rig.SentCount<AbortRequest>(), heard);
  EXPECT_EQ(rig.report().phase, Phase::kDone);
}

TEST(WaveOffTold, AHoverHeardLongAgoEndsNothing) {
  WaveOffRig rig;
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  rig.Run(5);
  ASSERT_TRUE(rig.report().over);
  rig.link_up = false;
  rig.Run(37);
  EXPECT_EQ(rig.report().phase, Phase::kDone);
  EXPECT_NEAR(rig.report().age_s, 37, 0.2);
  EXPECT_FALSE(rig.report().over);
  ASSERT_TRUE(rig.Do(AcknowledgeWaveOff{}).ok());
  rig.Run(0.2);
  EXPECT_EQ(rig.state(), MissionState::kAborting);
  rig.link_up = true;
  rig.Run(0.5);
  EXPECT_NE(rig.state(), MissionState::kAborting);
}

TEST(WaveOffTold, APressAgainWaitsForAWordOfItsOwn) {
  WaveOffRig rig;
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  rig.Run(5);
  ASSERT_EQ(rig.report().phase, Phase::kDone);
  rig.link_up = false;
  rig.Run(1);
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  EXPECT_EQ(rig.report().phase, Phase::kSent);
  rig.Run(2);
  EXPECT_EQ(rig.report().phase, Phase::kUnanswered);
}

TEST(WaveOffTold, OnTheGroundItIsNotOfferedAndTheLandingStands) {
  WaveOffRig rig;
  EXPECT_EQ(rig.mission.status().why_no_wave_off, "");
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded));
  rig.Step();
  EXPECT_EQ(rig.mission.status().why_no_wave_off, "Vehicle on the ground");
  rig.mission.TakeMessages();
  EXPECT_FALSE(rig.Do(WaveOff{}).ok());
  EXPECT_EQ(rig.state(), MissionState::kLanded);
  EXPECT_TRUE(rig.mission.TakeMessages().empty());
}

TEST(WaveOffTold, AVehicleLastHeardOnTheGroundLongAgoMayBeWavedOff) {
  WaveOffRig rig;
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded));
  rig.link_up = false;
  rig.Run(2);
  EXPECT_EQ(rig.mission.status().why_no_wave_off, "");
  EXPECT_TRUE(rig.Do(WaveOff{}).ok());
}

// The frame of the vehicle that started anew is another: the old site lies nowhere in it.
TEST(WaveOffTold, AfterARestartOfTheVehicleNoOldSiteIsTold) {
  WaveOffRig rig;
  ASSERT_TRUE(rig.Do(WaveOff{}).ok());
  rig.Run(0.3);
  EXPECT_TRUE(rig.mission.status().armed.has_value());
  ++rig.vehicle.boot_id;
  rig.Run(0.3);
  EXPECT_EQ(rig.state(), MissionState::kAborting);
  EXPECT_FALSE(rig.mission.status().armed.has_value());
  EXPECT_TRUE(rig.mission.status().rechecks.empty());
}

TEST(SelectionEnded, IsToldUntilAnotherSiteIsSelected) {
  MissionRig rig;
  rig.Arm();
  EXPECT_EQ(rig.mission.status().selection_ended, "");
  rig.Run(rig.settings.mission.arm_window_s + 1);
  EXPECT_EQ(rig.state(), MissionState::kProposed);
  EXPECT_EQ(rig.mission.status().selection_ended,
            "Selection of site A ended: Arm window is over, select the site again.");
  ASSERT_TRUE(rig.Do(SelectSite{102}).ok());
  EXPECT_EQ(rig.mission.status().selection_ended, "");
}

}  // namespace
}  // namespace palace
