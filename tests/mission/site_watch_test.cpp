// Sequences of maps against the verdict they make together.
#include "engine/mission/watch/site_watch.h"

#include <numbers>

#include "engine/core/random.h"
#include "engine/model/hazard_maps.h"
#include "tests/mission/mission_rig.h"

namespace palace {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

SiteFinding FindingOf(char letter) {
  switch (letter) {
    case 'g':
      return {Finding::kGood, "", true};
    case 'd':
      return {Finding::kDoubtful, "doubt", true};
    case 'o':
      return {Finding::kOver, "over", true};
    default:
      return {Finding::kGross, "gross", true};
  }
}

/// One letter a map: H holds, D degraded, L lost.
std::string VerdictsOf(const std::string& maps, double period_s) {
  SiteWatch watch;
  std::string verdicts;
  Timestamp now{1'000'000};
  for (const char letter : maps) {
    now = AddSeconds(now, period_s);
    watch.Add(FindingOf(letter), now);
    verdicts += "HDL"[static_cast<int>(watch.VerdictAt(now))];
  }
  return verdicts;
}

struct Sequence {
  const char* name;
  const char* maps;      // good, doubtful, over, Gross
  const char* verdicts;  // at 10 maps a second
};

class Verdicts : public testing::TestWithParam<Sequence> {};

TEST_P(Verdicts, FollowTheMaps) {
  EXPECT_EQ(VerdictsOf(GetParam().maps, 0.1), GetParam().verdicts);
}

INSTANTIATE_TEST_SUITE_P(
    , Verdicts,
    testing::Values(Sequence{"AllGood", "gggggg", "HHHHHH"},
                    Sequence{"OneNoisyMap", "gggogggg", "HHHHHHHH"},
                    Sequence{"TwoNoisyMapsApart", "ggoggoggg", "HHHHHHHHH"},
                    Sequence{"ThreeInARow", "ggooo", "HHHHL"},
                    Sequence{"ThreeOfFive", "gogogo", "HHHHHL"},
                    Sequence{"ThreeOfSixIsNotEnough", "ogogggo", "HHHHHHH"},
                    Sequence{"GrossAtOnce", "ggG", "HHL"}, Sequence{"GrossAsTheFirst", "G", "L"},
                    Sequence{"DoubtNeedsThree", "gddgd", "HHHHD"},
                    Sequence{"DoubtAndOverCountTogether", "ggdod", "HHHHD"},
                    Sequence{"DoubtIsNeverLost", "dddddddddd", "HHDDDDDDDD"},
                    Sequence{"RecoversAfterFiveGood", "dddggggggg", "HHDDDDDHHH"},
                    Sequence{"ADoubtRestartsRecovery", "dddggggdgggggg", "HHDDDDDDDDDDHH"},
                    Sequence{"LostRecoversAfterFiveGood", "oooggggggg", "HHLLLLLHHH"},
                    Sequence{"LostToDegraded", "ooodddddgggggg", "HHLLLLLDDDDDHH"},
                    Sequence{"LostStaysOnAFlicker", "oooggoggoggogg", "HHLLLLLLLLLLLL"}),
    [](const auto& row) { return row.param.name; });

// However slow the maps come, 0.4 s over a limit without a map that says otherwise loses the site.
TEST(SiteWatch, SlowMapsLoseASiteByTime) {
  SiteWatch watch;
  const Timestamp start{1'000'000};
  watch.Add(FindingOf('g'), start);
  watch.Add(FindingOf('o'), AddSeconds(start, 1));
  EXPECT_EQ(watch.VerdictAt(AddSeconds(start, 1.3)), SiteVerdict::kHolds);
  EXPECT_EQ(watch.VerdictAt(AddSeconds(start, 1.45)), SiteVerdict::kLost);
  watch.Add(FindingOf('g'), AddSeconds(start, 1.35));
  EXPECT_EQ(watch.VerdictAt(AddSeconds(start, 1.45)), SiteVerdict::kHolds);
}

// 200 random sequences: lost is only left after five maps without an over; nothing but three of
// five or one gross map makes it (maps 0.1 s apart, so that the rule of time adds nothing).
TEST(SiteWatch, EveryLossAndRecoveryHasItsCause) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed, "findings");
    std::string maps;
    for (int i = 0; i < 60; ++i) {
      maps += "gggggdddoooG"[static_cast<int>(random.Uniform(0, i % 20 < 10 ? 7.99 : 11.99))];
    }
    const std::string verdicts = VerdictsOf(maps, 0.05);
    for (std::size_t i = 1; i < maps.size(); ++i) {
      const std::string last = maps.substr(i < 4 ? 0 : i - 4, i < 4 ? i + 1 : 5);
      const auto over =
          std::count_if(last.begin(), last.end(), [](char m) { return m == 'o' || m == 'G'; });
      if (verdicts[i] == 'L' && verdicts[i - 1] != 'L') {
        ASSERT_TRUE(over >= 3 || maps[i] == 'G') << "seed " << seed << " map " << i;
      }
      if (verdicts[i] != 'L' && verdicts[i - 1] == 'L') {
        ASSERT_EQ(over, 0) << "seed " << seed << " map " << i;
      }
      if (maps[i] == 'G') {
        ASSERT_EQ(verdicts[i], 'L') << "seed " << seed << " map " << i;
      }
    }
  }
}

