// Bundles survive the wire to the bit; lost, foreign and broken messages cost only themselves.
#include <gtest/gtest.h>

#include "engine/wire/convert.h"
#include "engine/wire/sensor_messages.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

using Bundles = std::vector<std::shared_ptr<const FrameBundle>>;

Bundles PushAll(BundleAssembler& assembler, const std::vector<WireMessage>& messages) {
  Bundles bundles;
  for (const WireMessage& message : messages) {
    for (auto& bundle : assembler.Push(message)) {
      bundles.push_back(bundle);
    }
  }
  return bundles;
}

void ExpectSame(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  ASSERT_EQ(a.size(), b.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(SameBits(a.data()[i], b.data()[i])) << a.data()[i] << " and " << b.data()[i];
  }
}

void ExpectSame(const VehiclePose& a, const VehiclePose& b) {
  EXPECT_EQ(a.time, b.time);
  ExpectSame(a.X_WB.R, b.X_WB.R);
  ExpectSame(a.X_WB.p, b.X_WB.p);
  ExpectSame(a.v_WB, b.v_WB);
  ExpectSame(a.angular_rate_B, b.angular_rate_B);
}

void ExpectSameSamples(const FrameBundle& a, const FrameBundle& b) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    ExpectSame(a.poses[i], b.poses[i]);
  }
  ASSERT_EQ(a.imu.size(), b.imu.size());
  for (std::size_t i = 0; i < a.imu.size(); ++i) {
    EXPECT_EQ(a.imu[i].time, b.imu[i].time);
    ExpectSame(a.imu[i].specific_force_B, b.imu[i].specific_force_B);
    ExpectSame(a.imu[i].angular_rate_B, b.imu[i].angular_rate_B);
  }
  ASSERT_EQ(a.gps.size(), b.gps.size());
  for (std::size_t i = 0; i < a.gps.size(); ++i) {
    EXPECT_EQ(a.gps[i].time, b.gps[i].time);
    ExpectSame(a.gps[i].p_WB, b.gps[i].p_WB);
    ExpectSame(a.gps[i].v_WB, b.gps[i].v_WB);
    EXPECT_TRUE(SameBits(a.gps[i].sigma_horizontal_m, b.gps[i].sigma_horizontal_m));
    EXPECT_TRUE(SameBits(a.gps[i].sigma_vertical_m, b.gps[i].sigma_vertical_m));
  }
  ASSERT_EQ(a.laser.size(), b.laser.size());
  for (std::size_t i = 0; i < a.laser.size(); ++i) {
    EXPECT_EQ(a.laser[i].time, b.laser[i].time);
    EXPECT_TRUE(SameBits(a.laser[i].range_m, b.laser[i].range_m));
  }
  EXPECT_EQ(a.arrival, b.arrival);
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i) {
    EXPECT_EQ(a.truth[i].time, b.truth[i].time);
    ExpectSame(a.truth[i].X_WB.R, b.truth[i].X_WB.R);
    ExpectSame(a.truth[i].X_WB.p, b.truth[i].X_WB.p);
    ExpectSame(a.truth[i].v_WB, b.truth[i].v_WB);
  }
}

