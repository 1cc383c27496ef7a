// The tables of guards and alarms: a text names the limit that raises it, and nothing else does.
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "engine/mission/alarms/alarms.h"
#include "tests/mission/measured_facts.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

/// The text of this alarm under these facts; empty when it is not raised.
std::string TextOf(const AlarmRow& row, const AlarmFacts& facts) {
  for (const AlarmCondition& condition : EvaluateAlarms(facts)) {
    if (condition.id == row.id && condition.present) {
      return condition.text;
    }
  }
  return {};
}

TEST(AlarmTable, HasEachAlarmOnceInOrder) {
  ASSERT_EQ(AlarmTable().size(), kAlarmCount);
  std::set<std::string> names;
  for (std::size_t i = 0; i < kAlarmCount; ++i) {
    const AlarmRow& row = AlarmTable()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.id), i);
    const std::string name = AlarmName(row.id);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(AlarmFromName(name), row.id);
    EXPECT_TRUE(row.present != nullptr && row.text != nullptr) << name;
    EXPECT_EQ(row.value != nullptr, std::isfinite(LimitOf(row, AllMeasured()).value)) << name;
  }
  EXPECT_FALSE(AlarmFromName("none").has_value());
}

TEST(AlarmTable, TheRecordSaysWhyItStoppedOrWhatItLeavesOutAndForHowLong) {
  const auto text = [](AlarmId id, const AlarmFacts& facts) {
    return TextOf(AlarmTable()[static_cast<std::size_t>(id)], facts);
  };
  AlarmFacts full = AllMeasured();
  full.recorder_ok = false;
  full.record.problem = "the disk is full";
  EXPECT_EQ(text(AlarmId::kRecorder, full),
            "Recording is not running: the disk is full. Acknowledge to fly without a record.");
  AlarmFacts thinned = AllMeasured();
  thinned.record.pictures_every = 4;
  thinned.record.minutes_left = 3.2;
  EXPECT_EQ(text(AlarmId::kRecordThinned, thinned),
            "The disk is nearly full: every 4th pair of pictures is recorded, 3 min are left. "
            "Free space.");
  AlarmFacts stopped = AllMeasured();
  stopped.engine_stop = "Engine stopped: bad_alloc. Started again, 1 of 3 times.";
  EXPECT_NE(text(AlarmId::kEngineStopped, stopped).find("Nothing is selected"), std::string::npos);
}

TEST(AlarmTable, InARecordNoSensorBlocksAnApproval) {
  for (const bool live : {true, false}) {
    AlarmFacts f = AllMeasured();
    f.state = MissionState::kSearch;
    f.on_vision = false;
    f.has_vehicle = live;
    f.gps_agreement.off = true;
    int told = 0;
    for (const LaserHealth::State state :
         {LaserHealth::State::kLost, LaserHealth::State::kStuck, LaserHealth::State::kWrong}) {
      f.laser.state = state;
      for (const AlarmCondition& condition : EvaluateAlarms(f)) {
        if (condition.present) {
          ++told;
          EXPECT_EQ(condition.text.find("Approve is blocked") != std::string::npos, live)
              << condition.text;
        }
      }
    }
    EXPECT_GE(told, 6);
  }
}

TEST(AlarmTable, NothingIsRaisedWhenAllIsWell) {
  for (const AlarmCondition& condition : EvaluateAlarms(AllMeasured())) {
    EXPECT_FALSE(condition.present) << AlarmName(condition.id) << ": " << condition.text;
  }
}

// A thousandth inside the limit nothing is raised; a thousandth beyond it the alarm is, and its
// text names that limit and no other number for it.
TEST(AlarmTable, EachTextNamesTheLimitThatRaisesIt) {
  int checked = 0;
  for (const AlarmRow& row : AlarmTable()) {
    if (row.value == nullptr) {
      continue;
    }
    SCOPED_TRACE(AlarmName(row.id));
    const Limit limit = LimitOf(row, AllMeasured());
    AlarmFacts below = AllMeasured(), above = AllMeasured();
    below.*row.value = 0.999 * limit.value;
    above.*row.value = 1.001 * limit.value;
    const std::string text = TextOf(row, below) + TextOf(row, above);
    EXPECT_NE(TextOf(row, below).empty(), TextOf(row, above).empty());
    EXPECT_EQ(TextOf(row, above).empty(), row.less_is_worse);
    const std::string named = LimitWords(limit);
    EXPECT_NE(text.find(named), std::string::npos) << text << " / " << named;
    EXPECT_NEAR(std::stod(named), limit.value, 1e-9) << "rounded until it is another limit";
    std::smatch match;
    ASSERT_TRUE(
        std::regex_search(text, match, std::regex("limit (?:[0-9.]+ to )?([0-9]+(?:[.][0-9]+)?)")))
        << text;
    EXPECT_NEAR(std::stod(match[1].str()), limit.value, 1e-9) << text;
    ++checked;
  }
  EXPECT_GE(checked, 11);
}

