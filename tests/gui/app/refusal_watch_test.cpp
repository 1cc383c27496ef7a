// A refusal of the engine is told once, whichever click it answers.
#include "gui/app/refusal_watch.h"

#include <gtest/gtest.h>

#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

TEST(RefusalWatch, TellsEachRefusalOnce) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch);
  std::vector<Event> events = *snap.session->events;
  const auto look = [&](RefusalWatch& watch) {
    snap.session.Edit().events = std::make_shared<const std::vector<Event>>(events);
    return watch.Newest(snap);
  };
  RefusalWatch watch;
  EXPECT_EQ(look(watch), "");
  events.push_back({snap.time, EventKind::kDecision, "Select refused: No site is proposed"});
  EXPECT_EQ(look(watch), "Select refused: No site is proposed");
  EXPECT_EQ(look(watch), "");
  events.push_back({snap.time, EventKind::kDecision, "Site A refused by the operator"});
  EXPECT_EQ(look(watch), "");
  events.erase(events.begin(), events.begin() + 3);
  events.push_back({snap.time, EventKind::kDecision, "Hold refused: No descent to hold"});
  EXPECT_EQ(look(watch), "Hold refused: No descent to hold");
}

TEST(RefusalWatch, ARecordedRefusalAnswersNobody) {
  EngineSnapshot snap = fake::Snapshot(MissionState::kSearch, SourceKind::kReplay);
  std::vector<Event> events = *snap.session->events;
  events.push_back({snap.time, EventKind::kDecision, "Select refused: No site is proposed"});
  snap.session.Edit().events = std::make_shared<const std::vector<Event>>(events);
  RefusalWatch watch;
  EXPECT_EQ(watch.Newest(snap), "");
}

}  // namespace
}  // namespace palace
