// The trackers side by side: in their panel, and on the picture that they are of.
#include <algorithm>
#include <string>

#include "gui/panels/review/review.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/gui/panels/panel_checks.h"
#include "tests/gui/panels/review_flight.h"

namespace palace {
namespace {

std::string TextOf(const ItemRecord& items, const std::string& name) {
  const Item* item = items.Find(name);
  return item != nullptr ? item->text : std::string("no such item");
}

const ImVec2 kWithTracker[] = {
    {1920, 1080}, {1920, 1032}, {2560, 1440}, {1280, 1100}, {1280, 1600}};

TEST(TrackerPanel, TellsOfEveryTrackerHowItAgreesAndWhatItDoes) {
  for (const ImVec2 size : kWithTracker) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kDescending));
    const ItemRecord& items = window.ui.items;
    EXPECT_EQ(TextOf(items, "tracker/Plane"), "in force");
    EXPECT_EQ(TextOf(items, "tracker/Template"), "LOST 1.2 s: coherence 0.42, limit 0.70");
    EXPECT_EQ(TextOf(items, "tracker/Feature 1"), "follows");
    EXPECT_EQ(TextOf(items, "tracker/Feature 12"), "drifts, limit 5 px");
    EXPECT_EQ(TextOf(items, "tracker/consensus"), "4 of 6 agree, within 0.7 px, ± 0.7 px");
    for (const char* words : {"0.94", "12.4 px", "LOST 1.2 s", "4 of 6 agree"}) {
      EXPECT_TRUE(HasText(items, words)) << words;
    }
    ExpectTextsInPanels(items);
  }
}

TEST(TrackerPanel, TellsWhyNobodyTrustsTheConsensusAndWhoIsInForceThoughLost) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  TrackerSetStatus& set = snap.flight.Edit().trackers;
  set.consensus.trusted = false;
  set.consensus.why_not_trusted = "2 trackers agree, min 3";
  set.members[0].state = FollowState::kLost;
  set.members[0].lost_s = 0.4;
  set.members[0].why_lost = "3 features, min 8";
  set.members[2].state = FollowState::kReacquired;
  FlyWindow window(1920, 1080, snap);
  EXPECT_EQ(TextOf(window.ui.items, "tracker/consensus"),
            "Not trusted: 2 trackers agree, min 3, ± 0.7 px");
  EXPECT_EQ(TextOf(window.ui.items, "tracker/Plane"), "in force, LOST 0.4 s: 3 features, min 8");
  EXPECT_EQ(TextOf(window.ui.items, "tracker/Feature 1"), "re-acquired");
  ExpectTextsInPanels(window.ui.items);
}

// What a row has no room for is whole under the pointer.
TEST(TrackerPanel, AReasonThatIsCutIsWholeUnderThePointer) {
  FlyWindow window(1280, 1100, fake::Snapshot(MissionState::kDescending));
  EXPECT_FALSE(HasText(window.ui.items, "limit 0.70"));
  window.ui.MoveTo("tracker/Template");
  window.Run(0.05);
  EXPECT_EQ(TextOf(window.ui.items, "tooltip"), "LOST 1.2 s: coherence 0.42, limit 0.70");
}

TEST(TrackerPanel, ThePicturesStandBelowTheRowsOrInTheirPlace) {
  for (const ImVec2 size : kWithTracker) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    FlyWindow window(size.x, size.y, fake::Snapshot(MissionState::kDescending));
    if (window.ui.items.Find("tracker_pictures") != nullptr) {
      EXPECT_FALSE(HasText(window.ui.items, "Difference"));
      window.ui.Click("tracker_pictures", window.draw);
      EXPECT_EQ(window.ui.items.Find("tracker/Plane"), nullptr);
    } else {
      EXPECT_NE(window.ui.items.Find("tracker/Plane"), nullptr);
    }
    EXPECT_TRUE(HasText(window.ui.items, "Difference"));
    ExpectTextsInPanels(window.ui.items);
  }
  FlyWindow low(1920, 1080, fake::Snapshot(MissionState::kDescending));
  EXPECT_NE(low.ui.items.Find("tracker_pictures"), nullptr) << "both have no room there";
}

TEST(TrackerPanel, WhatIsOfAnOldPictureSaysSo) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kDescending);
  EXPECT_FALSE(HasText(FlyWindow(1920, 1080, snap).ui.items, "Of a picture"));
  snap.flight.Edit().trackers.time = AddSeconds(snap.time, -0.8);
  EXPECT_TRUE(HasText(FlyWindow(1920, 1080, snap).ui.items, "Of a picture 0.8 s old"));
}

