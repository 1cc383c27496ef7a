// What a seal speaks of is what travels: an integrator may take the payload's own bytes.
#include <gtest/gtest.h>

#include "engine/trust/station_session.h"
#include "engine/trust/vehicle_authority.h"
#include "engine/wire/convert.h"
#include "tests/trust/pair.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

const ChannelNames kNames;

std::vector<std::uint8_t> WithRole(std::string_view role,
                                   const std::vector<std::uint8_t>& payload) {
  const std::string head = "PALACE-2 " + std::string(role) + "\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  bytes.insert(bytes.end(), payload.begin() + 8, payload.end() - 32);
  return bytes;
}

Approval RandomApproval(RandomStream& random) {
  Approval a = GoodApproval(random.NextBits());
  a.site_id = random.NextBits();
  a.provisional = random.Index(2) == 1;
  a.p_WS = RandomVector(random);
  a.clear_radius_m = random.Normal();
  a.stop_height_m = random.Normal();
  return a;
}

TEST(SealedBytes, AreThePayloadWithoutTypeHashAndMac) {
  RandomStream random(71);
  Pair pair;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Approval approval = Sealed(pair.station, RandomApproval(random));
    EXPECT_EQ(WithRole("COMMAND", EncodeVehicleMessage(approval, {1}, kNames).payload),
              SealedBytes(approval));
    const HoldRequest hold =
        Sealed(pair.station, HoldRequest{random.NextBits(), std::string(i, 'x'), {}});
    EXPECT_EQ(WithRole("COMMAND", EncodeVehicleMessage(hold, {1}, kNames).payload),
              SealedBytes(hold));
    const GoRequest go = Sealed(pair.station, GoRequest{random.NextBits(),
                                                        random.NextBits(),
                                                        {random.Index(1000)},
                                                        RandomVector(random),
                                                        random.Normal(),
                                                        {}});
    EXPECT_EQ(WithRole("COMMAND", EncodeVehicleMessage(go, {1}, kNames).payload), SealedBytes(go));
    PositionEstimate estimate;
    estimate.time = {random.Index(1000)};
    estimate.healthy = true;
    estimate.p_WB = RandomVector(random);
    estimate = Sealed(pair.station, estimate);
    EXPECT_EQ(WithRole("POSITION_ESTIMATE", EncodeVehicleMessage(estimate, {1}, kNames).payload),
              SealedBytes(estimate));
    SessionRequest request = RequestOf(static_cast<SessionRequest::Kind>(i % 4));
    request = Sealed(pair.station, request);
    EXPECT_EQ(WithRole("SESSION_REQUEST", EncodeVehicleMessage(request, {1}, kNames).payload),
              SealedBytes(request));
  }
  FrameBundle bundle;
  bundle.authority = pair.vehicle.Report(kNow);
  EXPECT_EQ(WithRole("AUTHORITY", EncodeBundle(bundle, kNames).front().payload),
            SealedBytes(*bundle.authority));
}

// One bit of what travels, whichever: it is not read, or not taken.
TEST(SealedBytes, EveryBitOfACommandOnTheWireCounts) {
  Pair pair;
  for (const VehicleMessage& message :
       {VehicleMessage(Sealed(pair.station, GoodApproval())),
        VehicleMessage(Sealed(pair.station, HoldRequest{500, "operator", {}})),
        VehicleMessage(Sealed(pair.station, GoRequest{501, 7, {9}, {1, 2, -15}, 0.5, {}}))}) {
    WireMessage wire = EncodeVehicleMessage(message, {1}, kNames);
    for (std::size_t bit = 0; bit < 8 * wire.payload.size(); ++bit) {
      wire.payload[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
      if (const Result<VehicleMessage> read = DecodeVehicleMessage(wire, kNames)) {
        std::string why = "an abort needs no seal";
        if (const auto* approval = std::get_if<Approval>(&*read)) {
          why = pair.vehicle.WhyRefused(SealedChannel::kCommand, SealedBytes(*approval),
                                        approval->seal);
        } else if (const auto* hold = std::get_if<HoldRequest>(&*read)) {
          why = pair.vehicle.WhyRefused(SealedChannel::kCommand, SealedBytes(*hold), hold->seal);
        } else if (const auto* go = std::get_if<GoRequest>(&*read)) {
          why = pair.vehicle.WhyRefused(SealedChannel::kCommand, SealedBytes(*go), go->seal);
        }
        EXPECT_NE(why, "") << "bit " << bit;
      }
      wire.payload[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    }
    for (std::size_t size = 0; size < wire.payload.size(); ++size) {
      const WireMessage cut{
          wire.channel, {}, {wire.payload.begin(), wire.payload.begin() + long(size)}};
      EXPECT_FALSE(DecodeVehicleMessage(cut, kNames).ok()) << size;
    }
  }
}

// F10 of an approval: the vehicle refuses it with the reason, so it must be read first.
TEST(SealedBytes, AnApprovalWithANumberThatIsNoneIsReadAndRefusedWithTheReason) {
  Pair pair;
  Approval approval = GoodApproval();
  approval.p_WS.x() = NAN;
  const auto read = DecodeVehicleMessage(
      EncodeVehicleMessage(Sealed(pair.station, approval), {1}, kNames), kNames);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(pair.verifier.Verify(std::get<Approval>(*read), Hovering()),
            "The site's position is not a number");
}

}  // namespace
}  // namespace palace
