// What others say on the bus in a vehicle's name: it neither gives command nor takes it, and is
// shown as plain text.
#include <string>

#include <gtest/gtest.h>

#include "tests/trust/two_stations.h"

namespace palace {
namespace {

using Kind = SessionRequest::Kind;
using Standing = AuthorityStanding;

// Whoever is on the bus may say anything; what only the vehicle can have said comes through again.
TEST(Session, ForgedReportsNeitherGrantNorDeafen) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  AuthorityReport forged = t.vehicle.Report(AddSeconds(t.now, 1e6));
  forged.mac[0] ^= 1;
  t.alpha.Hear(forged, t.now_s());  // names our key: not sealed by it, not heard
  EXPECT_TRUE(t.alpha.Holds());
  forged.key_id = 77;
  forged.station_id = 5;
  forged.station_name = "mallory";
  t.alpha.Hear(forged, t.now_s());
  EXPECT_TRUE(t.alpha.Holds());
  forged.boot_id = 99;
  t.alpha.Hear(forged, t.now_s());
  EXPECT_TRUE(t.alpha.Holds());
  t.Tell(t.alpha);
  EXPECT_TRUE(t.alpha.Holds());
  EXPECT_EQ(t.vehicle.Check(SealedChannel::kCommand, SealedBytes(Sealed(t.alpha, HoldRequest{})),
                            Sealed(t.alpha, HoldRequest{}).seal, t.now),
            "Seal does not match")
      << "two seals are two messages";
}

/// What anybody can send: no seal, no session, and a challenge of its own.
AuthorityReport Unsealed(const TwoStations& t, std::uint64_t boot_id = kBoot) {
  AuthorityReport report;
  report.time = t.now;
  report.boot_id = boot_id;
  report.challenge = static_cast<std::uint64_t>(t.now.us);
  return report;
}

// Forged ten times a second, "nobody commands" neither takes command from who has it nor makes it
// ask for what it has.
TEST(Session, ForgedReportsDoNotEndASession) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  const std::uint64_t session_id = t.vehicle.Report(t.now).session_id;
  for (int i = 0; i < 100; ++i) {
    t.now = AddSeconds(t.now, 0.1);
    if (i % 10 == 0) {
      t.alpha.Hear(t.vehicle.Report(t.now), t.now_s());
    }
    AuthorityReport forged = Unsealed(t, i % 2 == 0 ? kBoot : kBoot + 1);
    forged.time = AddSeconds(t.now, 0.049);
    t.alpha.Hear(forged, t.now_s());
    ASSERT_EQ(t.alpha.Status(t.now_s()).standing, Standing::kHeld) << i;
    if (const auto request = t.alpha.Tick(t.now, t.now_s())) {
      EXPECT_EQ(request->kind, Kind::kKeep);
      EXPECT_EQ(t.vehicle.Take(*request, t.now), VehicleAuthority::Answer::kKept);
    }
  }
  EXPECT_EQ(t.vehicle.Report(t.now).session_id, session_id);
}

// Sealed by the right key, and of another start: recorded once, played now.
TEST(Session, SealedReportsOfAnEarlierStartDoNotEndASession) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  const AuthorityReport recorded = t.vehicle.Report(t.now);
  VehicleAuthority restarted(VehicleOf({t.key}, kBoot + 1, 5));
  t.now = AddSeconds(t.now, StationSession::kSure_s + 0.1);
  ASSERT_TRUE(Ask(t.alpha, restarted, t.now));
  t.alpha.Hear(recorded, t.now_s());
  EXPECT_TRUE(t.alpha.Holds());
  // Nor later, when nothing of the vehicle was heard for long: it was heard before.
  t.now = AddSeconds(t.now, 60);
  t.alpha.Hear(recorded, t.now_s());
  EXPECT_TRUE(t.alpha.Holds());
}

TEST(Session, OnlyASealedReportGivesCommand) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  AuthorityReport forged = t.vehicle.Report(t.now);
  forged.key_id = 77;  // whose seal cannot be checked here
  t.now = forged.time = AddSeconds(t.now, StationSession::kSure_s + 0.1);
  t.alpha.Hear(forged, t.now_s());
  EXPECT_FALSE(t.alpha.Holds());
}

// A second session would end the flight of the first: who commands already is granted none, unless
// the vehicle has not heard it for long.
TEST(Session, WhoCommandsIsNotGrantedCommandAgain) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  const std::uint64_t session_id = t.vehicle.Report(t.now).session_id;
  EXPECT_EQ(t.vehicle.Take(Wish(t.alpha, Kind::kAsk, t.now), t.now),
            VehicleAuthority::Answer::kRefused);
  EXPECT_EQ(t.vehicle.Report(t.now).session_id, session_id);
  t.now = AddSeconds(t.now, VehicleAuthority::kSilent_s + 0.1);
  EXPECT_EQ(t.vehicle.Take(Wish(t.alpha, Kind::kAsk, t.now), t.now),
            VehicleAuthority::Answer::kGranted);
}

// A forged challenge makes the station ask anew before the first answer came: that still counts.
TEST(Session, AnAnswerToAnEarlierRequestIsTaken) {
  TwoStations t;
  t.Tell(t.alpha);
  const SessionRequest first = *t.alpha.Tick(t.now, t.now_s());
  ASSERT_EQ(t.vehicle.Take(first, t.now), VehicleAuthority::Answer::kGranted);
  t.now = AddSeconds(t.now, 1);
  t.alpha.Hear(Unsealed(t), t.now_s());
  const SessionRequest second = *t.alpha.Tick(t.now, t.now_s());
  EXPECT_NE(second.nonce, first.nonce);
  EXPECT_EQ(t.vehicle.Take(second, t.now), VehicleAuthority::Answer::kRefused);
  t.Tell(t.alpha);
  EXPECT_TRUE(t.alpha.Holds());
  const HoldRequest hold = Sealed(t.alpha, HoldRequest{1, "x", {}});
  EXPECT_EQ(t.vehicle.Check(SealedChannel::kCommand, SealedBytes(hold), hold.seal, t.now), "");
}

// The request to give command back may be lost on the way.
TEST(Session, CommandIsGivenBackUntilTheVehicleSaysSo) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  (void)Wish(t.alpha, Kind::kRelease, t.now);  // lost
  t.Tell(t.alpha);
  t.now = AddSeconds(t.now, 1);
  const auto again = t.alpha.Tick(t.now, t.now_s());
  ASSERT_TRUE(again);
  EXPECT_EQ(t.vehicle.Take(*again, t.now), VehicleAuthority::Answer::kReleased);
  t.Tell(t.alpha);
  EXPECT_EQ(t.alpha.Status(t.now_s()).standing, Standing::kReleased);
}

// Whatever a stranger writes, people read a line of plain text.
TEST(Session, WordsOfStrangersArePlainAndBounded) {
  TwoStations t;
  AuthorityReport forged = Unsealed(t);
  forged.session_id = 5;
  forged.station_name = "mallory\n\x1b[2J" + std::string(5000, 'x');
  forged.refused_station_id = 1;
  forged.refusal = std::string(5000, '\t');
  t.alpha.Hear(forged, 0);
  const AuthorityStatus status = t.alpha.Status(0);
  EXPECT_EQ(status.why_not.find("Station \"mallory??[2Jxxx"), 0u) << status.why_not;
  EXPECT_LT(status.why_not.size(), 100u);
  EXPECT_LT(status.holder.size(), 90u);
  EXPECT_EQ(status.refusal, std::string(197, '?') + "...");
}

}  // namespace
}  // namespace palace
