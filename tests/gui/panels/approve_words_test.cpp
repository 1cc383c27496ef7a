// What the approve panel says: every phase of its button, what an approval leads to, what to do
// first.
#include "gui/panels/approve_words.h"

#include <functional>
#include <utility>

#include "engine/model/site_standing.h"
#include "tests/gui/panels/fly_window.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

using Phase = MissionStatus::ApprovalPhase;

HoldButtonView Button(const EngineSnapshot& snap, double silent_s = 0) {
  return ApproveButton(snap, {}, 0, silent_s);
}

TEST(ApproveWords, TheButtonTellsWhatAHoldDoesOrWhyItDoesNothing) {
  const auto mission = [](EngineSnapshot& snap) -> MissionStatus& {
    return snap.flight.Edit().mission;
  };
  const struct {
    const char* name;
    std::function<void(EngineSnapshot&)> change;
    HoldPhase phase;
    const char *label, *reason;
  } table[] = {
      {"armed", [](EngineSnapshot&) {}, HoldPhase::kReady, "Hold to approve A", ""},
      {"provisional", [&](EngineSnapshot& s) { mission(s).armed->confirmed = false; },
       HoldPhase::kReady, "Hold to approve A, provisional", ""},
      {"look first",
       [&](EngineSnapshot& s) {
         mission(s).armed->confirmed = false;
         mission(s).armed->height_m.three_sigma = 0.2;
       },
       HoldPhase::kReady, "Hold to approve A, not seen enough", ""},
      {"confirmed by a map since",
       [&](EngineSnapshot& s) {
         mission(s).armed->confirmed = false;
         mission(s).armed_confirmed = true;
       },
       HoldPhase::kReady, "Hold to approve A", ""},
      {"sent",
       [&](EngineSnapshot& s) {
         mission(s).approval_phase = Phase::kSent;
         mission(s).approval_answer_s = 0.4;
       },
       HoldPhase::kRequested, "Sent to vehicle", "Waiting 0.4 s"},
      {"accepted",
       [&](EngineSnapshot& s) {
         mission(s).approval_phase = Phase::kAccepted;
         mission(s).approval_answer_s = 0.3;
       },
       HoldPhase::kAccepted, "Approved A", "Vehicle accepted in 0.3 s"},
      {"refused",
       [&](EngineSnapshot& s) {
         mission(s).approval_phase = Phase::kRefused;
         mission(s).approval_answer = "Too low";
       },
       HoldPhase::kRefused, "Hold to approve A", "Too low"},
      {"refused by a check at the moment of the press",
       [](EngineSnapshot& s) {
         s.session.Edit().events = std::make_shared<const std::vector<Event>>(
             std::vector<Event>{{AddSeconds(s.time, -2), EventKind::kDecision,
                                 "Approve refused: Safe as seen 0.657, min 0.720"},
                                {AddSeconds(s.time, -1), EventKind::kAlarm, "Something else"}});
       },
       HoldPhase::kReady, "Hold to approve A", "Not approved: Safe as seen 0.657, min 0.720"},
      {"refused long ago",
       [](EngineSnapshot& s) {
         s.session.Edit().events = std::make_shared<const std::vector<Event>>(std::vector<Event>{
             {AddSeconds(s.time, -20), EventKind::kDecision, "Approve refused: Link lost"}});
       },
       HoldPhase::kReady, "Hold to approve A", ""},
      {"preview", [](EngineSnapshot& s) { s.terrain.Edit().preview = s.terrain->applied; },
       HoldPhase::kBlocked, "Hold to approve A", "Maps are a preview"},
      {"blocked",
       [&](EngineSnapshot& s) {
         mission(s).can_approve = false;
         mission(s).cannot_approve_reason = "GPS lost";
       },
       HoldPhase::kBlocked, "Hold to approve A", "GPS lost"},
      {"blocked by what nobody told", [&](EngineSnapshot& s) { mission(s).can_approve = false; },
       HoldPhase::kBlocked, "Hold to approve A", "A check fails"}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
    snap.flight.Edit().mission.armed->confirmed = true;
    row.change(snap);
    const HoldButtonView view = Button(snap);
    EXPECT_EQ(view.phase, row.phase);
    EXPECT_EQ(view.label, row.label);
    EXPECT_EQ(view.reason, row.reason);
    EXPECT_EQ(view.subject, 1u);
  }
  const HoldButtonView none = Button(fake::Snapshot(MissionState::kProposed));
  EXPECT_EQ(none.reason, "Select a site first");
  EXPECT_EQ(none.subject, 0u);
  EngineSnapshot searching = fake::Snapshot(MissionState::kSearch);
  EXPECT_EQ(Button(searching).reason, "No site is proposed yet");
  searching.flight.Edit().mission.search_stopped = "Left camera repeats its picture";
  EXPECT_EQ(Button(searching).reason, "Left camera repeats its picture");
  const HoldButtonView replay = Button(fake::Snapshot(MissionState::kArmed, SourceKind::kReplay));
  EXPECT_EQ(replay.phase, HoldPhase::kNoVehicle);
  EXPECT_EQ(replay.reason, "No link in replay");
}