LandingSite GoodSite() {
  LandingSite site;
  site.slope_rad = {3 * kDeg, 1 * kDeg};
  site.roughness_m = {0.03, 0.02};
  site.step_m = {0.05, 0.03};
  site.safe_distance_m = 4.3;
  site.clear_radius_m = 2.3;
  site.clearance_m = 2.0;
  site.safe_probability = 0.999;
  return site;
}

std::optional<NearestHazard> Rock() {
  return NearestHazard{Cell{3, 4}, 3.2, std::numbers::pi, kHazardRoughness, 0};
}

struct Change {
  const char* name;
  std::function<void(LandingSite&)> change;
  Finding finding;
  const char* reason;
};

class Findings : public testing::TestWithParam<Change> {};

TEST_P(Findings, AreNamedWithValueAndLimit) {
  LandingSite site = GoodSite();
  GetParam().change(site);
  const SiteFinding found = JudgeRecheck(site, Rock(), {true, 2.0}, SladSettings{});
  EXPECT_EQ(found.finding, GetParam().finding);
  EXPECT_EQ(found.reason, GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(
    , Findings,
    testing::Values(
        Change{"Good", [](LandingSite&) {}, Finding::kGood, ""},
        Change{"Steep", [](LandingSite& s) { s.slope_rad.value = 12 * kDeg; }, Finding::kOver,
               "Slope 12.0° ± 1.0°, max 10°"},
        Change{"SlopeUnknown",
               [](LandingSite& s) {
                 s.slope_rad = {NAN, NAN};
               },
               Finding::kOver, "Slope ––, max 10°"},
        Change{"BandCrosses",
               [](LandingSite& s) {
                 s.slope_rad = {9.4 * kDeg, 1 * kDeg};
               },
               Finding::kDoubtful, "Slope 9.4° ± 1.0°, max 10°"},
        Change{"Step", [](LandingSite& s) { s.step_m.value = 0.2; }, Finding::kOver,
               "Step 20.0 cm ± 3.0 cm, max 15 cm"},
        Change{"BoxUnderTheLander",
               [](LandingSite& s) {
                 s.roughness_m = {0.5, 0.05};
                 s.safe_distance_m = 1.2;
               },
               Finding::kGross, "Roughness 50.0 cm ± 5.0 cm, max 10 cm"},
        Change{"SameBoxInTheNoise",
               [](LandingSite& s) {
                 s.roughness_m = {0.5, 0.35};
                 s.safe_distance_m = 1.2;
               },
               Finding::kOver, "Roughness 50.0 cm ± 35.0 cm, max 10 cm"},
        Change{"NoRoom", [](LandingSite& s) { s.safe_distance_m = 2.1; }, Finding::kOver,
               "Clear radius 2.1 m, min 2.3 m; roughness, 3.2 m south"},
        Change{"LessRoom", [](LandingSite& s) { s.clearance_m = 0.9; }, Finding::kDoubtful,
               "Room beyond the clear radius 0.9 m, selected with 2.0 m; roughness, 3.2 m south"},
        Change{"Old", [](LandingSite& s) { s.age_s = 2.6; }, Finding::kDoubtful,
               "Ground last measured 2.6 s ago, limit 2.0 s"},
        Change{"Approach", [](LandingSite& s) { s.corridor_clear = false; }, Finding::kDoubtful,
               "Something stands in the approach"}),
    [](const auto& row) { return row.param.name; });

TEST(JudgeRecheck, BandsOfAProvisionalSiteAreNoDoubt) {
  LandingSite site = GoodSite();
  site.roughness_m = {0.05, 0.2};
  EXPECT_EQ(JudgeRecheck(site, {}, {false, 2.0}, SladSettings{}).finding, Finding::kGood);
  EXPECT_EQ(JudgeRecheck(site, {}, {true, 2.0}, SladSettings{}).finding, Finding::kDoubtful);
  EXPECT_EQ(JudgeRecheck(std::nullopt, {}, {true, 2.0}, SladSettings{}).finding, Finding::kOver);
}

TEST(JudgeRecheck, WhatStandsInTheApproachIsNamedWithItsPlace) {
  using Kind = ApproachObstacle::Kind;
  struct Row {
    ApproachObstacle obstacle;
    const char* reason;
  };
  for (const Row& row :
       {Row{{Kind::kStands, 3.24, 4.46, Rad(180)},
            "Something 3.2 m high stands in the approach, 4.5 m south of the site"},
        Row{{Kind::kThin, 7, 7.1, Rad(-45)},
            "A thin structure 7.0 m up hangs in the approach, 7.1 m north-west of the site"},
        Row{{Kind::kThin, HUGE_VAL, 12, Rad(90)},
            "A thin structure of unknown height hangs in the approach, 12.0 m east of the site"},
        Row{{Kind::kOnLevelWay},
            "Something on the level way to the approach is as high as the vehicle"}}) {
    LandingSite site = GoodSite();
    site.corridor_clear = false;
    site.in_approach = row.obstacle;
    EXPECT_EQ(JudgeRecheck(site, {}, {true, 2.0}, SladSettings{}).reason, row.reason);
  }
}

TEST(JudgeRecheck, WhatStandsInTheApproachOfAVehicleOnItsWayEndsTheApproval) {
  LandingSite site = GoodSite();
  site.corridor_clear = false;
  const SiteFinding found = JudgeRecheck(site, {}, {true, 2.0, true}, SladSettings{});
  EXPECT_EQ(found.finding, Finding::kOver);
  EXPECT_EQ(found.reason, "Something stands in the approach");
}

TEST(JudgeRecheck, RoomLostToWhatIsNotSeenIsNoDoubt) {
  LandingSite site = GoodSite();
  site.clearance_m = 0.4;
  const auto finding = [&](std::optional<NearestHazard> nearest) {
    return JudgeRecheck(site, nearest, {true, 2.0}, SladSettings{}).finding;
  };
  EXPECT_EQ(finding(Rock()), Finding::kDoubtful);
  EXPECT_EQ(finding(NearestHazard{std::nullopt, 2.7, 0, kHazardUnknown, 0}), Finding::kGood);
  EXPECT_EQ(finding(NearestHazard{Cell{3, 4}, 2.7, 0, kHazardUnknown, 0}), Finding::kGood);
  EXPECT_EQ(finding(NearestHazard{Cell{3, 4}, 2.7, 0, kHazardFlagged, kFlagMotion}),
            Finding::kDoubtful);
}

// ---- in the mission -----------------------------------------------------------------------------

void Descend(MissionRig& rig) {
  rig.Arm();
  ASSERT_TRUE(rig.ApproveNow().ok()) << rig.mission.status().cannot_approve_reason;
  ASSERT_TRUE(rig.RunUntil(MissionState::kDescending, 5));
  rig.Run(0.5);
}

bool HasAlarm(const MissionRig& rig, AlarmId id) {
  const auto& alarms = rig.mission.status().alarms;
  return std::any_of(alarms.begin(), alarms.end(),
                     [&](const Alarm& alarm) { return alarm.kind == id && alarm.active; });
}

TEST(Recheck, OneNoisyMapDoesNotStopADescent) {
  MissionRig rig;
  Descend(rig);
  for (int i = 0; i < 6; ++i) {
    rig.site_slope_rad = Rad(12);
    rig.Step();
    EXPECT_FALSE(rig.mission.status().rechecks.back().holds);
    rig.site_slope_rad = 0;
    rig.Run(0.5);
    EXPECT_EQ(rig.state(), MissionState::kDescending) << rig.mission.status().why;
  }
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 30)) << rig.mission.status().why;
}

