// A log is cut, repaired and described; what is left out is counted.
#include "engine/journal/log_tools.h"

#include "engine/journal/export.h"
#include "tests/journal/replay_flight.h"

namespace palace {
namespace {

TEST_F(ReplayTest, CutKeepsWholeBundlesAndReplays) {
  const auto cut = CutLog(flight_.log, folder_ / "cut.lcm", 0.35, 0.75);
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  auto source = ReplaySource::Open(folder_ / "cut.lcm", Fast());
  ASSERT_TRUE(source.ok()) << source.error().message;
  ASSERT_EQ((*source)->bundles().size(), 4u);
  for (std::size_t i = 4; i < 8; ++i) {
    const auto got = (*source)->Next({});
    EXPECT_EQ(Payloads(**got), Payloads(*flight_.items[i].bundle));
  }
}

TEST_F(ReplayTest, CutOfATimeThatTheLogHasNotIsRefusedAndLeavesNothing) {
  const std::filesystem::path out = folder_ / "cut.lcm";
  for (const auto& [from_s, to_s] :
       {std::pair(100.0, 200.0), {-5.0, -1.0}, {-5.0, 0.5}, {0.351, 0.352}}) {
    const auto cut = CutLog(flight_.log, out, from_s, to_s);
    ASSERT_FALSE(cut.ok()) << from_s;
    EXPECT_EQ(cut.error().code, ErrorCode::kUsage);
    EXPECT_FALSE(std::filesystem::exists(out)) << from_s;
    EXPECT_FALSE(std::filesystem::exists(out.string() + ".part")) << from_s;
  }
  ASSERT_TRUE(CutLog(flight_.log, out, 0.35, 0.75).ok());
  const auto bytes = ReadBytes(out);
  EXPECT_FALSE(CutLog(flight_.log, out, 0.35, 0.55).ok());
  EXPECT_EQ(ReadBytes(out), bytes) << "never overwritten";
  EXPECT_EQ(VerifyLog(*LogFile::Open(out))->report.unchecked, 0u) << "the sidecar came along";
}

TEST_F(ReplayTest, RepairKeepsEveryReadableEvent) {
  auto bytes = ReadBytes(flight_.log);
  const std::size_t events = BuildIndex(*LogFile::Open(flight_.log))->entries.size();
  bytes.resize(bytes.size() - 5);
  bytes.insert(bytes.begin(), 50, 0x11);
  WriteBytes(folder_ / "broken.lcm", bytes);
  const auto written = RepairLog(folder_ / "broken.lcm", folder_ / "whole.lcm");
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_EQ(written->events, events - 1);
  EXPECT_EQ(written->left_out, 0u) << "what is no event any more is said by the check of the log";
  const auto index = VerifyLog(*LogFile::Open(folder_ / "whole.lcm"));
  EXPECT_EQ(index->entries.size(), events - 1);
  EXPECT_FALSE(index->report.damaged());
}

/// A copy of a damaged log is no whole one: the numbers of its events tell what is lost.
TEST_F(ReplayTest, ACopyOfADamagedLogStillLacksItsEvents) {
  const auto index = BuildIndex(*LogFile::Open(flight_.log));
  const auto middle =
      index->entries.begin() + static_cast<std::ptrdiff_t>(index->entries.size() / 2);
  auto bytes = ReadBytes(flight_.log);
  for (const auto& lost : {middle[0], middle[1], middle[5]}) {
    bytes[lost.offset] ^= 1;
  }
  const auto log = folder_ / "broken.lcm";
  WriteBytes(log, bytes);
  ASSERT_TRUE(RepairLog(log, folder_ / "repaired.lcm").ok());
  const LogReport repaired = VerifyLog(*LogFile::Open(folder_ / "repaired.lcm"))->report;
  EXPECT_FALSE(repaired.damaged());
  EXPECT_EQ(repaired.number_jumps, 2u);
  EXPECT_EQ(repaired.unchecked, 0u);
  ASSERT_TRUE(CutLog(log, folder_ / "cut.lcm", 0, 0.25).ok());
  EXPECT_EQ(VerifyLog(*LogFile::Open(folder_ / "cut.lcm"))->report.number_jumps, 0u)
      << "nothing is lost before the damage";
}

TEST_F(ReplayTest, DescribesALogAndItsHealth) {
  const auto whole = DescribeLog(flight_.log, true);
  ASSERT_TRUE(whole.ok());
  EXPECT_FALSE(whole->report.damaged());
  EXPECT_EQ(whole->bundles, 12u);
  EXPECT_NEAR(whole->duration_s, 1.1, 1e-9);
  bool found = false;
  for (const ChannelSummary& row : whole->channels) {
    found = found || (row.name == "CAMERA_LEFT" && row.events == 12);
  }
  EXPECT_TRUE(found);
}

/// A simulated flight records ten readings of an IMU of 100 Hz with one time.
TEST_F(JournalTest, TheRateOfEventsThatCameTogetherIsThatOfTheChannel) {
  const std::filesystem::path log = folder_ / "bursts.lcm";
  auto writer = LogWriter::Create(log);
  for (int burst = 0; burst < 4; ++burst) {
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(
          writer->Write(EncodeEvent({{1'000'000 + 100'000 * burst}, EventKind::kState, "x"}, {})));
    }
  }
  ASSERT_TRUE(writer->Close().ok());
  const auto described = DescribeLog(log, false);
  ASSERT_TRUE(described.ok());
  ASSERT_EQ(described->channels.size(), 1u);
  EXPECT_DOUBLE_EQ(described->channels[0].rate_hz, 100);
}

/// One byte of a message differs under a sidecar that fits: nothing but the checksum tells.
TEST_F(JournalTest, WhatDiffersFromItsChecksumIsCountedByWhoeverLeavesItOut) {
  const std::filesystem::path log = folder_ / "bit.lcm";
  auto writer = LogWriter::Create(log);
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(writer->Write(EncodeEvent({{1'000'000 * (i + 1)}, EventKind::kState, "x"}, {})));
  }
  ASSERT_TRUE(writer->Close().ok());
  auto bytes = ReadBytes(log);
  bytes[bytes.size() - 2] ^= 1;  // the text of the last
  WriteBytes(log, bytes);
  const auto exported = ExportCsv(log, folder_ / "csv");
  ASSERT_TRUE(exported.ok()) << exported.error().message;
  EXPECT_EQ(exported->left_out, 1u);
  const auto repaired = RepairLog(log, folder_ / "repaired.lcm");
  ASSERT_TRUE(repaired.ok()) << repaired.error().message;
  EXPECT_EQ(repaired->events, 29u);
  EXPECT_EQ(repaired->left_out, 1u);
  const auto end = CutLog(log, folder_ / "end.lcm", 20, 100);
  EXPECT_EQ(end->left_out, 1u);
  const auto start = CutLog(log, folder_ / "start.lcm", 0, 10);
  EXPECT_EQ(start->left_out, 0u) << "only what was asked for";
}

}  // namespace
}  // namespace palace