TEST(ApproveWords, WhatWasAskedIsSaidForTwoSecondsWhileNobodyAnswers) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  ApproveState state;
  state.asked_site = 1;
  state.asked_at_s = 10;
  EXPECT_EQ(ApproveButton(snap, state, 11.9, 0).label, "Approving A");
  EXPECT_EQ(ApproveButton(snap, state, 12.1, 0).phase, HoldPhase::kReady);
  state.asked_site = 2;
  EXPECT_EQ(ApproveButton(snap, state, 11.9, 0).phase, HoldPhase::kReady);
}

TEST(ApproveWords, AScreenBehindTheEngineApprovesNothing) {
  const EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  EXPECT_EQ(WhyNotApprove(snap, 0), "");
  EXPECT_NE(WhyNotApprove(snap, 3), "");
  EXPECT_EQ(Button(snap, 3).phase, HoldPhase::kBlocked);
  EXPECT_EQ(Button(snap, 3).reason, WhyNotApprove(snap, 3));
}

TEST(ApproveWords, TheFirstCheckThatFailsIsSaidByItsReasonElseByItsName) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  GuardResult& second = snap.flight.Edit().mission.guards[1];
  second.pass = false;
  second.reason = "";
  EXPECT_EQ(WhyNotApprove(snap, 0), second.name);
  second.reason = "Wind 9.1 m/s, limit 8.0 m/s";
  EXPECT_EQ(WhyNotApprove(snap, 0), second.reason);
  snap.flight.Edit().mission.guards[2].pass = false;
  EXPECT_EQ(WhyNotApprove(snap, 0), "Wind 9.1 m/s, limit 8.0 m/s");
  snap.terrain.Edit().preview = snap.terrain->applied;
  EXPECT_EQ(WhyNotApprove(snap, 0), "Maps are a preview");
}

// What pictures need not have shown: the vehicle's own height, from here to where the slope begins.
TEST(ApproveWords, ALevelWayBeforeTheSlopeIsTold) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed->confirmed = true;
  const Eigen::Vector3d site = m.site_p_WS = {3, 4, 0};
  const auto begins_at = [&](double north_m) {
    const Eigen::Vector3d here = site + Eigen::Vector3d(-10, 0, -12);
    m.way_W = {here, here + Eigen::Vector3d(north_m, 0, 0), site};
    return ApprovalConsequence(snap, false);
  };
  EXPECT_NE(begins_at(-2.14).find("heading 040°, backs 2.1 m level first."), std::string::npos);
  EXPECT_NE(begins_at(5.2).find("heading 040°, flies 5.2 m level first."), std::string::npos);
  EXPECT_EQ(begins_at(0.9).find("level first"), std::string::npos);
  m.approach->side = 0;
  EXPECT_NE(begins_at(-2.14).find(", flies 2.1 m level first"), std::string::npos);
  m.way_W.clear();
  EXPECT_EQ(ApprovalConsequence(snap, false).find("level first"), std::string::npos);
}