// The limits in force are of the newest map: the last line of the re-checks tells the same figure.
TEST(Recheck, TheLastLineIsOfTheNewestMapAndOnlySomeStay) {
  MissionRig rig;
  Descend(rig);
  const std::size_t before = rig.mission.status().rechecks.size();
  for (int i = 0; i < 50; ++i) {
    rig.Site(101)->safe_distance_m = 4 + 0.01 * i;
    rig.Step();
    const MissionStatus& m = rig.mission.status();
    ASSERT_EQ(m.rechecks.back().safe_distance_m, rig.Site(101)->safe_distance_m);
    ASSERT_EQ(m.rechecks.back().safe_distance_m, m.armed_now->safe_distance_m);
  }
  const std::vector<SiteRecheck>& lines = rig.mission.status().rechecks;
  EXPECT_LE(lines.size(), before + 6);
  EXPECT_GE(lines.size(), before + 4);
  for (std::size_t i = before; i + 2 < lines.size(); ++i) {
    EXPECT_GE(SecondsBetween(lines[i].time, lines[i + 1].time), 0.99) << i;
  }
}

TEST(Recheck, DegradedIsACautionAndTheDescentGoesOn) {
  MissionRig rig;
  Descend(rig);
  rig.site_slope_rad = Rad(9.5);
  rig.Site(101)->slope_rad.three_sigma = Rad(1);
  rig.Run(0.4);
  EXPECT_EQ(rig.state(), MissionState::kDescending);
  EXPECT_EQ(rig.mission.status().rechecks.back().verdict, SiteVerdict::kDegraded);
  EXPECT_EQ(rig.mission.status().rechecks.back().reason, "Slope 9.5° ± 1.0°, max 10°");
  EXPECT_TRUE(HasAlarm(rig, AlarmId::kSiteDegraded));
  rig.site_slope_rad = 0;
  rig.Run(1);
  EXPECT_EQ(rig.mission.status().rechecks.back().verdict, SiteVerdict::kHolds);
  EXPECT_FALSE(HasAlarm(rig, AlarmId::kSiteDegraded));
  ASSERT_TRUE(rig.RunUntil(MissionState::kLanded, 30)) << rig.mission.status().why;
}