/// In a small picture a legend of many lines may lie over a feature, whose tag then has no place.
bool LegendHides(const FlyWindow& window, const std::string& tracker) {
  const ItemRecord& items = window.ui.items;
  const Rect picture = items.Find("left_camera")->rect;
  const Item* legend = items.Find("legend");
  for (const TrackerMember& member : window.snap.flight->trackers.members) {
    if (member.name == tracker) {
      const float scale = picture.w / 640;
      const ImVec2 at(picture.x + scale * static_cast<float>(member.pixel.x()),
                      picture.y + scale * static_cast<float>(member.pixel.y()));
      return legend != nullptr && legend->rect.Contains(at);
    }
  }
  return false;
}

TEST(TrackView, ShowsEachTrackerWithItsCoherenceAndALegendOfWhatIsDrawn) {
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    FlyWindow window(size.width, size.height, fake::Snapshot(MissionState::kDescending));
    EXPECT_EQ(window.ui.items.Find("track_legend"), nullptr);
    window.ui.Click("track_view", window.draw);
    const ItemRecord& items = window.ui.items;
    ASSERT_NE(items.Find("track_legend"), nullptr);
    for (const char* words : {"1 0.91", "12 0.79", "Plane 0.94 in force", "Consensus",
                              "LOST, coasted", "Drifts", "Search window"}) {
      EXPECT_TRUE(HasText(items, words)) << words;
    }
    EXPECT_TRUE(HasText(items, "2 0.88") || LegendHides(window, "Feature 2"));
    EXPECT_TRUE(HasText(items, "2 0.88") || size.width < 1600);
    ExpectTextsInPanels(items);
    TrackerSetStatus& set = window.snap.flight.Edit().trackers;
    for (TrackerMember& member : set.members) {
      member.state = FollowState::kFollowed;
      member.drifts = false;
      member.window_side_px = 0;
    }
    window.Run(0.05);
    EXPECT_FALSE(HasText(items, "LOST, coasted") || HasText(items, "Search window"));
    EXPECT_TRUE(HasText(items, "Consensus"));
    window.ui.Click("track_view", window.draw);
    EXPECT_EQ(items.Find("track_legend"), nullptr);
  }
}

// Places in one picture say nothing of where things are in another.
TEST(TrackView, OfAnotherPictureNothingIsDrawnAndItSaysSo) {
  FlyWindow window(1920, 1080, fake::Snapshot(MissionState::kDescending));
  window.ui.Click("track_view", window.draw);
  window.snap.flight.Edit().trackers.time = AddSeconds(window.snap.time, -0.8);
  window.Run(0.05);
  EXPECT_EQ(window.ui.items.Find("track_legend"), nullptr);
  EXPECT_FALSE(HasText(window.ui.items, "1 0.91"));
  EXPECT_TRUE(HasText(window.ui.items, "Track of 0.8 s ago: not drawn"));
}

TEST(TrackView, WhatIsNotKnownIsNotDrawn) {
  FlyWindow window(1280, 720, fake::Snapshot(MissionState::kDescending));
  window.ui.Click("track_view", window.draw);
  TrackerSetStatus& set = window.snap.flight.Edit().trackers;
  for (TrackerMember& member : set.members) {
    member.state = FollowState::kLost;
    member.pixel.setConstant(NAN);
    member.site_pixel.setConstant(NAN);
    member.sigma_px = NAN;
    member.window_centre.setConstant(NAN);
  }
  set.consensus = {};
  window.Run(0.05);
  EXPECT_FALSE(HasText(window.ui.items, "Consensus") || HasText(window.ui.items, "1 LOST"));
  set.members.clear();
  window.snap.flight.Edit().tracker.why_not_locked = "Map 2.4 s old, limit 1.0 s";
  window.Run(0.05);
  EXPECT_TRUE(HasText(window.ui.items, "No site is tracked"));
  ExpectTextsInPanels(window.ui.items);
}

TEST(TrackView, IsThereInAReviewToo) {
  EngineSnapshot snap = fake::Replay(false);
  snap.flight.Edit().trackers = fake::Trackers({300, 200});
  for (const WindowSize& size : kWindowSizes) {
    SCOPED_TRACE(size.name);
    UiHarness ui(size.width, size.height);
    ui.textures.left_camera = &ui;  // any non-null name: nothing is rendered
    ReviewState state;
    const auto draw = [&](UiFrame& f) {
      DrawReviewWorkspace(snap, nullptr, BodyOf(size.width, size.height), state, f);
    };
    ui.Frame(draw);
    ui.Click("track_view", draw);
    // A small picture has no room for it beside its letters.
    EXPECT_TRUE(size.width < 1600 || ui.items.Find("track_legend") != nullptr);
    EXPECT_TRUE(HasText(ui.items, "Plane 0.94 in force"));
    ExpectTextsInPanels(ui.items);
  }
}

}  // namespace
}  // namespace palace
