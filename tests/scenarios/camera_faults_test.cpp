// Cameras that fail in a descent: held or waved off in time, and never landed on ground that was
// not measured since. Whole flights; `palacectl evaluate faults` flies every fault and more seeds.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "engine/experiments/fault_flight.h"
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
