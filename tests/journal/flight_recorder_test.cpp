// What is written of a flight, in which order, and where it cannot be.
#include "engine/journal/log_index.h"
#include "engine/wire/convert.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

TEST_F(JournalTest, WhatWasGivenAndSentBetweenFramesIsInTheLog) {
  RandomStream random(62);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  auto recorder = FlightRecorder::Open(folder_, "flight");
  ASSERT_TRUE(recorder.ok());
  const auto between = [](std::uint64_t number) {
    RecordItem item;
    item.commands = {{CommandOrigin::kOperator, HoldHere{}}};
    item.sent.emplace_back(HoldRequest{number, "Held by the operator"});
    return item;
  };
  RecordItem frame;
  frame.bundle = RandomBundle(random, 0, rig);
  ASSERT_TRUE((*recorder)->Record(frame).ok());
  ASSERT_TRUE((*recorder)->Record(between(1)).ok());
  frame.bundle = RandomBundle(random, 1, rig);
  ASSERT_TRUE((*recorder)->Record(frame).ok());
  ASSERT_TRUE((*recorder)->Record(between(2)).ok());
  ASSERT_TRUE((*recorder)->Close().ok());
  auto log = LogFile::Open((*recorder)->Path());
  ASSERT_TRUE(log.ok());
  const auto index = BuildIndex(*log);
  ASSERT_TRUE(index.ok());
  std::string order;
  std::vector<std::uint64_t> holds;
  for (const LogEntry& entry : index->entries) {
    const auto message = ReadEvent(*log, entry, index->channels);
    ASSERT_TRUE(message.ok());
    if (message->channel == ChannelNames{}.camera_rig) {
      order += "frame ";
    } else if (message->channel == ChannelNames{}.site_decision) {
      order += "command ";
    } else if (message->channel == ChannelNames{}.command) {
      order += "sent ";
      holds.push_back(std::get<HoldRequest>(DecodeVehicleMessage(*message, {}).value()).command_id);
    }
  }
  EXPECT_EQ(order, "frame command sent frame command sent ");
  EXPECT_EQ(holds, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(JournalTest, UnwritableFolderLeavesNothingBehind) {
  WriteBytes(folder_ / "file", {1});
  const auto recorder = FlightRecorder::Open(folder_ / "file", "flight");
  ASSERT_FALSE(recorder.ok());
  EXPECT_EQ(recorder.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(recorder.error().message.find("--record DIR"), std::string::npos);
  const auto first = FlightRecorder::Open(folder_, "same");
  ASSERT_TRUE(first.ok());
  EXPECT_FALSE(FlightRecorder::Open(folder_, "same").ok());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "same" / "flight.lcm"));
}

}  // namespace
}  // namespace palace