TEST(AlarmTable, WithoutALimitNoTextNamesOne) {
  AlarmFacts facts = AllMeasured();
  facts.source_damage = facts.why = facts.site_reason = facts.refusal = "why";
  for (const AlarmRow& row : AlarmTable()) {
    const std::string text = row.text(facts, "17 parsec");
    EXPECT_EQ(text.find("17 parsec") != std::string::npos, row.value != nullptr)
        << AlarmName(row.id) << ": " << text;
  }
}

TEST(AlarmTable, ACautionOfTheLinkGrowsIntoAWarning) {
  AlarmFacts facts = AllMeasured();
  for (const auto& [age_s, level] :
       {std::pair{4.9, AlarmLevel::kCaution}, std::pair{5.1, AlarmLevel::kWarning}}) {
    facts.link_age_s = age_s;
    const auto conditions = EvaluateAlarms(facts);
    EXPECT_EQ(conditions[static_cast<std::size_t>(AlarmId::kLink)].level, level) << age_s;
  }
}

TEST(GuardTable, HasEachGuardOnceInOrder) {
  ASSERT_EQ(GuardTable().size(), kGuardCount);
  for (std::size_t i = 0; i < kGuardCount; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(GuardTable()[i].id), i);
    EXPECT_EQ(GuardName(GuardTable()[i].id), "G" + std::to_string(i + 1));
  }
}

// Evidence passes, silence does not (I3). Many vehicles measure no wind: there silence is no
// evidence of much wind.
TEST(GuardTable, NothingKnownPassesNothingThatNeedsEvidence) {
  const std::set<GuardId> silent = {GuardId::kWarnings, GuardId::kSource, GuardId::kWind};
  for (const GuardResult& result : EvaluateGuards(GuardInputs{})) {
    EXPECT_EQ(result.pass, silent.count(result.id) == 1) << GuardName(result.id);
    EXPECT_EQ(result.pass, result.reason.empty());
  }
}

struct Late {
  GuardId id;
  double GuardInputs::*value;
  bool more_is_better;
};

// The guards that hold a figure against a limit turn at that very limit.
TEST(GuardTable, AgesTurnAtTheLimitOfTheRow) {
  GuardInputs fine;
  fine.link_age_s = fine.pose_age_s = fine.map_age_s = 0;
  fine.left_camera_age_s = fine.right_camera_age_s = fine.pair_age_s = 0;
  fine.position_healthy = fine.tracker_locked = true;
  fine.laser.state = LaserHealth::State::kFine;
  fine.coherence = 1;
  fine.min_coherence = 0.7;
  fine.shown_for_s = fine.armed_for_s = 10;
  fine.arm_window_s = 60;
  fine.max_wind_mps = 8;
  fine.site_letter = 'A';
  for (const Late& late : {Late{GuardId::kLink, &GuardInputs::link_age_s, false},
                           Late{GuardId::kAttitude, &GuardInputs::pose_age_s, false},
                           Late{GuardId::kCameras, &GuardInputs::left_camera_age_s, false},
                           Late{GuardId::kCameras, &GuardInputs::right_camera_age_s, false},
                           Late{GuardId::kMap, &GuardInputs::map_age_s, false},
                           Late{GuardId::kPosition, &GuardInputs::coherence, true},
                           Late{GuardId::kShown, &GuardInputs::shown_for_s, true},
                           Late{GuardId::kInTime, &GuardInputs::armed_for_s, true},
                           Late{GuardId::kWind, &GuardInputs::wind_mps, false}}) {
    SCOPED_TRACE(GuardName(late.id));
    const Limit limit = LimitOf(GuardTable()[static_cast<std::size_t>(late.id)], fine);
    for (const double factor : {0.999, 1.001}) {
      GuardInputs in = fine;
      in.*late.value = factor * limit.value;
      const auto results = EvaluateGuards(in);
      const GuardResult* result = FindGuard(results, late.id);
      EXPECT_EQ(result->pass, (factor > 1) == late.more_is_better) << factor;
      EXPECT_TRUE(result->pass || !late.more_is_better ||
                  result->reason.find("min " + LimitWords(limit)) != std::string::npos)
          << result->reason;
    }
  }
}