TEST(Recheck, AGrossHazardHoldsOnTheVeryMap) {
  MissionRig rig;
  Descend(rig);
  rig.Site(101)->roughness_m = {0.6, 0.05};
  rig.Site(101)->safe_distance_m = 0.5;
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kHold);
}

TEST(Recheck, LossOffersTheAlternativeAndNeverFliesThere) {
  MissionRig rig;
  Descend(rig);
  ASSERT_TRUE(rig.mission.status().rechecks.back().alternative.has_value());
  EXPECT_EQ(rig.mission.status().rechecks.back().alternative->letter, "B");
  rig.site_slope_rad = Rad(12);
  rig.Run(0.5);
  ASSERT_EQ(rig.state(), MissionState::kHold);
  bool offered = false;
  for (const Alarm& alarm : rig.mission.status().alarms) {
    offered = offered || alarm.text.find("Alternative: site B, 4.0 m clear.") != std::string::npos;
  }
  EXPECT_TRUE(offered);
  const int approvals = rig.SentCount<Approval>();
  rig.Run(10);
  EXPECT_EQ(rig.SentCount<Approval>(), approvals);
  EXPECT_TRUE(rig.state() == MissionState::kProposed || rig.state() == MissionState::kSearch);
}

// A place remembered from higher up is named as what it is: nobody can approve it from here.
TEST(Recheck, AnAlternativeThatHasLeftTheViewIsSaidToHave) {
  MissionRig rig;
  Descend(rig);
  rig.Site(102)->age_s = 12;
  rig.site_slope_rad = Rad(12);
  rig.Run(0.5);
  ASSERT_EQ(rig.state(), MissionState::kHold);
  bool said = false;
  for (const Alarm& alarm : rig.mission.status().alarms) {
    said = said || alarm.text.find("Alternative: site B, 4.0 m clear, not all in view.") !=
                       std::string::npos;
  }
  EXPECT_TRUE(said);
}

