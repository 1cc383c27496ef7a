// Logs: what is written is read, by us and by liblcm; damage costs the damaged event only.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstring>
#include <functional>
#include <map>

#include <lcm/lcm.h>

#include "engine/journal/big_endian.h"
#include "engine/journal/checksum.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_reader.h"
#include "tests/journal/journal_world.h"

namespace palace {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Crc32c, CheckValueOfTheStandard) {
  EXPECT_EQ(Crc32c(0, "123456789", 9), 0xE3069283u);
  EXPECT_EQ(Crc32c(Crc32c(0, "1234", 4), "56789", 5), 0xE3069283u);
  const Bytes zeros(32, 0);
  EXPECT_EQ(Crc32c(0, zeros.data(), 32), 0x8A9136AAu);  // RFC 3720, B.4
}

class LogTest : public JournalTest {
 protected:
  /// 100 events, small and large mixed, payloads that tell their number.
  LogTest() : path_(folder_ / "a.lcm") {
    RandomStream random(51);
    auto writer = LogWriter::Create(path_);
    EXPECT_TRUE(writer.ok()) << writer.error().message;
    for (int i = 0; i < 100; ++i) {
      WireMessage message{i % 5 == 0 ? "CAMERA_LEFT" : "IMU", {1'000'000 + 10'000 * i}, {}};
      message.payload.resize(i % 5 == 0 ? 6000 : 100);
      for (std::uint8_t& byte : message.payload) {
        byte = static_cast<std::uint8_t>(random.NextBits());
      }
      messages_.push_back(message);
      EXPECT_TRUE(writer->Write(message).ok());
    }
    EXPECT_TRUE(writer->Close().ok());
    bytes_ = ReadBytes(path_);
    std::uint64_t at = 0;
    for (const WireMessage& message : messages_) {
      offsets_.push_back(at);
      at += kLogHeaderBytes + message.channel.size() + message.payload.size();
    }
  }

  /// Events of a damaged copy (without sidecar) that are byte for byte those written.
  int Recovered(const Bytes& damaged, LogReport* report = nullptr) {
    const std::filesystem::path copy = folder_ / "damaged.lcm";
    WriteBytes(copy, damaged);
    const auto file = LogFile::Open(copy);
    EXPECT_TRUE(file.ok());
    const auto index = BuildIndex(*file);
    if (!index) {
      return 0;
    }
    std::map<std::int64_t, Bytes> wanted;
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      wanted[messages_[i].time.us] = messages_[i].payload;
    }
    int good = 0;
    for (const LogEntry& entry : index->entries) {
      const auto message = ReadEvent(*file, entry, index->channels);
      if (message && wanted.count(message->time.us) &&
          wanted[message->time.us] == message->payload) {
        ++good;
        wanted.erase(message->time.us);
      }
    }
    if (report != nullptr) {
      *report = index->report;
    }
    return good;
  }

  std::filesystem::path path_;
  std::vector<WireMessage> messages_;
  std::vector<std::uint64_t> offsets_;
  Bytes bytes_;
};

TEST_F(LogTest, ReadsBackWhatWasWritten) {
  for (const bool with_sidecar : {true, false}) {
    if (!with_sidecar) {
      std::filesystem::remove(SidecarPath(path_));
    }
    const auto file = LogFile::Open(path_);
    const auto index = BuildIndex(*file);
    ASSERT_TRUE(index.ok()) << index.error().message;
    ASSERT_EQ(index->entries.size(), messages_.size());
    EXPECT_EQ(index->report.unchecked, with_sidecar ? 0 : messages_.size());
    EXPECT_FALSE(index->report.damaged());
    EXPECT_EQ(index->report.number_jumps, 0u);
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      EXPECT_EQ(index->entries[i].offset, offsets_[i]);
      const auto message = ReadEvent(*file, index->entries[i], index->channels);
      ASSERT_TRUE(message.ok()) << message.error().message;
      EXPECT_EQ(message->channel, messages_[i].channel);
      EXPECT_EQ(message->time, messages_[i].time);
      EXPECT_EQ(message->payload, messages_[i].payload);
    }
  }
}

