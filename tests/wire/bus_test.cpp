// The bus in memory: a vehicle on one end, the station on the other.
#include "engine/wire/bus.h"

#include <gtest/gtest.h>

#include "engine/wire/lcm_link.h"
#include "engine/wire/lcm_source.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

class Recorder final : public VehicleLink {
 public:
  bool Send(const VehicleMessage& message) override {
    got.push_back(message);
    return true;
  }
  std::vector<VehicleMessage> got;
};

/// A station whose clock stands still: what arrives has no delay, so times come as they were sent.
LcmSourceOptions StoodStill() {
  return {.heartbeat_s = 60, .now_s = [] { return 50.0; }};
}

class BusTest : public ::testing::Test {
 protected:
  BusTest() {
    auto bus = Bus::Open("memq://");
    EXPECT_TRUE(bus.ok());
    bus_ = *bus;
  }
  std::shared_ptr<Bus> bus_;
};

TEST_F(BusTest, StationReceivesWhatTheVehicleMeasured) {
  RandomStream random(41);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  auto source = LcmSource::Create(bus_, {}, StoodStill());
  ASSERT_TRUE(source.ok());
  Recorder vehicle;
  auto server = VehicleServer::Create(bus_, vehicle);
  ASSERT_TRUE(server.ok());
  for (std::uint64_t i = 0; i < 5; ++i) {
    const auto sent = RandomBundle(random, i, rig);
    ASSERT_TRUE((*server)->Publish(*sent).ok());
    const auto got = (*source)->Next({});
    ASSERT_TRUE(got.ok());
    EXPECT_EQ((*got)->time, sent->time);
    ASSERT_NE((*got)->stereo, nullptr);
    EXPECT_EQ((*got)->stereo->left.pixels(), sent->stereo->left.pixels());
    EXPECT_EQ((*got)->imu.size(), sent->imu.size());
    EXPECT_EQ((*got)->sequence, i);
  }
  EXPECT_EQ((*source)->Lost(), Losses{});
  EXPECT_EQ((*source)->Status().kind, SourceKind::kLive);
  EXPECT_FALSE((*source)->IsLockstep());
}

TEST_F(BusTest, NewestPicturesWinAndNoSampleIsLost) {
  RandomStream random(42);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  auto source = LcmSource::Create(bus_, {}, StoodStill());
  ASSERT_TRUE(source.ok());
  Recorder vehicle;
  auto server = VehicleServer::Create(bus_, vehicle);
  std::size_t samples = 0;
  std::shared_ptr<FrameBundle> last;
  for (std::uint64_t i = 0; i < 8; ++i) {
    last = RandomBundle(random, i, rig);
    samples += last->imu.size();
    ASSERT_TRUE((*server)->Publish(*last).ok());
  }
  const auto got = (*source)->Next({});
  ASSERT_TRUE(got.ok());
  EXPECT_EQ((*got)->stereo->left.pixels(), last->stereo->left.pixels());
  EXPECT_EQ((*got)->imu.size(), samples);
  EXPECT_EQ((*got)->time, last->time);
  EXPECT_EQ((*source)->Lost().pairs_replaced, 7u);
}

TEST_F(BusTest, VehicleReceivesWhatTheStationSends) {
  Recorder vehicle;
  auto server = VehicleServer::Create(bus_, vehicle);
  ASSERT_TRUE(server.ok());
  LcmLink link(bus_);
  PositionEstimate estimate;
  estimate.time = {77};
  estimate.source = EstimateSource::kVision;
  estimate.healthy = true;
  estimate.p_WB = {1.5, -2.5, 0.1};
  link.Send(estimate);  // of no session: it stays here
  estimate.seal.session_id = 5;
  link.Send(estimate);
  Approval approval;
  approval.id = 9;
  link.Send(approval);
  link.Send(HoldRequest{10, "hold"});
  link.Send(AbortRequest{11, "abort"});
  ASSERT_TRUE((*server)->Poll(100).ok());
  ASSERT_EQ(vehicle.got.size(), 4u);
  EXPECT_EQ(std::get<PositionEstimate>(vehicle.got[0]).p_WB, estimate.p_WB);
  EXPECT_EQ(std::get<Approval>(vehicle.got[1]).id, 9u);
  EXPECT_EQ(std::get<HoldRequest>(vehicle.got[2]).reason, "hold");
  EXPECT_EQ(std::get<AbortRequest>(vehicle.got[3]).command_id, 11u);
  EXPECT_EQ(link.sent(), 4u);
  EXPECT_EQ(link.Unsent(), 0u);
}