TEST(Recheck, TheAlternativeSharesNoGroundAndIsRecheckedToo) {
  MissionRig rig;
  rig.sites[1].p_WS = rig.sites[0].p_WS + Eigen::Vector3d(4.5, 0, 0);  // discs of 2.3 m overlap
  rig.AddSite(103, 'C', {-12, 0, 0});
  rig.AddSite(104, 'D', {-20, 0, 0});
  Descend(rig);
  const auto kept = [&] {
    const auto& site = rig.mission.status().rechecks.back().alternative;
    return site ? site->letter : "-";
  };
  EXPECT_EQ(kept(), "C");
  std::swap(rig.sites[2], rig.sites[3]);  // D ranks before C now: it is the best other site
  rig.Run(0.3);
  EXPECT_EQ(kept(), "D");
  rig.Site(104)->safe_distance_m = 1;
  rig.Run(0.3);
  EXPECT_EQ(kept(), "C");
  rig.Site(103)->safe_distance_m = 1;
  rig.Run(0.3);
  EXPECT_EQ(kept(), "-");
  EXPECT_EQ(rig.state(), MissionState::kDescending);
}

TEST(Recheck, WhereEveryApproachIsBlockedNothingIsApproved) {
  MissionRig rig;
  rig.Site(101)->corridor_clear = false;
  rig.Site(101)->clear_approaches = 0;
  rig.Arm();
  EXPECT_FALSE(rig.mission.status().can_approve);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason, "Approach to site A is blocked");
  rig.Site(101)->corridor_clear = true;
  rig.Run(0.3);
  EXPECT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
}

// Seen again from near the ground it may be something else: nobody approves what is only
// remembered.
TEST(Recheck, GroundThatWasNotSeenForTwoSecondsCannotBeApproved) {
  MissionRig rig;
  rig.Arm();
  ASSERT_TRUE(rig.mission.status().can_approve) << rig.mission.status().cannot_approve_reason;
  rig.Site(101)->age_s = 16.3;
  rig.Step();
  EXPECT_EQ(rig.state(), MissionState::kArmed);  // a doubt ends no selection
  EXPECT_FALSE(FindGuard(rig.mission.status().guards, GuardId::kSite)->pass);
  EXPECT_EQ(rig.mission.status().cannot_approve_reason,
            "Ground last measured 16.3 s ago, limit 2.0 s");
  EXPECT_FALSE(rig.ApproveNow().ok());
  rig.Site(101)->age_s = 0.1;
  rig.Step();
  EXPECT_TRUE(rig.ApproveNow().ok());
}

TEST(Mission, ASelectedSiteThatBecomesConfirmedIsAnEvent) {
  MissionRig rig;
  rig.Site(101)->confirmed = false;
  rig.Arm();
  const auto told = [&] {
    int count = 0;
    for (const Event& event : rig.mission.events()) {
      count += event.text.rfind("Site A confirmed, ", 0) == 0 ? 1 : 0;
    }
    return count;
  };
  rig.Run(1);
  EXPECT_EQ(told(), 0);
  rig.Site(101)->confirmed = true;
  rig.Run(1);
  EXPECT_EQ(told(), 1) << "once";
}

}  // namespace
}  // namespace palace