TEST_F(LogTest, StockReaderReadsAllOfIt) {
  lcm_eventlog_t* log = lcm_eventlog_create(path_.c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::size_t count = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    ASSERT_LT(count, messages_.size());
    const WireMessage& wanted = messages_[count];
    EXPECT_EQ(event->eventnum, static_cast<std::int64_t>(count));
    EXPECT_EQ(event->timestamp, wanted.time.us);
    EXPECT_EQ(event->channel, wanted.channel);
    ASSERT_EQ(static_cast<std::size_t>(event->datalen), wanted.payload.size());
    EXPECT_EQ(std::memcmp(event->data, wanted.payload.data(), wanted.payload.size()), 0);
    lcm_eventlog_free_event(event);
    ++count;
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(count, messages_.size());
}

TEST_F(LogTest, ReadsWhatTheStockWriterWrote) {
  const std::filesystem::path stock = folder_ / "stock.lcm";
  lcm_eventlog_t* log = lcm_eventlog_create(stock.c_str(), "w");
  ASSERT_NE(log, nullptr);
  for (WireMessage& message : messages_) {
    lcm_eventlog_event_t event{};
    event.timestamp = message.time.us;
    event.channellen = static_cast<std::int32_t>(message.channel.size());
    event.channel = message.channel.data();
    event.datalen = static_cast<std::int32_t>(message.payload.size());
    event.data = message.payload.data();
    ASSERT_EQ(lcm_eventlog_write_event(log, &event), 0);
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(ReadBytes(stock), bytes_) << "our writer's bytes differ from liblcm's";
}

/// The damages of reliability 1.2, around event 50 of 100.
TEST_F(LogTest, DamageCostsTheDamagedEventOnly) {
  const std::size_t at = offsets_[50];
  const std::size_t next = offsets_[51];
  const auto set32 = [](Bytes& b, std::size_t offset, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
      b[offset + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
    }
  };
  const auto channel_length = [&](std::uint32_t v) {
    return [=](Bytes& b) { set32(b, at + 20, v); };
  };
  const auto data_length = [&](std::uint32_t v) { return [=](Bytes& b) { set32(b, at + 24, v); }; };
  const auto erase = [](Bytes& b, std::size_t from, std::size_t count) {
    b.erase(b.begin() + static_cast<std::ptrdiff_t>(from),
            b.begin() + static_cast<std::ptrdiff_t>(from + count));
  };
  struct Case {
    const char* name;
    std::function<void(Bytes&)> damage;
    int at_least;
  };
  const std::uint32_t true_length = static_cast<std::uint32_t>(messages_[50].payload.size());
  const Case cases[] = {
      {"untouched", [](Bytes&) {}, 100},
      {"cut in the sync of the last event", [&](Bytes& b) { b.resize(offsets_[99] + 2); }, 99},
      {"cut in its header", [&](Bytes& b) { b.resize(offsets_[99] + 20); }, 99},
      {"cut in its channel", [&](Bytes& b) { b.resize(offsets_[99] + 29); }, 99},
      {"cut in its payload", [&](Bytes& b) { b.resize(b.size() - 10); }, 99},
      {"sync flipped", [&](Bytes& b) { b[at] ^= 0x10; }, 99},
      {"sync zeroed", [&](Bytes& b) { set32(b, at, 0); }, 99},
      {"first sync flipped", [&](Bytes& b) { b[0] ^= 1; }, 99},
      {"last sync flipped", [&](Bytes& b) { b[offsets_[99]] ^= 1; }, 99},
      {"channel length 0", channel_length(0), 99},
      {"channel length -1", channel_length(0xFFFFFFFF), 99},
      {"channel length 999", channel_length(999), 99},
      {"channel length 2^31-1", channel_length(0x7FFFFFFF), 99},
      {"channel length 12", channel_length(12), 99},
      {"data length -1", data_length(0xFFFFFFFF), 99},
      {"data length -2^31", data_length(0x80000000), 99},
      {"data length +1", data_length(true_length + 1), 99},
      {"data length -1 byte", data_length(true_length - 1), 99},
      {"data length 0", data_length(0), 99},
      {"data length to just past the next event", data_length(true_length + 140), 99},
      {"data length 256 MiB", data_length(256u << 20), 99},
      {"data length 1 GiB", data_length(1u << 30), 99},
      {"data length 2^31-1", data_length(0x7FFFFFFF), 99},
      {"777 junk bytes before",
       [&](Bytes& b) { b.insert(b.begin() + static_cast<std::ptrdiff_t>(at), 777, 0x5A); }, 100},
      {"100 junk bytes at the start", [](Bytes& b) { b.insert(b.begin(), 100, 0xED); }, 100},
      {"10 bytes removed", [&](Bytes& b) { erase(b, at + 40, 10); }, 99},
      {"512 zero bytes in a payload",
       [&](Bytes& b) { std::fill_n(b.begin() + static_cast<std::ptrdiff_t>(at) + 60, 512, 0); },
       99},
      {"sync lost and a look-alike header in the payload",
       [&](Bytes& b) {
         std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(offsets_[1]), 60,
                     b.begin() + static_cast<std::ptrdiff_t>(at) + 500);
         b[next] ^= 0xFF;
       },
       98},
      {"channel byte not printable", [&](Bytes& b) { b[at + 28] = 7; }, 99},
  };
  ASSERT_EQ(messages_[50].payload.size(), 6000u);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Bytes damaged = bytes_;
    c.damage(damaged);
    EXPECT_GE(Recovered(damaged), c.at_least);
  }
}