bool Stands(const MissionRig& rig, AlarmId id) {
  const auto& alarms = rig.mission.status().alarms;
  return std::any_of(alarms.begin(), alarms.end(),
                     [&](const Alarm& alarm) { return alarm.kind == id && alarm.active; });
}

// A list that waits for its maps is no ground without a site.
TEST(AlarmTable, ThereIsNoSiteOnlyOnceAListIsDue) {
  MissionRig rig;
  rig.sites.clear();
  rig.decision.selection.waits = true;
  rig.Run(2);
  EXPECT_FALSE(Stands(rig, AlarmId::kNoSite));
  rig.decision.selection.waits = false;
  rig.Run(2);
  EXPECT_TRUE(Stands(rig, AlarmId::kNoSite));
}

// What blocks approval is told: the pose at the 0.2 s of G2, not only at 0.5 s.
TEST(AlarmTable, AStalePoseIsToldAtTheLimitThatBlocks) {
  MissionRig rig;
  rig.Arm();
  rig.pose_up = false;
  rig.Run(0.5);  // three samples beyond 0.2 s
  EXPECT_FALSE(FindGuard(rig.mission.status().guards, GuardId::kAttitude)->pass);
  ASSERT_TRUE(Stands(rig, AlarmId::kPose));
  EXPECT_EQ(rig.mission.status().alarms[0].text,
            "Vehicle pose stale, 0.5 s, limit 0.2 s. Approve is blocked, the selection ends after "
            "1 s.");
}

// What an old pose does depends on where the mission is: each sentence is what the states do.
TEST(AlarmTable, AStalePoseSaysWhatItDoesInEachState) {
  struct Row {
    MissionState state;
    bool committed, on_vision;
    AlarmId id;
    const char* end;
  };
  const AlarmId pose = AlarmId::kPose, right = AlarmId::kCameraRight;
  for (const Row& row : {
           Row{MissionState::kProposed, false, false, pose, "Approve is blocked."},
           Row{MissionState::kArmed, false, false, pose,
               "Approve is blocked, the selection ends after 1 s."},
           Row{MissionState::kApproved, false, false, pose, "Approval ends after 1 s."},
           Row{MissionState::kDescending, false, true, pose, "Descent holds after 1 s."},
           Row{MissionState::kDescending, true, true, pose,
               "Without vision the vehicle stops, and climbs after 2.0 s."},
           Row{MissionState::kDescending, true, true, right,
               "Without vision the vehicle stops, and climbs after 2.0 s."},
           Row{MissionState::kDescending, true, false, pose, "So low the descent goes on."},
       }) {
    AlarmFacts facts = AllMeasured();
    facts.pose_age_s = facts.right_camera_age_s = 0.6;
    facts.state = row.state;
    facts.committed = row.committed;
    facts.on_vision = row.on_vision;
    EXPECT_THAT(TextOf(AlarmTable()[static_cast<std::size_t>(row.id)], facts),
                testing::EndsWith(row.end));
  }
}

