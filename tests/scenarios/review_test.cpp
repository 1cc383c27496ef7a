// Review of a recorded flight, by the engine itself: what the record says, and what other limits
// decide, over jumps and moved limits.
#include "engine/runtime/engine.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kLimit_s = 240;

class ReviewOfALog : public Scenario {
 protected:
  void SetUp() override {
    WriteFile("look.script", "wait state PROPOSED 20\nset slad.max_slope_deg 9\nwait seconds 4\n");
    const ProcessResult flight = RunProcess(
        Palace({"--headless", "--seed", "3", "--record", "records", "--script", "look.script"}),
        kLimit_s);
    ASSERT_EQ(flight.exit_code, 0) << flight.err;
    const auto flights = FlightsIn(folder_ / "records");
    ASSERT_EQ(flights.size(), 1u);
    EngineParts parts;
    source_ = std::shared_ptr<ReplaySource>(OpenLog(flights.front() / "flight.lcm"));
    record_ = source_->recorded();
    parts.source = source_;
    parts.record = record_;
    parts.settings = record_->settings_at_start;
    engine_ = std::make_unique<Engine>(std::move(parts), /*threaded=*/false);
  }
  void Play(int frames) {
    for (int i = 0; i < frames && engine_->Step(); ++i) {
    }
  }
  void Seek(double to_s) {
    engine_->Control({PlaybackControl::Kind::kSeek, to_s});
    ASSERT_TRUE(engine_->Step());
  }
  const TerrainPart& terrain() const { return *engine_->Latest()->terrain; }
  double position_s() const { return engine_->Latest()->session->source.position_s; }

  std::shared_ptr<ReplaySource> source_;
  std::shared_ptr<const FlightRecord> record_;
  std::unique_ptr<Engine> engine_;
};

TEST_F(ReviewOfALog, InventsNothingBetweenJumps) {
  // As recorded: nothing is decided again, wherever it is played.
  Play(8);
  Seek(2);
  Play(14);
  EXPECT_EQ(terrain().redecided, nullptr);
  EXPECT_EQ(engine_->Latest()->session->recorded_settings, engine_->Latest()->session->settings);

  // At the end the flight had moved a limit itself; that is not the reviewer's.
  Seek(record_->duration_s);
  EXPECT_EQ(engine_->Latest()->session->recorded_settings.slad.limits.max_slope_deg, 9);
  EXPECT_EQ(engine_->Latest()->session->settings.slad.limits.max_slope_deg, 9);

  // A limit no ground keeps: what is played under it has no site, and the rest stays empty.
  Seek(0);
  engine_->Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 0.5}});
  Play(25);
  ASSERT_NE(terrain().redecided, nullptr);
  const auto judged = terrain().redecided;
  const double until_s = position_s();
  ASSERT_GT(judged->size(), 5u);
  int differing = 0;
  for (const RedecidedSample& sample : *judged) {
    EXPECT_EQ(sample.best_site, "");
    differing += sample.differs ? 1 : 0;
  }
  EXPECT_GT(differing, 0);
  const auto unchanged = [&](const char* when) {
    ASSERT_NE(terrain().redecided, nullptr) << when;
    for (const RedecidedSample& sample : *terrain().redecided) {
      EXPECT_EQ(sample.best_site, "") << when;
    }
  };
  Seek(until_s + 0.1);  // a step of Review
  unchanged("stepped");
  EXPECT_EQ(terrain().redecided->size(), judged->size()) << "the map is being built anew";
  Seek(until_s + 2);
  unchanged("jumped");
  Seek(1);
  unchanged("jumped back");

  // Another limit: what was judged under the old one says nothing of it.
  engine_->Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 8}});
  Play(1);
  EXPECT_TRUE(terrain().redecided == nullptr || terrain().redecided->size() <= 1u);
}

TEST_F(ReviewOfALog, LettersAndEventsAreTheFlightsAfterAJump) {
  Seek(record_->duration_s - 2);
  Play(14);
  ASSERT_EQ(terrain().maps_to_rebuild, 0);
  const TerrainDecision& decision = *terrain().applied;
  const RecordedProposal* proposal = nullptr;
  for (const RecordedProposal& one : record_->proposals) {
    proposal = one.map_time == decision.map_time ? &one : proposal;
  }
  ASSERT_NE(proposal, nullptr);
  ASSERT_FALSE(proposal->places.empty());
  ASSERT_FALSE(decision.selection.sites.empty());
  int named = 0;
  for (const LandingSite& site : decision.selection.sites) {
    for (const RecordedPlace& place : proposal->places) {
      if ((place.north_east_m - site.p_WS.head<2>()).norm() < 0.2) {
        EXPECT_EQ(site.letter, place.letter);
        EXPECT_EQ(site.id, place.id);
        ++named;
      }
    }
  }
  EXPECT_GT(named, 0);

  // Diagnose: what the flight's own operator did, in order, and nothing of the reviewer.
  engine_->Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 0.5}});
  Play(2);
  const std::vector<Event>& events = *engine_->Latest()->session->events;
  ASSERT_FALSE(events.empty());
  int moved = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_LE(events[i].time, engine_->Latest()->time);
    EXPECT_TRUE(i == 0 || events[i - 1].time <= events[i].time);
    moved += events[i].kind == EventKind::kSetting ? 1 : 0;
    EXPECT_EQ(events[i].text.find("0.5"), std::string::npos) << events[i].text;
  }
  EXPECT_EQ(moved, 1);
}

}  // namespace
}  // namespace palace