TEST(ApproveWords, AnApprovalLeadsToADescentUnlessSomethingSpeaksAgainstTheSite) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  MissionStatus& m = snap.flight.Edit().mission;
  m.armed->confirmed = true;
  EXPECT_EQ(ApprovalConsequence(snap, false),
            "5.9 m away, 38.2 m down, heading 040°. Touchdown in about 72 s at 1.0 m/s. From here "
            "nothing thinner than 6 cm is sure to be seen.");
  EXPECT_EQ(ApprovalConsequence(snap, true),
            "5.9 m away, 38.2 m down, heading 040°, down in 72 s. "
            "Nothing thinner than 6 cm is sure to be seen.");
  m.armed->confirmed = false;
  m.armed->frames_fused = 1;
  EXPECT_NE(ApprovalConsequence(snap, false).find("Provisional: "), std::string::npos);
  // The button names the standing: what is left of the sentence is one of its own.
  EXPECT_EQ(
      ApprovalConsequence(snap, true),
      "Seen in 1 of the 3 frames that it takes. Nothing thinner than 6 cm is sure to be seen.");
  EXPECT_NE(ApprovalConsequence(snap, false).find("nothing thinner than 6 cm"), std::string::npos);
  m.armed->height_m.three_sigma = 0.2;
  EXPECT_NE(ApprovalConsequence(snap, false).find("Look first: height noise 20.0 cm"),
            std::string::npos);
  m.armed->height_m.three_sigma = 0.03;
  auto shaken = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  // 24 s before a map that is 4 s old.
  shaken->selection.sites[0].called_unsafe_s = 24;
  shaken->selection.sites[0].map_time = AddSeconds(snap.time, -4);
  snap.terrain.Edit().applied = shaken;
  EXPECT_EQ(ApprovalConsequence(snap, true),
            "A map called it unsafe 28 s ago. Nothing thinner than 6 cm is sure to be seen.");
  EXPECT_EQ(
      ApprovalConsequence(snap, false),
      "A map called it unsafe 28 s ago. Provisional: seen in 1 of the 3 frames that it takes. From "
      "here nothing thinner than 6 cm is sure to be seen.");
  snap.flight.Edit().mission.armed->confirmed = true;
  EXPECT_EQ(ApprovalConsequence(snap, false).find("A map called it unsafe 28 s ago. 5.9 m"), 0u);
  snap.flight.Edit().mission.approach = ApproachPlan{};
  snap.flight.Edit().mission.approach->side = 3;
  const std::string line = ApprovalConsequence(snap, true);
  EXPECT_EQ(line.find("Called unsafe 28 s ago, from the "), 0u) << line;
}

// Cut at a clause, "from the south…" might be any of three sides.
TEST(LandingWords, TheSideOfTheApproachIsWholeOrNotThere) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kApproved);
  snap.flight.Edit().mission.approach = ApproachPlan{};
  snap.flight.Edit().mission.approach->side = 3;
  snap.flight.Edit().mission.approach->heading_rad = 0;
  snap.flight.Edit().mission.approach->why = "the straight way is blocked by a thin structure";
  for (const auto& [w, h] : {std::pair{1280, 720}, {1920, 1080}}) {
    FlyWindow window(w, h, snap);
    bool told = false;
    for (const Item& item : window.ui.items.items()) {
      const bool headline = item.name == "text" && item.text.rfind("Approved: site A", 0) == 0;
      told = told || headline;
      EXPECT_TRUE(!headline || item.text.find("…") == std::string::npos) << item.text;
      EXPECT_TRUE(!headline || item.text.find("from the south") != std::string::npos);
    }
    EXPECT_TRUE(told);
  }
}

TEST(ApproveWords, WithoutASelectionItSaysWhatToDo) {
  EXPECT_EQ(WhatToDoUnarmed(fake::Snapshot(MissionState::kProposed)),
            "Click a letter or a row, or press Tab and Enter, to select.");
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  EXPECT_EQ(WhatToDoUnarmed(snap).rfind("Selectable once one site has led for ", 0), 0u);
  snap.flight.Edit().mission.search_stopped = "Left camera repeats its picture";
  EXPECT_EQ(WhatToDoUnarmed(snap), "Left camera repeats its picture: no site is proposed.");
  snap.terrain.Edit().applied = nullptr;
  EXPECT_EQ(WhatToDoUnarmed(snap), "Waiting for a site inside all limits.");
  const auto early = std::make_shared<TerrainDecision>();
  early->selection.waits = true;
  snap.terrain.Edit().applied = early;
  EXPECT_EQ(WhatToDoUnarmed(snap), "Waiting for the first list of sites.");
  EXPECT_EQ(NextSiteLetter(snap), "");
}

TEST(ApproveWords, ARefusalLeadsToTheNextSiteThatWasNotRefused) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kArmed);
  EXPECT_EQ(NextSiteLetter(snap), "B");
  auto unreached = std::make_shared<TerrainDecision>(*snap.terrain->applied);
  unreached->selection.sites[1].corridor_clear = false;
  unreached->selection.sites[1].clear_approaches = 0;
  EngineSnapshot other = snap;
  other.terrain.Edit().applied = unreached;
  EXPECT_EQ(NextSiteLetter(other), "C");  // nobody is sent to one that cannot be used
  snap.flight.Edit().mission.refused_sites = {2};
  EXPECT_EQ(NextSiteLetter(snap), "C");
  EXPECT_EQ(NextSiteLetter(fake::Snapshot(MissionState::kProposed)), "");
}

}  // namespace
}  // namespace palace