TEST_F(LogTest, ReportTellsWhereDamageLies) {
  Bytes damaged = bytes_;
  damaged[offsets_[50]] ^= 1;
  LogReport report;
  Recovered(damaged, &report);
  EXPECT_TRUE(report.damaged());
  EXPECT_EQ(report.events, 99u);
  EXPECT_EQ(report.suspect, 0u);
  EXPECT_EQ(report.skipped_bytes, offsets_[51] - offsets_[50]);
  ASSERT_EQ(report.gaps.size(), 1u);
  EXPECT_EQ(report.gaps[0].offset, offsets_[50]);
  EXPECT_EQ(report.number_jumps, 1u);
}

TEST_F(LogTest, SidecarFindsAFlippedPayloadBit) {
  Bytes damaged = bytes_;
  damaged[offsets_[50] + 1000] ^= 4;
  WriteBytes(path_, damaged);
  const auto file = LogFile::Open(path_);
  const auto index = VerifyLog(*file);
  ASSERT_TRUE(index.ok());
  EXPECT_EQ(index->report.checksum_errors, 1u);
  EXPECT_EQ(index->report.events, 100u);
  EXPECT_FALSE(ReadEvent(*file, index->entries[50], index->channels).ok());
  EXPECT_TRUE(ReadEvent(*file, index->entries[51], index->channels).ok());
}

TEST_F(LogTest, SidecarOfAShorterOrOtherLogDoesNotMislead) {
  Bytes cut(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(offsets_[60] + 5));
  WriteBytes(path_, cut);
  auto index = BuildIndex(*LogFile::Open(path_));
  EXPECT_EQ(index->entries.size(), 60u);
  EXPECT_EQ(index->report.missing_events, 40u);
  Bytes shifted = bytes_;
  shifted.insert(shifted.begin(), 7, 0);
  WriteBytes(path_, shifted);
  index = BuildIndex(*LogFile::Open(path_));
  EXPECT_EQ(index->entries.size(), 100u);
  EXPECT_EQ(index->report.skipped_bytes, 7u);
}

TEST_F(LogTest, EventsBeyondATornSidecarAreFound) {
  Bytes sidecar = ReadBytes(SidecarPath(path_));
  sidecar.resize(sidecar.size() / 2 + 3);
  WriteBytes(SidecarPath(path_), sidecar);
  const auto index = BuildIndex(*LogFile::Open(path_));
  EXPECT_EQ(index->entries.size(), 100u);
  EXPECT_TRUE(index->entries.front().has_crc);
  EXPECT_FALSE(index->entries.back().has_crc);
  EXPECT_FALSE(index->report.damaged());
}

TEST_F(LogTest, VerifySaysWhatItCouldNotCheckAndWhy) {
  RandomStream random(53);
  const Bytes good = ReadBytes(SidecarPath(path_));
  Bytes half(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.size() / 2));
  Bytes garbage(good.size());
  for (std::uint8_t& byte : garbage) {
    byte = static_cast<std::uint8_t>(random.NextBits());
  }
  Bytes torn = good;
  torn.resize(torn.size() - 3);
  // Of another flight: as many events of the same lengths at the same places, or quite different.
  const auto other = [&](int seconds, std::size_t size) {
    const std::filesystem::path path = folder_ / ("other" + std::to_string(seconds) + ".lcm");
    auto writer = LogWriter::Create(path);
    for (const WireMessage& message : messages_) {
      WireMessage altered = message;
      altered.time.us += 1'000'000 * seconds;
      altered.payload[0] ^= 1;
      altered.payload.resize(size > 0 ? size : altered.payload.size());
      EXPECT_TRUE(writer->Write(altered).ok());
    }
    EXPECT_TRUE(writer->Close().ok());
    return ReadBytes(SidecarPath(path));
  };
  struct Case {
    const char* name;
    Bytes sidecar;
    std::uint64_t unchecked_at_least;
    const char* says;
    bool seen_by_info;  ///< which reads headers only
  };
  const Case cases[] = {{"good", good, 0, "", true},
                        {"half", half, 40, "cut or damaged after", true},
                        {"torn in its last record", torn, 1, "cut or damaged after 99", true},
                        {"garbage", garbage, 100, "is none, or damaged", true},
                        {"empty", {}, 100, "is none, or damaged", true},
                        {"another flight", other(7, 0), 100, "of another log", true},
                        {"another layout", other(9, 50), 100, "of another log", true},
                        {"the same times, other bytes", other(0, 0), 100, "of another log", false}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    WriteBytes(SidecarPath(path_), c.sidecar);
    const auto checked = VerifyLog(*LogFile::Open(path_)),
               looked = BuildIndex(*LogFile::Open(path_));
    ASSERT_TRUE(checked.ok() && looked.ok());
    EXPECT_EQ(checked->entries.size(), 100u);
    EXPECT_FALSE(checked->report.damaged());
    EXPECT_GE(checked->report.unchecked, c.unchecked_at_least);
    EXPECT_EQ(checked->report.unchecked == 0, std::string(c.says).empty());
    EXPECT_NE(checked->report.sidecar_problem.find(c.says), std::string::npos)
        << checked->report.sidecar_problem;
    if (c.seen_by_info) {
      EXPECT_EQ(looked->report.sidecar_problem, checked->report.sidecar_problem);
    }
  }
  std::filesystem::remove(SidecarPath(path_));
  EXPECT_EQ(VerifyLog(*LogFile::Open(path_))->report.sidecar_problem, "there is no sidecar");
}

