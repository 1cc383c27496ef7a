// The vehicle panel: each figure by whom it is known, and none that nobody tells.
#include "engine/model/channel_age.h"
#include "gui/panels/fly_panels.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"

namespace palace {
namespace {

TEST(VehiclePanel, TellsAClimbAsAClimbAndATouchdownAsItWasMeasured) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  for (LimitRow& row : snap.flight.Edit().mission.limits) {
    row.value = row.id == LimitId::kDescentRate ? -1.42 : row.value;
  }
  EXPECT_EQ(FlyWindow(1920, 1080, snap).ui.items.Find("readout/Climb rate")->text, "1.42 m/s");
  EngineSnapshot landed = fake::Snapshot(MissionState::kLanded);
  landed.flight.Edit().mission.touchdown_miss_m = 0.46;
  landed.flight.Edit().mission.touchdown_miss_true_m = 0.55;
  landed.flight.Edit().mission.touchdown_sink_mps = 0.41;
  landed.flight.Edit().mission.distance_to_site_m = 1.0;  // the estimate drifts on
  FlyWindow window(1920, 1080, landed);
  EXPECT_EQ(window.ui.items.Find("readout/Off centre, estimate")->text, "0.46 m");
  EXPECT_EQ(window.ui.items.Find("readout/Off centre, in truth")->text, "0.55 m");
  EXPECT_EQ(window.ui.items.Find("readout/Sink rate, estimate")->text, "0.41 m/s");
  EXPECT_EQ(window.ui.items.Find("readout/From site centre"), nullptr);
  ExpectTextsInPanels(window.ui.items);
}

/// Vision is in force and no picture comes: GPS and the laser go on telling the height.
TEST(VehiclePanel, AHeightThatOthersKnowIsShownWithItsSource) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kHold);
  snap.flight.Edit().mission.height_above_site_m = NAN;
  auto history = *snap.flight->history;
  history.back().gps_height_m = 21.9;
  history.back().laser_m = 21.2;
  const auto height = [&](const char* item, float width, float high) {
    snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
    FlyWindow window(width, high, snap);
    ExpectTextsInPanels(window.ui.items);
    const Item* found = window.ui.items.Find(std::string("readout/") + item);
    return found != nullptr ? found->text : std::string("none");
  };
  EXPECT_EQ(height("Height above site", 1920, 1080), "21.9 m, GPS");
  EXPECT_EQ(height("Height, GPS", 1280, 720), "21.9 m");
  history.back().gps_height_m = NAN;
  EXPECT_EQ(height("Height above ground", 1920, 1080), "21.2 m, laser");
  EXPECT_EQ(height("Height, laser", 1280, 720), "21.2 m");
  history.back().laser_m = NAN;
  EXPECT_EQ(height("Height above site", 1920, 1080), "–– m");
}

// The laser measures over the ground, the pose over the origin: here the ground is at the origin.
TEST(VehiclePanel, AHoversHeightIsThatOfTheSkidsWhoeverTellsIt) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  snap.session.Edit().settings.slad.lander.gear_below_m = 0.9;  // the pose is 38.5 m up
  auto history = *snap.flight->history;
  for (const bool laser : {true, false}) {
    for (HistorySample& sample : history) {
      sample.laser_m = laser ? 37.6 : NAN;
    }
    snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      FlyWindow window(size.x, size.y, snap);
      ExpectTextsInPanels(window.ui.items);
      const std::string label = laser ? "bove ground" : "bove origin";
      const Item* height =
          window.ui.items.Find("readout/" + (size.x > 1500 ? "Height a" + label : "A" + label));
      ASSERT_NE(height, nullptr) << label << " at " << size.x;
      EXPECT_EQ(height->text, size.x < 1500 ? "37.6 m" : laser ? "37.6 m, laser" : "37.6 m, pose");
      EXPECT_EQ(HasText(window.ui.items, "no return"), !laser) << "at " << size.x;
    }
  }
}

