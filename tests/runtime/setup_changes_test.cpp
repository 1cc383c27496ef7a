#include "engine/runtime/setup_changes.h"

#include <gtest/gtest.h>

#include "engine/core/text.h"

namespace palace {
namespace {

SimulationSetup Began() {
  SimulationSetup setup;
  for (const SimulationRow& row : SimulationTable()) {
    setup.*row.field = row.info.default_value;
  }
  return setup;
}

// A slider dragged over a second passes through ten values. What was set is told before what it
// brings about, and where it ended is always told.
TEST(SetupChanges, ADraggedSliderIsToldAtOnceAndWhereItEnded) {
  SetupChanges changes;
  SimulationSetup setup = Began();
  std::vector<std::string> told;
  for (int k = 0; k <= 50; ++k) {
    setup.wind_mps = k < 10 ? 0 : k < 20 ? 0.6 * (k - 9) : 6;
    for (const std::string& change : changes.Note(setup, AddSeconds({}, 0.1 * k))) {
      told.push_back(change + WithNumbers(" at %.1f s", 0.1 * k));
    }
  }
  EXPECT_EQ(told, (std::vector<std::string>{"Wind at 6 m, mean: 0.0 m/s to 0.6 m/s at 1.0 s",
                                            "Wind at 6 m, mean: 0.6 m/s to 6.0 m/s at 2.0 s"}));
}

TEST(SetupChanges, EveryRowIsToldAndWhatStandsIsNoChange) {
  SetupChanges changes;
  SimulationSetup setup = Began();
  EXPECT_TRUE(changes.Note(setup, AddSeconds({}, 0)).empty());
  EXPECT_TRUE(changes.Note(setup, AddSeconds({}, 9)).empty());
  for (const SimulationRow& row : SimulationTable()) {
    setup.*row.field += 10;
  }
  EXPECT_EQ(changes.Note(setup, AddSeconds({}, 10)).size(), SimulationTable().size());
  EXPECT_TRUE(changes.Note(setup, AddSeconds({}, 20)).empty());
}

TEST(SetupChanges, OfAFlightThatGoesOnTheLastToldCounts) {
  SetupChanges changes;
  changes.GoOnAfter(Began());
  SimulationSetup setup = Began();
  setup.rate_hz = 4;
  EXPECT_EQ(changes.Note(setup, AddSeconds({}, 5)),
            std::vector<std::string>{"Picture rate: 10 Hz to 4 Hz"});
}

}  // namespace
}  // namespace palace
