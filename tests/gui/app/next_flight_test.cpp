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

TEST(NextFlight, OneBegunInSimulateIsLookedAtThere) {
  NextFlight next;
  next.choice = FlightChoice{"rocks", 3, "multirotor"};
  const AppOptions chosen = OptionsOfNext(Flown(), next);
  EXPECT_EQ(chosen.workspace, Workspace::kSimulate);
  EXPECT_EQ(chosen.scenario, "rocks");
  EXPECT_FALSE(OptionsOfNext(chosen, {NextFlight::Kind::kReview, "a.lcm"}).workspace);
}

TEST(NextFlight, AfterTheReviewOfAFlightTheProgramIsWhatItWasStartedAs) {
  AppOptions bus;
  bus.source = SourceChoice::kConnect;
  bus.source_path = "memq://";
  bus.channels_file = "theirs.toml";
  bus.record = true;
  // The review of a flight does not change what the program was started with.
  EXPECT_EQ(OptionsOfNext(bus, {NextFlight::Kind::kReview, "a.lcm"}).source, SourceChoice::kReplay);
  const AppOptions again = OptionsOfNext(bus, {NextFlight::Kind::kFlyAgain, ""});
  EXPECT_EQ(again.source, SourceChoice::kConnect);
  EXPECT_EQ(again.source_path, "memq://");
  EXPECT_EQ(again.channels_file, "theirs.toml");
  EXPECT_TRUE(again.record);
}

TEST(NextFlight, AfterALogItIsTheBuiltInSimulationAsWithoutArguments) {
  for (const bool report : {true, false}) {
    AppOptions log;
    log.source = SourceChoice::kReplay;
    log.source_path = "a.lcm";
    log.replay_part = 2;
    log.settings.set = {"slad.max_slope_deg=6"};
    log.record = false;
    log.report = report;
    const AppOptions next = OptionsOfNext(log, {NextFlight::Kind::kFlyAgain, ""});
    EXPECT_EQ(next.source, SourceChoice::kSimulation);
    EXPECT_EQ(next.source_path, "");
    EXPECT_EQ(next.replay_part, 0);
    EXPECT_TRUE(next.settings.set.empty()) << "they judged the record";
    EXPECT_EQ(next.record, report) << "--no-record holds";
  }
}

TEST(NextFlight, TheWayOutOfAReviewSaysWhereItLeads) {
  const struct {
    SourceChoice source;
    const char* label;
    const char* hint;
  } table[] = {
      {SourceChoice::kSimulation, "New flight", "simulation"},
      {SourceChoice::kReplay, "New flight", "built-in simulation"},
      {SourceChoice::kConnect, "Back to live", "listens to the-path again"},
      {SourceChoice::kCameras, "Back to cameras", "opens the-path again"},
  };
  for (const auto& row : table) {
    AppOptions options;
    options.source = row.source;
    options.source_path = "the-path";
    EXPECT_EQ(WayOutOfReview(options).label, row.label);
    EXPECT_NE(WayOutOfReview(options).hint.find(row.hint), std::string::npos);
    EXPECT_NE(WayOutOfReview(options).hint.find("Ctrl+N"), std::string::npos);
  }
}

}  // namespace
}  // namespace palace