/// Its last return came so long ago; its messages come on, or came no more either.
EngineSnapshot LaserWithout(double return_s, bool messages) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto history = *snap.flight->history;
  for (HistorySample& sample : history) {
    const bool before = SecondsBetween(sample.time, snap.time) >= return_s - 1e-6;
    sample.laser_m = before ? 21.5 : NAN;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  for (ChannelHealth& channel : snap.sensors.Edit().channels) {
    if (channel.id == ChannelId::kLaserRange && !messages) {
      channel.age_s = return_s;
      channel.state = StateAt(return_s, channel.expected_hz);
    }
  }
  return snap;
}

// A turn leans the beam away from the ground in reach: the last height stays, with the age of its
// own return, whatever came since, and for three seconds.
TEST(VehiclePanel, ALaserThatHasNoReturnForAMomentKeepsItsHeightWithItsAge) {
  const struct {
    double return_s;
    bool laser;
    const char* age;
  } table[] = {
      {0.0, true, nullptr}, {0.4, true, "0.40 s"}, {2.5, true, "2.5 s old"}, {3.5, false, nullptr}};
  for (const auto& row : table) {
    for (const bool messages : {true, false}) {
      for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
        SCOPED_TRACE(testing::Message()
                     << row.return_s << " s, messages " << messages << ", " << size.x);
        FlyWindow window(size.x, size.y, LaserWithout(row.return_s, messages));
        ExpectTextsInPanels(window.ui.items);
        const std::string label = row.laser ? "bove ground" : "bove origin";
        const Item* height =
            window.ui.items.Find("readout/" + (size.x > 1500 ? "Height a" + label : "A" + label));
        ASSERT_NE(height, nullptr);
        EXPECT_EQ(height->text.rfind(row.laser ? "21.5 m" : "37.6 m", 0), 0U) << height->text;
        if (row.age != nullptr) {
          EXPECT_TRUE(HasText(window.ui.items, row.age));
        }
      }
    }
  }
}

// What is broken is told: the beam that meets nothing, or the laser that says nothing.
TEST(VehiclePanel, ALaserWithoutAReturnAndOneThatIsSilentAreToldApart) {
  for (const bool messages : {true, false}) {
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      SCOPED_TRACE(testing::Message() << "messages " << messages << ", " << size.x);
      FlyWindow window(size.x, size.y, LaserWithout(3.5, messages));
      EXPECT_EQ(HasText(window.ui.items, "no return"), messages);
      EXPECT_EQ(HasText(window.ui.items, "laser silent"), !messages);
      window.ui.MoveTo(size.x > 1500 ? "readout/Height above origin" : "readout/Above origin");
      window.Run(0.05);
      const Item* tooltip = window.ui.items.Find("tooltip");
      ASSERT_NE(tooltip, nullptr);
      EXPECT_EQ(tooltip->text.rfind(
                    messages ? "The laser has no return" : "No message of the laser comes", 0),
                0U)
          << tooltip->text;
    }
  }
}

TEST(VehiclePanel, AHeightByThePoseOfAVehicleWithoutLaserSaysSo) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  auto history = *snap.flight->history;
  for (HistorySample& sample : history) {
    sample.laser_m = NAN;
  }
  snap.flight.Edit().history = std::make_shared<const std::vector<HistorySample>>(history);
  for (ChannelHealth& channel : snap.sensors.Edit().channels) {
    if (channel.id == ChannelId::kLaserRange) {
      channel.state = ChannelHealth::State::kNever;
    }
  }
  FlyWindow window(1920, 1080, snap);
  const Item* height = window.ui.items.Find("readout/Height above origin");
  ASSERT_NE(height, nullptr);
  EXPECT_NE(height->text.find("m, pose"), std::string::npos) << height->text;
}

TEST(VehiclePanel, AWindTooWeakToComeFromAnywhereHasNoDirection) {
  const struct {
    double wind_mps, from_rad;
    const char *label, *words;
  } table[] = {{2.1, Rad(240), "Wind, from", "2.1 m/s, 240°"},
               {0.3, Rad(240), "Wind", "0.3 m/s"},
               {2.1, NAN, "Wind", "2.1 m/s"}};
  for (const auto& row : table) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    snap.sensors.Edit().vehicle->wind_speed_mps = row.wind_mps;
    snap.sensors.Edit().vehicle->wind_from_rad = row.from_rad;
    for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
      FlyWindow window(size.x, size.y, snap);
      const Item* wind = window.ui.items.Find(std::string("readout/") + row.label);
      ASSERT_NE(wind, nullptr) << row.label;
      EXPECT_EQ(wind->text, row.words);
      ExpectTextsInPanels(window.ui.items);
    }
    // Where the clause has no room behind the value it stands in the label.
    EXPECT_EQ(HasText(FlyWindow(1280, 720, snap).ui.items, "Wind, 240°"),
              std::string(row.label) == "Wind, from");
    EXPECT_TRUE(HasText(FlyWindow(1280, 720, snap).ui.items, "Hdg 0"));
  }
}

