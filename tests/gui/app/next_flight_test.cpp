// What the station is started anew with.
#include <gtest/gtest.h>

#include "gui/app/app.h"

namespace palace {
namespace {

AppOptions Flown() {
  AppOptions options;
  options.source = SourceChoice::kSimulation;
  options.record = true;
  options.script_file = "flight.txt";
  return options;
}

TEST(NextFlight, AReviewShowsTheLogAndRecordsNoFlight) {
  const AppOptions next = OptionsOfNext(Flown(), {NextFlight::Kind::kReview, "logs/a/flight.log"});
  EXPECT_EQ(next.source, SourceChoice::kReplay);
  EXPECT_EQ(next.source_path, "logs/a/flight.log");
  EXPECT_FALSE(next.record);
  EXPECT_EQ(next.script_file, "");
}

TEST(NextFlight, AnotherPartOfALogIsReadAsTheFirst) {
  AppOptions options;
  options.source = SourceChoice::kReplay;
  options.source_path = "theirs.lcm";
  options.channels_file = "theirs.toml";
  const AppOptions next = OptionsOfNext(options, {NextFlight::Kind::kReview, "theirs.lcm", 2});
  EXPECT_EQ(next.source_path, "theirs.lcm");
  EXPECT_EQ(next.replay_part, 2);
  EXPECT_EQ(next.channels_file, "theirs.toml");
}

TEST(NextFlight, AnotherFlightIsFlownAndRecordedAsTheFirst) {
  const AppOptions next = OptionsOfNext(Flown(), {NextFlight::Kind::kFlyAgain, ""});
  EXPECT_EQ(next.source, SourceChoice::kSimulation);
  EXPECT_TRUE(next.record);
}

}  // namespace
}  // namespace palace
