// A whole mission without a window: it lands, and its log decides the same again.
#include <optional>

#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/flight_summary.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kMissionLimit_s = 120;
constexpr double kReplayed_s = 12;  // of the log, and at least until the descent

/// An engine over the simulated mission, recorded into folder/flight.
std::unique_ptr<Engine> OpenMission(const std::filesystem::path& folder, std::uint64_t seed,
                                    std::shared_ptr<Simulator>& simulator) {
  const SimulatedSession session =
      OpenSimulatedSession({.seed = seed}, MakeOffscreenSceneCamera).value();
  EngineParts parts;
  parts.mission.session_id = session.id;
  simulator = session.simulator;
  parts.source = simulator;
  parts.link = simulator;
  auto recorder = FlightRecorder::Open(folder, "flight");
  EXPECT_TRUE(recorder.ok());
  parts.sink = std::move(*recorder);
  return std::make_unique<Engine>(std::move(parts), /*threaded=*/false);
}

/// What one engine pass decided.
struct Decision {
  Timestamp time;
  MissionState state = MissionState::kNoLive;
  std::uint64_t hash = 0;
  std::uint64_t map_hash = 0;
  bool operator==(const Decision&) const = default;
};

Decision DecisionOf(const EngineSnapshot& snapshot) {
  return {snapshot.time, snapshot.flight->mission.state, snapshot.decision_hash,
          snapshot.terrain->applied ? snapshot.terrain->applied->map_hash : 0};
}

std::vector<Decision> Replay(const std::filesystem::path& log, std::size_t most) {
  EngineParts parts;
  auto source = OpenLog(log);
  parts.settings = source->recorded()->settings_at_start;
  parts.source = std::move(source);
  Engine engine(std::move(parts), /*threaded=*/false);
  std::vector<Decision> decisions;
  while (decisions.size() < most && engine.Step()) {
    decisions.push_back(DecisionOf(*engine.Latest()));
  }
  EXPECT_EQ(engine.error(), "");
  return decisions;
}

/// Cells that may be over the slope limit.
int TooSteep(const EngineSnapshot& snapshot) {
  int count = 0;
  for (const auto reasons : snapshot.terrain->applied->hazards->reasons.cells()) {
    count += (reasons & kHazardSlope) != 0 ? 1 : 0;
  }
  return count;
}

/// The first pass whose decision differs; as many as there are when none does.
std::size_t FirstDifference(const std::vector<Decision>& a, const std::vector<Decision>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && a[i] == b[i]) {
    ++i;
  }
  return i;
}

using Mission = Scenario;

TEST_F(Mission, LandsOnTheSiteAndTheLogDecidesTheSameAgain) {
  constexpr std::uint64_t kSeed = 1;
  std::shared_ptr<Simulator> simulator;
  std::unique_ptr<Engine> engine = OpenMission(folder_, kSeed, simulator);
  FlightSummarizer summarizer(MakeScene("runway", kSeed).value());
  ScriptedOperator pilot;
  std::vector<Decision> flown;
  while (engine->Step() && !pilot.finished() && summarizer.summary().duration_s < kMissionLimit_s) {
    const auto snapshot = engine->Latest();
    summarizer.Add(*snapshot);
    flown.push_back(DecisionOf(*snapshot));
    EXPECT_EQ(snapshot->session->limits_apply == LimitsApply::kNotNow,
              snapshot->flight->mission.state == MissionState::kDescending);
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine->Post(command);
    }
  }
  ASSERT_EQ(engine->error(), "");
  ASSERT_TRUE(engine->Stop().ok());
  const FlightSummary& summary = summarizer.summary();
  ASSERT_EQ(summary.final_state, MissionState::kLanded)
      << "seed " << kSeed << ": " << engine->Latest()->flight->mission.why;
  ASSERT_TRUE(summary.touchdown_miss_m.has_value());
  EXPECT_LE(*summary.touchdown_miss_m, 0.5) << "seed " << kSeed;
  ASSERT_TRUE(summary.site_obstacle_distance_m.has_value());
  EXPECT_GE(*summary.site_obstacle_distance_m, summary.lander_radius_m) << "seed " << kSeed;

  const std::filesystem::path log = folder_ / "flight" / "flight.lcm";
  const auto record = OpenLog(log)->recorded();
  ASSERT_GE(record->samples.size(), flown.size());
  std::size_t compared = 0;
  bool approved = false;
  for (; compared < flown.size(); ++compared) {
    const FlightRecordSample& sample = record->samples[compared];
    ASSERT_EQ(sample.time, flown[compared].time) << compared;
    ASSERT_EQ(sample.decision_hash, flown[compared].hash) << compared;
    approved = approved || sample.state == MissionState::kDescending;
    if (approved && SecondsBetween(flown.front().time, sample.time) > kReplayed_s) {
      break;
    }
  }
  ASSERT_TRUE(approved) << "the stretch to replay holds no approval";
  flown.resize(compared);
  const std::vector<Decision> first = Replay(log, compared);
  const std::vector<Decision> second = Replay(log, compared);
  ASSERT_EQ(first.size(), compared);
  EXPECT_EQ(FirstDifference(first, second), compared);
  const std::size_t same = FirstDifference(first, flown);
  EXPECT_EQ(same, compared) << "the replay leaves the flight at pass " << same << ": "
                            << MissionStateName(first[std::min(same, compared - 1)].state)
                            << " instead of "
                            << MissionStateName(flown[std::min(same, compared - 1)].state);
}