void ExpectSameBundle(const FrameBundle& a, const FrameBundle& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.discontinuity, b.discontinuity);
  ASSERT_EQ(a.rig != nullptr, b.rig != nullptr);
  EXPECT_TRUE(a.rig == nullptr || SameRig(*a.rig, *b.rig));
  ASSERT_EQ(a.stereo != nullptr, b.stereo != nullptr);
  if (a.stereo) {
    EXPECT_EQ(a.stereo->time, b.stereo->time);
    EXPECT_EQ(a.stereo->left.width(), b.stereo->left.width());
    EXPECT_EQ(a.stereo->left.pixels(), b.stereo->left.pixels());
    EXPECT_EQ(a.stereo->right.pixels(), b.stereo->right.pixels());
  }
  ASSERT_EQ(a.pose_at_exposure.has_value(), b.pose_at_exposure.has_value());
  if (a.pose_at_exposure) {
    ExpectSame(*a.pose_at_exposure, *b.pose_at_exposure);
  }
  ExpectSameSamples(a, b);
  ASSERT_EQ(a.status.has_value(), b.status.has_value());
  if (a.status) {
    EXPECT_EQ(a.status->time, b.status->time);
    EXPECT_EQ(a.status->boot_id, b.status->boot_id);
    EXPECT_EQ(a.status->mode, b.status->mode);
    EXPECT_EQ(a.status->on_ground, b.status->on_ground);
    EXPECT_EQ(a.status->flies_on_vision, b.status->flies_on_vision);
    EXPECT_EQ(a.status->approval_id, b.status->approval_id);
    EXPECT_TRUE(SameBits(a.status->wind_speed_mps, b.status->wind_speed_mps));
    EXPECT_TRUE(SameBits(a.status->wind_from_rad, b.status->wind_from_rad));
    EXPECT_TRUE(SameBits(a.status->battery_or_fuel, b.status->battery_or_fuel));
    EXPECT_EQ(a.status->simulated, b.status->simulated);
  }
  ASSERT_EQ(a.acks.size(), b.acks.size());
  for (std::size_t i = 0; i < a.acks.size(); ++i) {
    EXPECT_EQ(a.acks[i].time, b.acks[i].time);
    EXPECT_EQ(a.acks[i].command_id, b.acks[i].command_id);
    EXPECT_EQ(a.acks[i].result, b.acks[i].result);
    EXPECT_EQ(a.acks[i].reason, b.acks[i].reason);
  }
}

/// A stream of bundles: some without pictures, pose, rig or status.
std::vector<std::shared_ptr<FrameBundle>> RandomFlight(RandomStream& random, int count) {
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  std::vector<std::shared_ptr<FrameBundle>> flight;
  for (int i = 0; i < count; ++i) {
    flight.push_back(RandomBundle(random, static_cast<std::uint64_t>(i), rig));
    if (i % 4 == 1) {
      flight.back()->stereo = nullptr;
    }
    if (i % 5 == 2) {
      flight.back()->pose_at_exposure.reset();
      flight.back()->status.reset();
      flight.back()->poses.clear();
    }
    flight.back()->discontinuity = i % 6 == 5;
    if (i % 7 == 3) {
      flight.back()->rig = nullptr;
    }
  }
  return flight;
}

TEST(Bundle, SurvivesTheWireToTheBit) {
  constexpr std::uint64_t kSeed = 11;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  RandomStream random(kSeed);
  BundleAssembler assembler;
  for (const auto& sent : RandomFlight(random, 50)) {
    const Bundles got = PushAll(assembler, EncodeBundle(*sent, {}));
    ASSERT_EQ(got.size(), 1u);
    ExpectSameBundle(*sent, *got[0]);
  }
  EXPECT_EQ(assembler.report().undecodable, 0u);
  EXPECT_EQ(assembler.report().samples_lost, 0u);
  EXPECT_EQ(assembler.report().pictures_unpaired, 0u);
}

/// What was refused travels with its bundle into the log and back, and moves nothing.
TEST(Bundle, WhatWasRefusedIsKeptAsEvidence) {
  RandomStream random(12);
  auto sent = RandomBundle(random, 3, std::make_shared<StereoRig>(RandomRig(random)));
  sent->refused = {{{1700000000000000},
                    "10.0.0.9:6666",
                    "VEHICLE_POSE",
                    "not LCM",
                    43,
                    900,
                    {0x4c, 0x43, 0x30, 0x33, 0x00, 0xff}},
                   {{1700000000000001}, "", "", "no channel name", 8, 1, {}}};
  BundleAssembler assembler;
  const Bundles got = PushAll(assembler, EncodeBundle(*sent, {}));
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0]->refused, sent->refused);
  EXPECT_EQ(assembler.report().other_channels, 0u);
  ExpectSameBundle(*sent, *got[0]);
}

