// The experiment of faults on a few of its cases: what the monitors say is what stands on the
// screen and in the record, and approve is blocked. All cases: palacectl evaluate faults.
#include <gmock/gmock.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "engine/experiments/fault_flight.h"
#include "gui/platform/offscreen_scene_camera.h"

namespace palace {
namespace {

struct Row {
  const char* fault;
  FaultPhase phase = FaultPhase::kArmed;
  FaultFlight flight{.wind_mps = 4, .seed = 3};
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.fault; }
class Faults : public testing::TestWithParam<Row> {};

TEST_P(Faults, AreNamedAndRecordedAndStopWhatTheyMust) {
  const std::span<const FaultCase> cases = FaultCases();
  const auto fault = std::find_if(cases.begin(), cases.end(), [](const FaultCase& row) {
    return row.name == std::string(GetParam().fault);
  });
  ASSERT_NE(fault, cases.end());
  const Result<FaultOutcome> outcome =
      FlyUnderFault(GetParam().flight, *fault, GetParam().phase, MakeOffscreenSceneCamera);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_THAT(Shortfalls(*fault, GetParam().phase, *outcome), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    , Faults,
    testing::Values(Row{"laser stuck"}, Row{"GPS jumps by 8 m"}, Row{"attitude shifted by 0.3 s"},
                    Row{"attitude rolled by 3 deg"},
                    // Down to the ground, where stereo gives no depth any more.
                    Row{"clock gains 1 %", FaultPhase::kDescent, {.wind_mps = 3, .seed = 1}}),
    [](const auto& row) {
      std::string name = row.param.fault;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == ' ' || c == '.' || c == '%'; }, '_');
      return name;
    });

TEST(FaultCases, EachHasANameOfItsOwnAndFaultsThatCanBe) {
  std::set<std::string> names;
  for (const FaultCase& row : FaultCases()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(std::string(row.name).find_first_of(",\r\n"), std::string::npos)
        << row.name << ": it is a cell of a CSV";
    EXPECT_TRUE(row.silent || !row.cause.empty() || std::string(row.row) == "F21") << row.name;
    for (const Fault& fault : row.faults) {
      EXPECT_TRUE(CheckFault(fault)) << row.name;
    }
  }
}

TEST(FaultCases, EveryKindIsFlown) {
  std::set<FaultKind> flown;
  for (const FaultCase& row : FaultCases()) {
    for (const Fault& fault : row.faults) {
      flown.insert(fault.kind);
    }
  }
  for (const FaultKindRow& row : FaultKindTable()) {
    EXPECT_TRUE(flown.contains(row.kind)) << row.name << " has no case in fault_cases.cpp";
  }
}

}  // namespace
}  // namespace palace
