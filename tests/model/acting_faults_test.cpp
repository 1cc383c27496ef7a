#include <gtest/gtest.h>

#include "engine/model/mission/fault_events.h"

namespace palace {
namespace {

TEST(ActingFaults, AreThoseThatBeganAndHaveNotEnded) {
  const auto fault = [](const char* what, const char* words) {
    return Event{.time = {}, .kind = EventKind::kFault, .text = std::string(what) + words};
  };
  std::vector<Event> events = {fault(kFaultBegan, "GPS jump 3 m"),
                               {.time = {}, .kind = EventKind::kAlarm, .text = "GPS jump"},
                               fault(kFaultBegan, "laser stuck")};
  EXPECT_EQ(ActingFaults(events), (std::vector<std::string>{"GPS jump 3 m", "laser stuck"}));
  events.push_back(fault(kFaultEnded, "GPS jump 3 m"));
  EXPECT_EQ(ActingFaults(events), std::vector<std::string>{"laser stuck"});
  EXPECT_TRUE(ActingFaults({}).empty());
}

TEST(FaultEvents, TellWhatEndedThenWhatBeganAndNothingOfWhatGoesOn) {
  const auto events = FaultEvents({"laser stuck", "GPS jump 3 m"}, {"GPS jump 3 m", "x"}, {7});
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].text, "Fault ended: laser stuck");
  EXPECT_EQ(events[1].text, "Fault injected: x");
  EXPECT_EQ(events[1].time.us, 7);
  EXPECT_EQ(events[1].kind, EventKind::kFault);
}

}  // namespace
}  // namespace palace