TEST(Bundle, AnotherVersionOfATypeIsCountedApart) {
  RandomStream random(13);
  BundleAssembler assembler;
  auto messages =
      EncodeBundle(*RandomBundle(random, 1, std::make_shared<StereoRig>(RandomRig(random))), {});
  WireMessage& pose = messages.front();
  pose.payload[3] ^= 0x40;
  assembler.Push(pose);
  EXPECT_NE(assembler.problem().find("type hash differs"), std::string::npos);
  EXPECT_EQ(assembler.report().other_version_of.at(pose.channel), 1u);
  assembler.Push({pose.channel, {}, {messages[1].payload.begin(), messages[1].payload.end() - 1}});
  EXPECT_EQ(assembler.report().undecodable, 2u);
  EXPECT_EQ(assembler.report().other_version_of.at(pose.channel), 1u);
  assembler.Push(messages.back());
  EXPECT_TRUE(assembler.problem().empty());
}

TEST(Bundle, RigPointerStaysWhileTheRigDoes) {
  RandomStream random(3);
  BundleAssembler assembler;
  const auto flight = RandomFlight(random, 3);
  const Bundles first = PushAll(assembler, EncodeBundle(*flight[0], {}));
  const Bundles second = PushAll(assembler, EncodeBundle(*flight[1], {}));
  EXPECT_EQ(first[0]->rig, second[0]->rig);
}

TEST(Bundle, LostMessagesCostOnlyThemselvesAndAreCounted) {
  RandomStream random(5);
  const auto flight = RandomFlight(random, 1);
  const std::vector<WireMessage> whole = EncodeBundle(*flight[0], {});
  const ChannelNames names;
  struct Case {
    std::string lost;
    bool stereo;
  };
  for (const Case& c : {Case{names.camera_right, false}, Case{names.camera_left, false},
                        Case{names.imu, true}, Case{names.vehicle_pose, true}}) {
    SCOPED_TRACE(c.lost);
    BundleAssembler assembler;
    std::vector<WireMessage> kept;
    bool dropped = false;
    for (const WireMessage& message : whole) {
      if (message.channel == c.lost && !dropped) {
        dropped = true;
        continue;
      }
      kept.push_back(message);
    }
    const Bundles got = PushAll(assembler, kept);
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0]->stereo != nullptr, c.stereo);
    EXPECT_EQ(assembler.report().pictures_unpaired, c.stereo ? 0u : 1u);
    EXPECT_EQ(assembler.report().samples_lost, c.stereo ? 1u : 0u);
  }
}

TEST(Bundle, LostEndJoinsTheSamplesToTheNextBundle) {
  RandomStream random(6);
  const auto flight = RandomFlight(random, 40);
  BundleAssembler assembler;
  PushAll(assembler, EncodeBundle(*flight[0], {}));
  std::vector<WireMessage> cut = EncodeBundle(*flight[4], {});
  cut.pop_back();
  EXPECT_TRUE(PushAll(assembler, cut).empty());
  const Bundles got = PushAll(assembler, EncodeBundle(*flight[8], {}));
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0]->imu.size(), flight[4]->imu.size() + flight[8]->imu.size());
  ASSERT_NE(got[0]->stereo, nullptr);
  EXPECT_EQ(got[0]->stereo->left.pixels(), flight[8]->stereo->left.pixels());
  EXPECT_EQ(assembler.report().bundles_lost, 7u);
}

/// What a vehicle of somebody else's would send: no bundle ends, an occasional rig.
class ForeignStream : public ::testing::Test {
 protected:
  ForeignStream() {
    RandomStream random(8);
    rig_ = std::make_shared<const StereoRig>(RandomRig(random));
    FrameBundle bundle;
    bundle.rig = rig_;
    WireMessage marked = EncodeBundle(bundle, {}).back();
    marked.payload[16] = 0;  // bundle_end, after hash and utime
    rig_message_ = marked;
  }
  WireMessage Picture(bool left, std::int64_t us) const {
    FrameBundle bundle;
    bundle.stereo = std::make_shared<StereoFrame>(
        StereoFrame{{us}, ImageU8(4, 3, std::uint8_t{1}), ImageU8(4, 3, std::uint8_t{2})});
    return EncodeBundle(bundle, {})[left ? 0 : 1];
  }
  WireMessage Pose(std::int64_t us, double north_m, double v_mps) const {
    FrameBundle bundle;
    VehiclePose pose;
    pose.time = {us};
    pose.X_WB.p = {north_m, 0, -10};
    pose.v_WB = {v_mps, 0, 0};
    bundle.poses = {pose};
    return EncodeBundle(bundle, {})[0];
  }
  std::shared_ptr<const StereoRig> rig_;
  WireMessage rig_message_;
};