TEST(VehiclePanel, AHoverThatClimbsOrSinksTellsHowFast) {
  const struct {
    double down_mps;
    const char *wide, *narrow, *words;
  } table[] = {{-1.24, "Climb rate", "Climb", "1.2 m/s"},
               {0.8, "Descent rate", "Descent", "0.8 m/s"},
               {-0.1, "Heading", "Speed", nullptr},
               {NAN, "Heading", "Speed", nullptr}};
  for (const auto& row : table) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
    snap.sensors.Edit().pose->v_WB.z() = row.down_mps;
    for (const auto& [size, label] :
         {std::pair{ImVec2(1920, 1080), row.wide}, std::pair{ImVec2(1280, 720), row.narrow}}) {
      FlyWindow window(size.x, size.y, snap);
      const Item* item = window.ui.items.Find(std::string("readout/") + label);
      ASSERT_NE(item, nullptr) << label;
      if (row.words != nullptr) {
        EXPECT_EQ(item->text, row.words);
      }
      EXPECT_NE(window.ui.items.Find("readout/Wind, from"), nullptr) << label;
      ExpectTextsInPanels(window.ui.items);
    }
  }
}

// In gusts it waits above the site for longer than by the clock: no figure stands still
// unexplained.
TEST(VehiclePanel, WhileItSettlesTheTimeToGoIsAtLeast) {
  for (const ImVec2 size : {ImVec2(1920, 1080), ImVec2(1280, 720)}) {
    EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
    snap.flight.Edit().mission.time_to_touchdown_s = 7.2;
    const char* item = size.x > 1300 ? "readout/Time to go" : "readout/To go";
    snap.sensors.Edit().vehicle->mode = VehicleMode::kDescend;
    EXPECT_EQ(FlyWindow(size.x, size.y, snap).ui.items.Find(item)->text, "7 s");
    snap.sensors.Edit().vehicle->mode = VehicleMode::kSettle;
    FlyWindow window(size.x, size.y, snap);
    EXPECT_EQ(window.ui.items.Find(item)->text, size.x > 1300 ? "over 7 s, settling" : "over 7 s");
    EXPECT_TRUE(HasText(window.ui.items, "over 7 s"));  // of the landing
    ExpectTextsInPanels(window.ui.items);
  }
}

// In the least window four figures have room; a higher one has them all, however narrow.
TEST(VehiclePanel, ANarrowPanelShowsTheEnergyOnceItIsLow) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kProposed);
  EXPECT_EQ(FlyWindow(1280, 720, snap).ui.items.Find("readout/Energy"), nullptr);
  snap.flight.Edit().mission.alarms.push_back(
      {.kind = AlarmId::kEnergyLow, .level = AlarmLevel::kCaution, .text = "Low.", .active = true});
  FlyWindow low(1280, 720, snap);
  const Item* energy = low.ui.items.Find("readout/Energy");
  ASSERT_NE(energy, nullptr);
  EXPECT_EQ(energy->text.find("%"), energy->text.size() - 1) << energy->text;
  EXPECT_NE(low.ui.items.Find("readout/Above ground"), nullptr);
  ExpectTextsInPanels(low.ui.items);
  for (const MissionState state : {MissionState::kProposed, MissionState::kDescending}) {
    FlyWindow high(1280, 1100, fake::Snapshot(state));
    EXPECT_NE(high.ui.items.Find("readout/Energy"), nullptr);
    EXPECT_NE(high.ui.items.Find("readout/Wind, from"), nullptr);
    ExpectTextsInPanels(high.ui.items);
  }
}

}  // namespace
}  // namespace palace