TEST_F(BusTest, RubbishOnEveryChannelIsCountedAndHarmless) {
  auto source = LcmSource::Create(bus_, {}, {.heartbeat_s = 0.02});
  ASSERT_TRUE(source.ok());
  Recorder vehicle;
  auto server = VehicleServer::Create(bus_, vehicle);
  const ChannelNames names;
  for (const auto& channels : {names.FromVehicle(), names.ToVehicle()}) {
    for (const std::string& channel : channels) {
      ASSERT_TRUE(bus_->Publish({channel, {}, {1, 2, 3}}).ok());
    }
  }
  ASSERT_TRUE((*source)->Next({}).ok());
  ASSERT_TRUE((*server)->Poll(0).ok());
  const Losses lost = (*source)->Lost();
  EXPECT_EQ(lost.undecodable.size(), names.FromVehicle().size());
  for (const std::string& channel : names.FromVehicle()) {
    EXPECT_EQ(lost.undecodable.at(channel), 1u) << channel;
  }
  EXPECT_EQ((*server)->refused(), names.ToVehicle().size());
  EXPECT_TRUE(vehicle.got.empty());
}

TEST_F(BusTest, SilenceStillTells) {
  RandomStream random(43);
  auto source = LcmSource::Create(bus_, {}, {.heartbeat_s = 0.02});
  ASSERT_TRUE(source.ok());
  Recorder vehicle;
  auto server = VehicleServer::Create(bus_, vehicle);
  const auto sent = RandomBundle(random, 1, std::make_shared<StereoRig>(RandomRig(random)));
  ASSERT_TRUE((*server)->Publish(*sent).ok());
  ASSERT_TRUE((*source)->Next({}).ok());
  const auto quiet = (*source)->Next({});
  ASSERT_TRUE(quiet.ok());
  EXPECT_EQ((*quiet)->stereo, nullptr);
  EXPECT_GT((*quiet)->time, sent->time);
  EXPECT_FALSE((*quiet)->discontinuity);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_EQ((*source)->Next(stopped.get_token()).error().code, ErrorCode::kEnd);
}

TEST(BusUrl, GetsBufferAndTimeToLive) {
  struct Case {
    const char* given;
    const char* complete;
  };
  for (const Case& c :
       {Case{"", "udpm://239.255.76.67:7667?recv_buf_size=4194304&ttl=0"},
        Case{"udpm://239.1.1.1:5?ttl=1", "udpm://239.1.1.1:5?ttl=1&recv_buf_size=4194304"},
        Case{"udpm://239.1.1.1:5?recv_buf_size=9&ttl=2",
             "udpm://239.1.1.1:5?recv_buf_size=9&ttl=2"},
        Case{"memq://", "memq://"}}) {
    EXPECT_EQ(CompleteLcmUrl(c.given), c.complete);
  }
}

TEST(BusUrl, AUrlThatCannotBeOneIsRefusedWithAnExample) {
  for (const char* url :
       {"nonsense://", "nonsense", "udpm://host:7667", "udpm://10.0.0.1:7667",
        "udpm://239.255.76.67.1", "udpm://239.255.76.67:0", "udpm://239.255.76.67:port",
        "udpm://239.255.76.67:7667?ttl=many", "udpm://239.255.76.67:7667?recv_buf_size=-1",
        "tcpq://127.0.0.1:7700", "mpudpm://239.255.76.67:7667"}) {
    const auto bus = Bus::Open(url);
    ASSERT_FALSE(bus.ok()) << url;
    EXPECT_EQ(bus.error().code, ErrorCode::kUsage) << url;
    EXPECT_NE(bus.error().message.find("udpm://239.255.76.67:7667"), std::string::npos) << url;
  }
}

/// Through these liblcm would receive in this process, with none of our bounds.
TEST(BusUrl, OtherTransportsAreRefusedWithTheReason) {
  for (const char* url : {"tcpq://127.0.0.1:7700", "mpudpm://239.255.76.67", "file:///tmp/a.lcm"}) {
    EXPECT_NE(Bus::Open(url).error().message.find("only udpm is received with bounds"),
              std::string::npos)
        << url;
  }
}

TEST(BusUrl, TellsTheGroup) {
  const auto place = ParseBusUrl("udpm://239.1.2.3:5000?ttl=1&recv_buf_size=2000");
  ASSERT_TRUE(place.ok());
  EXPECT_EQ(place->group.ip, 0xef010203u);
  EXPECT_EQ(place->group.port, 5000);
  EXPECT_EQ(place->group.receive_buffer_bytes, 2000);
  EXPECT_EQ(ParseBusUrl("udpm://")->group.port, 7667);
}

}  // namespace
}  // namespace palace
