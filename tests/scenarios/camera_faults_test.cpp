// Cameras that fail in a descent: held or waved off in time, and never landed on ground that was
// not measured since. Whole flights; `palacectl evaluate faults` flies every fault and more seeds.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "engine/experiments/fault_flight.h"
#include "engine/faults/faulted_source.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"

namespace palace {
namespace {

struct Row {
  const char* fault;  ///< of FaultCases
  AlarmId cause;
  double within_s;  ///< the descent is stopped
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.fault; }

class CameraFaultInDescent : public testing::TestWithParam<Row> {};

TEST_P(CameraFaultInDescent, IsNamedAndStopsIt) {
  const auto cases = FaultCases();
  const auto fault = std::find_if(cases.begin(), cases.end(), [](const FaultCase& row) {
    return std::string(row.name) == GetParam().fault;
  });
  ASSERT_NE(fault, cases.end());
  const auto outcome =
      FlyUnderFault({.seed = 3}, *fault, FaultPhase::kDescent, MakeOffscreenSceneCamera);
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  ASSERT_TRUE(outcome->struck);
  EXPECT_TRUE(outcome->end == MissionState::kHold || outcome->end == MissionState::kAborting)
      << MissionStateName(outcome->end);
  EXPECT_LE(outcome->end_s, GetParam().within_s) << outcome->why;
  std::string raised;
  for (const RaisedAlarm& alarm : outcome->raised) {
    raised += alarm.text + "\n";
  }
  EXPECT_TRUE(std::any_of(outcome->raised.begin(), outcome->raised.end(),
                          [](const RaisedAlarm& alarm) { return alarm.id == GetParam().cause; }))
      << raised;
}

using Sees = std::function<bool(const EngineSnapshot&)>;

/// A descent in 3 m/s of wind that the fault strikes for 8 s from when `strikes` says so; `sees` is
/// asked of what follows, to 18 s after, until it says that it has seen enough.
void FlyAndStrike(FaultKind kind, const Sees& strikes, const Sees& sees) {
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 3, .wind_mps = 3}, MakeOffscreenSceneCamera).value();
  const auto source = std::make_shared<FaultedSource>(session.simulator, session.simulator, 3);
  EngineParts parts;
  parts.mission.session_id = session.id;
  parts.source = source;
  parts.link = source;
  Engine engine(std::move(parts), /*threaded=*/false);
  ScriptedOperator pilot;
  double struck_s = NAN;
  while (engine.Step() && !(source->now_s() > struck_s + 18) && source->now_s() < 120) {
    const auto snapshot = engine.Latest();
    if (!std::isnan(struck_s)) {
      if (sees(*snapshot)) {
        break;
      }
      continue;
    }
    if (snapshot->flight->mission.state == MissionState::kDescending && strikes(*snapshot)) {
      struck_s = source->now_s();
      Fault fault{.kind = kind};
      fault.from_s = struck_s + 1e-3;
      fault.to_s = struck_s + 8;
      EXPECT_TRUE(source->Add(fault).ok());
    }
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
  }
  EXPECT_FALSE(std::isnan(struck_s));
  EXPECT_EQ(engine.error(), "");
}

/// Largest distance of the estimate in force from the truth beyond its three sigmas, m, in a
/// descent whose cameras freeze from its third second on.
double EstimateBeyondItsSigmas_m() {
  double worst_m = 0;
  FlyAndStrike(
      FaultKind::kCameraFrozen,
      [](const EngineSnapshot& snapshot) {
        return SecondsBetween(snapshot.flight->mission.since, snapshot.time) > 3;
      },
      [&](const EngineSnapshot& snapshot) {
        const PositionEstimate& estimate = snapshot.flight->navigation.InForce().estimate;
        const Eigen::Vector3d off_m = estimate.p_WB - snapshot.sensors->truth->X_WB.p;
        for (int i = 0; i < 3; ++i) {
          worst_m = std::max(worst_m, std::abs(off_m[i]) - 3 * estimate.sigma_p_m[i]);
        }
        return false;
      });
  return worst_m;
}

TEST(FrozenCameras, TakeTheEstimateNowhere) { EXPECT_LT(EstimateBeyondItsSigmas_m(), 0.25); }

// No map is made there, and with the maps the judging of pictures once ended.
class CameraFaultNearTheGround : public testing::TestWithParam<std::pair<FaultKind, const char*>> {
};

TEST_P(CameraFaultNearTheGround, EndsTheDescentByItsName) {
  std::string why;
  FlyAndStrike(
      GetParam().first,
      [](const EngineSnapshot& snapshot) {
        return snapshot.flight->mission.height_above_site_m < 2.2;
      },
      [&](const EngineSnapshot& snapshot) {
        why = snapshot.flight->mission.why;
        return snapshot.flight->mission.state == MissionState::kAborting;
      });
  EXPECT_NE(why.find(GetParam().second), std::string::npos) << why;
}

INSTANTIATE_TEST_SUITE_P(
    , CameraFaultNearTheGround,
    testing::Values(std::pair(FaultKind::kCameraBlack, "(both cameras show nothing)"),
                    std::pair(FaultKind::kCameraFrozen, "(both cameras repeat their pictures)")),
    [](const auto& row) {
      return row.param.first == FaultKind::kCameraBlack ? "Black" : "Frozen";
    });

INSTANTIATE_TEST_SUITE_P(
    , CameraFaultInDescent,
    testing::Values(Row{"right camera black", AlarmId::kCameraBlank, 2.5},
                    Row{"both cameras black", AlarmId::kCameraBlank, 2.5},
                    Row{"right camera frozen", AlarmId::kCameraFrozen, 2.5},
                    Row{"both frozen but one pixel", AlarmId::kCameraFrozen, 2.5},
                    Row{"both frozen with 1 grey level of noise", AlarmId::kCameraFrozen, 2.5},
                    Row{"right camera missing", AlarmId::kCameraRight, 2.5},
                    Row{"cameras swapped", AlarmId::kCamerasSwapped, 2.5}),
    [](const auto& row) {
      std::string name = row.param.fault;
      std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
      return name;
    });

}  // namespace
}  // namespace palace