TEST_F(LogTest, RandomDamageNeverCrashesOrHangs) {
  constexpr std::uint64_t kSeed = 52;
  std::printf("seed %d\n", static_cast<int>(kSeed));
  RandomStream random(kSeed);
  int recovered = 0;
  for (int round = 0; round < 40; ++round) {
    Bytes damaged = bytes_;
    const int changes = 1 + random.Index(200);
    for (int i = 0; i < changes; ++i) {
      const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(damaged.size())));
      damaged[at] = static_cast<std::uint8_t>(random.NextBits());
    }
    recovered += Recovered(damaged);
  }
  EXPECT_GT(recovered, 40 * 40);
}

TEST_F(LogTest, CancelsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  LogScan scan;
  ScanLog(*LogFile::Open(path_), 0, scan, stop.get_token());
  EXPECT_TRUE(scan.report.cancelled);
  EXPECT_TRUE(scan.entries.empty());
}

TEST_F(LogTest, WhatIsNoLogSaysSoWithPathAndRemedy) {
  WriteBytes(folder_ / "empty.lcm", {});
  WriteBytes(folder_ / "text.lcm", Bytes(5000, 'x'));
  WriteBytes(folder_ / "sync.lcm", {0xED, 0xA1, 0xDA, 0x01});
  ASSERT_EQ(::mkfifo((folder_ / "pipe.lcm").c_str(), 0600), 0);
  struct Case {
    std::string name;
    std::string says;
  };
  for (const Case& c :
       {Case{"missing.lcm", "check the name"}, Case{"", "is a folder"},
        Case{"pipe.lcm", "no regular file"}, Case{"empty.lcm", "is empty"},
        Case{"text.lcm", "no LCM event log"}, Case{"sync.lcm", "no LCM event log"}}) {
    const std::filesystem::path path = c.name.empty() ? folder_ : folder_ / c.name;
    const auto file = LogFile::Open(path);
    const std::string message = file ? BuildIndex(*file).error().message : file.error().message;
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    EXPECT_NE(message.find(c.says), std::string::npos) << message;
  }
}

TEST_F(LogTest, WriterRefusesToOverwrite) {
  const auto again = LogWriter::Create(path_);
  ASSERT_FALSE(again.ok());
  EXPECT_NE(again.error().message.find("never overwritten"), std::string::npos);
  EXPECT_EQ(ReadBytes(path_), bytes_);
}

TEST_F(LogTest, FullDeviceIsReportedNotSwallowed) {
  // liblcm's writer returned success 800 times of 1,000 here (reference: reliability 1.3).
  std::filesystem::create_symlink("/dev/full", folder_ / "full.lcm");
  auto file = OutputFile::Create(folder_ / "full.lcm");
  EXPECT_FALSE(file.ok());  // exists: never written to
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = ::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = before;
  small.rlim_cur = 3000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  auto writer = LogWriter::Create(folder_ / "small.lcm");
  Status last = Ok();
  for (int i = 0; i < 100 && last; ++i) {
    last = writer->Write(messages_[1]);
    last = last ? writer->Flush() : last;
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, ignored);
  ASSERT_FALSE(last.ok());
  EXPECT_NE(last.error().message.find("small.lcm: cannot be written"), std::string::npos)
      << last.error().message;
  static_cast<void>(writer->Close().ok());
  const auto index = BuildIndex(*LogFile::Open(folder_ / "small.lcm"));
  ASSERT_TRUE(index.ok());
  EXPECT_GT(index->entries.size(), 10u);
}

}  // namespace
}  // namespace palace