// What a text announces is what its row does: above the commit height a row that says "holds" has a
// stop, that stop comes to speak, and the mission holds with its words.
TEST(AlarmTable, WhoeverSaysTheDescentHoldsHoldsIt) {
  struct Worst {
    AlarmId id;
    void (*make)(AlarmFacts&);
  };
  const Worst kWorst[] = {
      {AlarmId::kCameraLeft, [](AlarmFacts& f) { f.left_camera_age_s = 1.1; }},
      {AlarmId::kCameraRight, [](AlarmFacts& f) { f.right_camera_age_s = 1.1; }},
      {AlarmId::kPose, [](AlarmFacts& f) { f.pose_age_s = 1.1; }},
      {AlarmId::kLink, [](AlarmFacts& f) { f.link_age_s = 5.1; }},
      {AlarmId::kClock, [](AlarmFacts& f) { f.clock_stepped = true, f.clock_step_s = 5; }},
      {AlarmId::kReboot, [](AlarmFacts& f) { f.rebooted = true; }},
      {AlarmId::kCameraFrozen, [](AlarmFacts& f) { f.pictures.left_frozen = true; }},
      {AlarmId::kCamerasSwapped, [](AlarmFacts& f) { f.pictures.swapped = true; }},
      {AlarmId::kCameraBlank, [](AlarmFacts& f) { f.pictures.right_blank = true; }},
      {AlarmId::kAttitudeInvalid, [](AlarmFacts& f) { f.attitude_invalid_s = 0.6; }},
      {AlarmId::kPairing, [](AlarmFacts& f) { f.pair_age_s = 1.1; }},
      {AlarmId::kOldGround, [](AlarmFacts& f) { f.ground_age_s = 2.1; }},
      {AlarmId::kImageTime,
       [](AlarmFacts& f) {
         f.image_time = "Image time off by 300 ms";
         f.image_time_ms = 300;
       }},
      {AlarmId::kGravity, [](AlarmFacts& f) {
         f.gravity = {true, 3};
       }}};
  EXPECT_EQ(WhyStopped(AllMeasured()), "");
  std::set<AlarmId> stops;
  for (const Worst& worst : kWorst) {
    SCOPED_TRACE(AlarmName(worst.id));
    AlarmFacts facts = AllMeasured();
    worst.make(facts);
    const AlarmRow& row = AlarmTable()[static_cast<std::size_t>(worst.id)];
    EXPECT_NE(TextOf(row, facts), "");
    ASSERT_NE(row.stop, nullptr);
    EXPECT_NE(row.stop(facts), "");
    EXPECT_EQ(WhyStopped(facts), row.stop(facts));
    stops.insert(worst.id);
  }
  // Whatever else may be: no text speaks of a hold of ours without a stop.
  AlarmFacts all = AllMeasured();
  for (const Worst& worst : kWorst) {
    worst.make(all);
  }
  all.pictures.left_frozen = all.pictures.right_blank = true;
  for (const AlarmRow& row : AlarmTable()) {
    if (row.id == AlarmId::kVisionLost) {
      continue;  // by how low it is the descent holds or climbs: a rule of the state
    }
    const bool says = row.text(all, "1").find("escent holds") != std::string::npos;
    EXPECT_EQ(row.stop != nullptr, stops.count(row.id) == 1) << AlarmName(row.id);
    EXPECT_TRUE(!says || row.stop != nullptr) << AlarmName(row.id) << ": " << row.text(all, "1");
  }
}

// Which camera, and of a silent vehicle the vehicle.
TEST(AlarmTable, NamesWhatIsMissing) {
  AlarmFacts facts = AllMeasured();
  facts.right_camera_age_s = 1.2;
  EXPECT_EQ(WhyStopped(facts), "Right camera stale, 1.2 s");
  facts.left_camera_age_s = facts.pose_age_s = 1.2;
  facts.link_age_s = 1.3;
  EXPECT_EQ(WhyStopped(facts), "Vehicle fell silent");
  EXPECT_THAT(TextOf(AlarmTable()[static_cast<std::size_t>(AlarmId::kLink)], facts),
              testing::StartsWith("Vehicle stale, 1.3 s, limit 1.0 s."));
}

TEST(AlarmTable, AStepOfTheClockIsNotTheForgersAndTellsItsSize) {
  AlarmFacts facts = AllMeasured();
  facts.losses.stamps_refused = 4;
  facts.losses.stamped_channels = "VEHICLE_POSE 4";
  const AlarmRow& refused = AlarmTable()[static_cast<std::size_t>(AlarmId::kStampsRefused)];
  EXPECT_NE(TextOf(refused, facts), "");
  facts.since_clock_step_s = 0.3;
  EXPECT_EQ(TextOf(refused, facts), "");
  facts.clock_stepped = true;
  facts.clock_step_s = -5;
  EXPECT_THAT(TextOf(AlarmTable()[static_cast<std::size_t>(AlarmId::kClock)], facts),
              testing::StartsWith("Vehicle clock stepped back 5.0 s."));
}

}  // namespace
}  // namespace palace