TEST_F(Mission, NothingIsLeftBehindWithoutARecord) {
  WriteFile("look.script", "wait state PROPOSED 20\nquit\n");
  const ProcessResult result =
      RunProcess(Palace({"--headless", "--no-record", "--script", "look.script"}), 120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("Files:"), std::string::npos) << result.out;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().filename(), "look.script");
  }
}

TEST_F(Mission, AMovedLimitDecidesInThePassItArrivesAndInTheReplay) {
  std::shared_ptr<Simulator> simulator;
  std::unique_ptr<Engine> engine = OpenMission(folder_, 1, simulator);
  std::vector<Decision> flown;
  const auto step = [&] {
    ASSERT_TRUE(engine->Step()) << engine->error();
    flown.push_back(DecisionOf(*engine->Latest()));
  };
  while (!(flown.size() > 10 && engine->Latest()->terrain->applied)) {
    step();
  }
  const auto before = engine->Latest();
  constexpr double limit_deg = 0.5;
  engine->Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", limit_deg}});
  step();
  const auto moved = engine->Latest();
  ASSERT_EQ(moved->session->settings.slad.limits.max_slope_deg, limit_deg);
  EXPECT_EQ(moved->terrain->applied->settings.limits.max_slope_deg, limit_deg);
  EXPECT_NE(moved->terrain->applied->settings_hash, before->terrain->applied->settings_hash);
  EXPECT_GT(TooSteep(*moved), TooSteep(*before));
  step();

  // While time stands still a limit moves as well, and is recorded all the same.
  engine->Control({PlaybackControl::Kind::kPause, 0});
  engine->Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 9}});
  ASSERT_TRUE(engine->Step());
  EXPECT_EQ(engine->Latest()->terrain->applied->settings.limits.max_slope_deg, 9);
  EXPECT_EQ(engine->Latest()->time, flown.back().time);
  engine->Control({PlaybackControl::Kind::kPlay, 0});
  for (int i = 0; i < 5; ++i) {
    step();
  }
  ASSERT_TRUE(engine->Stop().ok());

  const std::filesystem::path log = folder_ / "flight" / "flight.lcm";
  std::vector<double> recorded;
  const auto source = OpenLog(log);
  for (auto bundle = source->Next({}); bundle; bundle = source->Next({})) {
    for (const EngineCommand& command : (*bundle)->recorded_commands) {
      const auto* set = std::get_if<SetSetting>(&command.action);
      ASSERT_NE(set, nullptr);
      EXPECT_EQ(set->name, "slad.max_slope_deg");
      recorded.push_back(set->value);
    }
  }
  EXPECT_EQ(recorded, (std::vector<double>{limit_deg, 9}));
  const std::vector<Decision> again = Replay(log, flown.size());
  ASSERT_EQ(again.size(), flown.size());
  EXPECT_EQ(FirstDifference(again, flown), flown.size());
}

TEST_F(Mission, AStepTakenBetweenFramesIsReplayedAsFlown) {
  // On a busy machine a frame comes late and what the operator does is applied before it; the log
  // hands it over with that frame.
  std::shared_ptr<Simulator> simulator;
  std::unique_ptr<Engine> engine = OpenMission(folder_, 1, simulator);
  std::vector<Decision> flown;
  const auto step_until = [&](MissionState state) {
    while (flown.size() < 200) {
      ASSERT_TRUE(engine->Step()) << engine->error();
      flown.push_back(DecisionOf(*engine->Latest()));
      if (engine->Latest()->flight->mission.state == state) {
        return;
      }
    }
    FAIL() << MissionStateName(engine->Latest()->flight->mission.state);
  };
  const auto between_frames = [&](CommandAction action) {
    engine->Control({PlaybackControl::Kind::kPause, 0});
    engine->Post({CommandOrigin::kOperator, std::move(action)});
    ASSERT_TRUE(engine->Step());
    ASSERT_EQ(engine->Latest()->time, flown.back().time);
    engine->Control({PlaybackControl::Kind::kPlay, 0});
  };
  step_until(MissionState::kProposed);
  EXPECT_EQ(engine->Latest()->session->limits_apply, LimitsApply::kAtOnce);
  between_frames(SelectSite{engine->Latest()->terrain->applied->selection.sites.at(0).id});
  ASSERT_EQ(engine->Latest()->flight->mission.state, MissionState::kArmed);
  EXPECT_EQ(engine->Latest()->session->limits_apply, LimitsApply::kWhenApplied);
  EXPECT_TRUE(engine->Latest()->session->apply_drops);
  for (int i = 0; i < 5; ++i) {
    step_until(MissionState::kArmed);
  }
  between_frames(WaveOff{});
  step_until(MissionState::kAborting);
  ASSERT_TRUE(engine->Stop().ok());
  const std::vector<Decision> again = Replay(folder_ / "flight" / "flight.lcm", flown.size());
  ASSERT_EQ(again.size(), flown.size());
  EXPECT_EQ(FirstDifference(again, flown), flown.size());
}

}  // namespace
}  // namespace palace