TEST_F(ForeignStream, PairsPicturesWithinFiveMilliseconds) {
  BundleAssembler assembler;
  EXPECT_TRUE(assembler.Push(rig_message_).empty());
  EXPECT_TRUE(assembler.Push(Pose(980'000, 5, 2)).empty());
  EXPECT_TRUE(assembler.Push(Picture(true, 1'000'000)).empty());
  const Bundles got = assembler.Push(Picture(false, 1'004'900));
  ASSERT_EQ(got.size(), 1u);
  ASSERT_NE(got[0]->stereo, nullptr);
  EXPECT_EQ(got[0]->stereo->time.us, 1'000'000);
  ASSERT_TRUE(got[0]->pose_at_exposure.has_value());
  // 5 m + 2 m/s * 0.02 s.
  EXPECT_NEAR(got[0]->pose_at_exposure->X_WB.p.x(), 5.04, 1e-12);
  EXPECT_EQ(got[0]->poses.size(), 1u);
}

TEST_F(ForeignStream, PicturesFurtherApartAreNoPair) {
  BundleAssembler assembler;
  assembler.Push(rig_message_);
  assembler.Push(Picture(true, 1'000'000));
  EXPECT_TRUE(assembler.Push(Picture(false, 1'006'000)).empty());
  EXPECT_EQ(assembler.report().pictures_unpaired, 1u);
  // The newer right picture still finds its partner.
  EXPECT_EQ(assembler.Push(Picture(true, 1'007'000)).size(), 1u);
}

TEST_F(ForeignStream, LostRightPictureDropsItsPairOnly) {
  BundleAssembler assembler;
  assembler.Push(rig_message_);
  int bundles = 0;
  for (int i = 0; i < 10; ++i) {
    const std::int64_t us = 1'000'000 + 100'000 * i;
    bundles += static_cast<int>(assembler.Push(Picture(true, us)).size());
    if (i != 4) {
      bundles += static_cast<int>(assembler.Push(Picture(false, us)).size());
    }
  }
  EXPECT_EQ(bundles, 9);
  EXPECT_EQ(assembler.report().pictures_unpaired, 1u);
}

TEST_F(ForeignStream, WithoutARigItWaitsAndSaysSo) {
  BundleAssembler assembler;
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(assembler.Push(Picture(true, 100'000 * (i + 1))).empty());
    EXPECT_TRUE(assembler.Push(Picture(false, 100'000 * (i + 1))).empty());
  }
  EXPECT_EQ(assembler.rig(), nullptr);
  EXPECT_EQ(assembler.report().pairs_without_rig, 9u);
  // The pair still held is delivered when the rig comes.
  EXPECT_EQ(assembler.Push(rig_message_).size(), 1u);
}

TEST_F(ForeignStream, FrozenSenderIsNoNewsWhenLive) {
  BundleAssembler assembler({}, {.drop_repeated = true});
  assembler.Push(rig_message_);
  int bundles = 0;
  for (int i = 0; i < 10; ++i) {
    assembler.Push(Picture(true, 1'000'000));
    bundles += static_cast<int>(assembler.Push(Picture(false, 1'000'000)).size());
  }
  EXPECT_EQ(bundles, 1);
  EXPECT_EQ(assembler.report().repeated, 18u);
}

TEST(Picture, StrideAndPaddingAreHonoured) {
  FrameBundle bundle;
  bundle.stereo = std::make_shared<StereoFrame>(
      StereoFrame{{5}, ImageU8(3, 2, {1, 2, 3, 4, 5, 6}), ImageU8(3, 2, std::uint8_t{9})});
  const WireMessage message = EncodeBundle(bundle, {})[0];
  const Result<TimedPicture> picture = PictureFromWire(message);
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture->grey.pixels(), (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  WireMessage lying = message;
  lying.payload[8 + 8 + 3] = 4;  // width 4 in the same bytes
  const Result<TimedPicture> refused = PictureFromWire(lying);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("width of 4"), std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace palace
