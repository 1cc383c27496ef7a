// Any bytes give a value or an error, never a crash or an allocation they do not justify; good
// bytes decode to what the generated decoders make of them.
#include "engine/wire/decode.h"

#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "engine/wire/convert.h"
#include "engine/wire/sensor_messages.h"
#include "engine/wire/wire_fields.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

/// Runs every decoder that may meet a message of this channel. True when one accepted it.
bool DecodeAny(const WireMessage& message) {
  const ChannelNames n;
  const std::string& c = message.channel;
  if (c == n.command || c == n.position_estimate || c == n.session_request || c == n.abort) {
    return DecodeVehicleMessage(message, n).ok();
  }
  if (c == n.slad_settings) {
    return DecodeSettings(message).ok();
  }
  if (c == n.site_proposal) {
    return DecodeProposal(message).ok();
  }
  if (c == n.site_decision) {
    return DecodeCommand(message).ok();
  }
  if (c == n.tracker_status) {
    return DecodeTracker(message).ok();
  }
  if (c == n.station_status) {
    return DecodeStationStatus(message).ok();
  }
  if (c == n.event) {
    return DecodeEvent(message).ok();
  }
  if (c == n.mission) {
    return DecodePayload<mission_t>(message.payload).ok();
  }
  BundleAssembler assembler;
  assembler.Push(message);
  return assembler.report().undecodable == 0 && assembler.report().other_channels == 0;
}

template <typename T>
void ExpectLikeGenerated(const std::vector<std::uint8_t>& payload) {
  const Result<T> ours = DecodePayload<T>(payload);
  T theirs;
  const int used = theirs.decode(payload.data(), 0, static_cast<int>(payload.size()));
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  EXPECT_EQ(used, static_cast<int>(payload.size()));
  EXPECT_EQ(EncodePayload(*ours), payload);
  EXPECT_EQ(EncodePayload(theirs), payload);
}

TEST(Decode, AgreesWithTheGeneratedDecoders) {
  RandomStream random(21);
  const ChannelNames n;
  std::map<std::string, void (*)(const std::vector<std::uint8_t>&)> checks = {
      {n.camera_left, ExpectLikeGenerated<image_t>},
      {n.camera_right, ExpectLikeGenerated<image_t>},
      {n.camera_rig, ExpectLikeGenerated<camera_rig_t>},
      {n.vehicle_pose, ExpectLikeGenerated<pose_t>},
      {n.imu, ExpectLikeGenerated<imu_t>},
      {n.gps, ExpectLikeGenerated<gps_t>},
      {n.laser_range, ExpectLikeGenerated<laser_range_t>},
      {n.vehicle_status, ExpectLikeGenerated<vehicle_status_t>},
      {n.command_ack, ExpectLikeGenerated<command_ack_t>},
      {n.authority, ExpectLikeGenerated<authority_t>},
      {n.session_request, ExpectLikeGenerated<session_request_t>},
      {n.truth, ExpectLikeGenerated<truth_t>},
      {n.arrival, ExpectLikeGenerated<arrival_t>},
      {n.mission, ExpectLikeGenerated<mission_t>},
      {n.slad_settings, ExpectLikeGenerated<slad_settings_t>},
      {n.site_proposal, ExpectLikeGenerated<site_proposal_t>},
      {n.site_decision, ExpectLikeGenerated<site_decision_t>},
      {n.command, ExpectLikeGenerated<command_t>},
      {n.position_estimate, ExpectLikeGenerated<position_estimate_t>},
      {n.tracker_status, ExpectLikeGenerated<tracker_status_t>},
      {n.station_status, ExpectLikeGenerated<station_status_t>},
      {n.abort, ExpectLikeGenerated<abort_t>},
      {n.refused, ExpectLikeGenerated<refused_t>},
      {n.event, ExpectLikeGenerated<event_t>},
  };
  std::set<std::string> seen;
  for (const WireMessage& message : OneOfEach(random)) {
    SCOPED_TRACE(message.channel);
    ASSERT_TRUE(checks.count(message.channel));
    checks[message.channel](message.payload);
    seen.insert(message.channel);
  }
  EXPECT_EQ(seen.size(), checks.size()) << "a channel has no sample";
}

