// Review of a recorded flight, by the engine itself: what the record says, and what other limits
// decide, over jumps and moved limits.
#include <algorithm>

#include "engine/runtime/engine.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kLimit_s = 240;

/// Flies by the script, headless, and opens the log.
class Review : public Scenario {
 protected:
  void Fly(const std::string& script) {
    std::vector<std::string> arguments = {"--headless", "--seed", "3", "--record", "records"};
    if (!script.empty()) {
      WriteFile("look.script", script);
      arguments.insert(arguments.end(), {"--script", "look.script"});
    }
    const ProcessResult flight = RunProcess(Palace(arguments), kLimit_s);
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
  const MissionStatus& mission() const { return engine_->Latest()->flight->mission; }
  double position_s() const { return engine_->Latest()->session->source.position_s; }

  std::shared_ptr<ReplaySource> source_;
  std::shared_ptr<const FlightRecord> record_;
  std::unique_ptr<Engine> engine_;
};

class ReviewOfALog : public Review {
 protected:
  void SetUp() override {
    Fly("wait state PROPOSED 20\nset slad.max_slope_deg 9\nwait seconds 4\n");
  }
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

  // A limit no ground is known to keep: what is played under it has no site, and the rest stays
  // empty.
  Seek(0);
  engine_->Post({CommandOrigin::kOperator, SetSetting{"slad.max_deviation_m", 0.005}});
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

/// From the start of the flight to the first of its samples for which that is so.
template <typename Condition>
double SecondsTo(const FlightRecord& record, Condition condition) {
  const auto found = std::find_if(record.samples.begin(), record.samples.end(), condition);
  EXPECT_NE(found, record.samples.end());
  return SecondsBetween(record.samples.front().time, found->time);
}

// A whole landing; the first site is refused before, so that another is flown to.
TEST_F(Review, OfALandingTellsBelowTheMapsAndOnTheGroundWhatTheRecordSays) {
  ASSERT_NO_FATAL_FAILURE(
      Fly("wait state PROPOSED 60\nwait seconds 6\nclick site/best\nwait state ARMED 5\n"
          "click refuse\nwait state PROPOSED 20\nwait seconds 1\nclick site/best\n"
          "wait state ARMED 5\nwait item approve 20\nwait seconds 1.2\nhold approve 1.2\n"
          "wait state LANDED 200\nwait seconds 2\n"));
  ASSERT_EQ(record_->touchdowns.size(), 1u);
  ASSERT_EQ(record_->armed_sites.size(), 2u);
  const LandingSite refused = record_->armed_sites[0], flown = record_->armed_sites[1];
  ASSERT_NE(refused.id, flown.id);

  const auto lands = [](const FlightRecordSample& s) { return s.state == MissionState::kLanded; };
  const auto low = [](const FlightRecordSample& s) {
    return s.state == MissionState::kDescending && s.height_above_site_m < 2.5;
  };
  // Below the commit height no map comes any more, and it says so from the first frame on.
  Seek(SecondsTo(*record_, low));
  EXPECT_GT(terrain().maps_to_rebuild, 0);
  EXPECT_NE(terrain().why_no_map.find("Below 3.0 m no map is made"), std::string::npos);
  EXPECT_EQ(terrain().applied, nullptr);
  EXPECT_TRUE(mission().IsRefused(refused.id));
  EXPECT_EQ(mission().armed->letter, flown.letter);

  Seek(record_->duration_s);
  EXPECT_EQ(terrain().why_no_map, "On the ground no map is made");
  EXPECT_EQ(terrain().applied, nullptr) << "no map is made of the ground it stands on";
  ASSERT_TRUE(mission().touchdown_miss_m.has_value());
  ASSERT_TRUE(mission().touchdown_miss_true_m.has_value());
  const double miss_m = *mission().touchdown_miss_m;
  const double true_miss_m = *mission().touchdown_miss_true_m;
  EXPECT_LT(miss_m, 1.0);
  for (const ChannelId camera : {ChannelId::kCameraLeft, ChannelId::kCameraRight}) {
    EXPECT_NE(FindChannel(engine_->Latest()->sensors->channels, camera)->state,
              ChannelHealth::State::kNever);
  }

  // Back above: maps again, the refused place is marked by the record.
  Seek(SecondsTo(*record_, low) - 15);
  EXPECT_EQ(terrain().why_no_map, "");
  const int missing = terrain().maps_to_rebuild;
  Play(2);
  EXPECT_LT(terrain().maps_to_rebuild, missing);

  // Played over the touchdown it says the same of its touchdown.
  Seek(SecondsTo(*record_, lands) - 0.5);
  Play(12);
  EXPECT_EQ(mission().touchdown_miss_m, miss_m);
  EXPECT_EQ(mission().touchdown_miss_true_m, true_miss_m);
}

}  // namespace
}  // namespace palace