TEST(Decode, ImagesAndPosesAreBotCoreTypes) {
  // LCM hashes member names, types and order, not names of structs: these are the hashes that
  // definitions with bot_core's members give.
  EXPECT_STREQ(image_t::getTypeName(), "image_t");
  const image_t image{};
  EXPECT_EQ(image.getEncodedSize(), 8 + 8 + 5 * 4 + 4);
  const pose_t pose{};
  EXPECT_EQ(pose.getEncodedSize(), 8 + 8 + 16 * 8);
}

TEST(Decode, EveryTruncationIsRefused) {
  RandomStream random(22);
  for (const WireMessage& message : OneOfEach(random)) {
    SCOPED_TRACE(message.channel);
    ASSERT_TRUE(DecodeAny(message));
    for (std::size_t length = 0; length < message.payload.size(); ++length) {
      WireMessage cut = message;
      cut.payload.resize(length);
      cut.payload.shrink_to_fit();
      EXPECT_FALSE(DecodeAny(cut)) << length << " of " << message.payload.size();
    }
    WireMessage longer = message;
    longer.payload.push_back(0);
    EXPECT_FALSE(DecodeAny(longer));
  }
}

TEST(Decode, AnyMutationGivesAValueOrAnError) {
  constexpr std::uint64_t kSeed = 23;
  std::printf("seed %d\n", static_cast<int>(kSeed));
  RandomStream random(kSeed);
  const std::vector<WireMessage> samples = OneOfEach(random);
  int accepted = 0;
  int refused = 0;
  for (int round = 0; round < 20000; ++round) {
    WireMessage mutant =
        samples[static_cast<std::size_t>(random.Index(static_cast<int>(samples.size())))];
    const int changes = 1 + random.Index(4);
    for (int i = 0; i < changes; ++i) {
      // Mostly past the type hash, so that the fields are reached.
      const int first = random.Index(20) == 0 ? 0 : 8;
      const auto at = static_cast<std::size_t>(
          first + random.Index(static_cast<int>(mutant.payload.size()) - first));
      const std::uint8_t extremes[] = {0x00, 0x7F, 0x80, 0xFF};
      mutant.payload[at] = random.Index(2) == 0 ? extremes[random.Index(4)]
                                                : static_cast<std::uint8_t>(random.NextBits());
    }
    ++(DecodeAny(mutant) ? accepted : refused);
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(Decode, HugeCountsAllocateNothing) {
  // The generated decoder takes 2 GB for this one (reference: reliability 1.4).
  const image_t image{};
  for (const std::uint8_t high : {0x7F, 0x80, 0xFF}) {
    std::vector<std::uint8_t> payload = EncodePayload(image);
    payload[8 + 8 + 16] = high;
    const Result<image_t> decoded = DecodePayload<image_t>(payload);
    ASSERT_FALSE(decoded.ok());
    EXPECT_NE(decoded.error().message.find("does not fit"), std::string::npos)
        << decoded.error().message;
  }
}

// LCM's own encoder stops at the first zero: such a text, recorded, would not fit its own length.
TEST(Decode, ATextWithAZeroInsideIsRefused) {
  command_ack_t ack{};
  ack.reason = "not now";
  std::vector<std::uint8_t> payload = EncodePayload(ack);
  ASSERT_TRUE(DecodePayload<command_ack_t>(payload).ok());
  payload[payload.size() - 5] = 0;
  const auto refused = DecodePayload<command_ack_t>(payload);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("a zero inside"), std::string::npos)
      << refused.error().message;
}

TEST(Decode, NotFiniteNumbersAreRefusedWhereDecisionsRestOnThem) {
  RandomStream random(24);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  const auto good = RandomBundle(random, 1, rig);
  const std::map<std::string, std::function<void(FrameBundle&)>> breaks = {
      {"pose", [](FrameBundle& b) { b.poses[0].X_WB.p.x() = NAN; }},
      {"imu", [](FrameBundle& b) { b.imu[0].angular_rate_B.z() = INFINITY; }},
      {"gps", [](FrameBundle& b) { b.gps[0].sigma_vertical_m = NAN; }},
      {"status", [](FrameBundle& b) { b.status->battery_or_fuel = INFINITY; }},
      {"wind", [](FrameBundle& b) { b.status->wind_speed_mps = -INFINITY; }},
      {"exposure", [](FrameBundle& b) { b.pose_at_exposure->X_WB.R(1, 1) = NAN; }},
  };
  for (const auto& [name, damage] : breaks) {
    SCOPED_TRACE(name);
    FrameBundle bad = *good;
    damage(bad);
    BundleAssembler assembler;
    for (const WireMessage& message : EncodeBundle(bad, {})) {
      assembler.Push(message);
    }
    EXPECT_EQ(assembler.report().undecodable, 1u);
  }
}

// One flipped bit of an exponent: finite, and nowhere on Earth.
TEST(Decode, NumbersThatNoVehicleCanHaveAreRefusedWithTheirLimit) {
  RandomStream random(26);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  const auto good = RandomBundle(random, 1, rig);
  const struct {
    const char* says;
    std::function<void(FrameBundle&)> damage;
  } breaks[] = {
      {"GPS fix: 4.6e+36 m of position, at most 1e+06 m",
       [](FrameBundle& b) { b.gps[0].p_WB.y() = -4.6e36; }},
      {"GPS fix: 2e+03 m/s of velocity, at most 1e+03 m/s",
       [](FrameBundle& b) { b.gps[0].v_WB.x() = 2000; }},
      {"pose: 1.1e+06 m of position", [](FrameBundle& b) { b.poses[0].X_WB.p.z() = 1.1e6; }},
      {"pose: 1.01e+03 rad/s of angular rate",
       [](FrameBundle& b) { b.poses[0].angular_rate_B.z() = 1010; }},
      {"inertial sample: 2e+04 m/s^2 of specific force",
       [](FrameBundle& b) { b.imu[0].specific_force_B.x() = 2e4; }},
      {"laser: 1e+300 m of range", [](FrameBundle& b) { b.laser[0].range_m = 1e300; }},
  };
  for (const auto& row : breaks) {
    SCOPED_TRACE(row.says);
    FrameBundle bad = *good;
    row.damage(bad);
    BundleAssembler assembler;
    std::string said;
    const auto words = [](const auto& result) { return result ? "" : result.error().message; };
    for (const WireMessage& message : EncodeBundle(bad, {})) {
      assembler.Push(message);
      said += words(PoseFromWire(message)) + words(ImuFromWire(message)) +
              words(GpsFromWire(message)) + words(LaserFromWire(message));
    }
    EXPECT_EQ(assembler.report().undecodable, 1u);
    EXPECT_NE(said.find(row.says), std::string::npos) << said;
  }
}

// Many vehicles measure no wind: NaN says so, and the status counts all the same.
TEST(Decode, AVehicleMayNotKnowTheWindOrItsFuel) {
  RandomStream random(25);
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  FrameBundle bundle = *RandomBundle(random, 1, rig);
  bundle.status->wind_speed_mps = bundle.status->wind_from_rad = NAN;
  bundle.status->battery_or_fuel = NAN;
  BundleAssembler assembler;
  std::vector<std::shared_ptr<const FrameBundle>> done;
  for (const WireMessage& message : EncodeBundle(bundle, {})) {
    for (const auto& got : assembler.Push(message)) {
      done.push_back(got);
    }
  }
  EXPECT_EQ(assembler.report().undecodable, 0u);
  ASSERT_EQ(done.size(), 1u);
  ASSERT_TRUE(done[0]->status.has_value());
  EXPECT_TRUE(std::isnan(done[0]->status->wind_speed_mps));
  EXPECT_TRUE(std::isnan(done[0]->status->battery_or_fuel));
}

}  // namespace
}  // namespace palace
