// Who commands: one station at a time, by its key, until it gives command back, falls silent or is
// overruled by an explicit wish.
#include <array>
#include <cstdlib>
#include <deque>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/trust/two_stations.h"

namespace palace {
namespace {

using Kind = SessionRequest::Kind;
using Standing = AuthorityStanding;

TEST(Session, TheFirstToAskCommandsAndTheSecondMayOnlyLook) {
  TwoStations t;
  EXPECT_EQ(t.alpha.Status(0).why_not, "No vehicle was heard");
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  EXPECT_EQ(t.alpha.Status(t.now_s()).standing, Standing::kHeld);
  EXPECT_EQ(t.alpha.Status(t.now_s()).why_not, "");
  EXPECT_EQ(t.alpha.Status(t.now_s()).fingerprint, FingerprintText(t.key.id()));
  EXPECT_FALSE(Ask(t.bravo, t.vehicle, t.now));
  const AuthorityStatus status = t.bravo.Status(t.now_s());
  EXPECT_EQ(status.standing, Standing::kOther);
  EXPECT_EQ(status.why_not, "Station \"alpha\" commands this vehicle");
  EXPECT_EQ(status.holder, "alpha " + FingerprintText(t.key.id()));
  EXPECT_TRUE(status.can_ask);
  // It does not ask by itself, and when a person lets it, a living holder keeps command.
  EXPECT_FALSE(t.bravo.Tick(t.now, t.now_s() + 10).has_value());
  EXPECT_EQ(t.vehicle.Take(Wish(t.bravo, Kind::kAsk, t.now), t.now),
            VehicleAuthority::Answer::kRefused);
  t.Tell(t.bravo);
  EXPECT_EQ(t.bravo.Status(t.now_s()).refusal.find("alpha commands, heard"), 0u);
}

TEST(Session, SilenceLetsAnotherAskAndASignOfLifeDoesNot) {
  for (const bool keeps : {false, true}) {
    TwoStations t;
    ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
    t.Tell(t.bravo);
    for (int i = 0; i < 8; ++i) {
      t.now = AddSeconds(t.now, 1);
      if (keeps) {
        t.vehicle.Take(*t.alpha.Tick(t.now, t.now_s()), t.now);
      }
    }
    t.Tell(t.bravo);
    EXPECT_EQ(t.bravo.Status(t.now_s()).holder_is_silent, !keeps);
    t.vehicle.Take(Wish(t.bravo, Kind::kAsk, t.now), t.now);
    t.Tell(t.bravo);
    EXPECT_EQ(t.bravo.Holds(), !keeps);
  }
}

TEST(Session, ReleasedCommandIsFreeAndNotAskedForAgain) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  EXPECT_EQ(t.vehicle.Take(Wish(t.alpha, Kind::kRelease, t.now), t.now),
            VehicleAuthority::Answer::kReleased);
  t.Tell(t.alpha);
  EXPECT_EQ(t.alpha.Status(t.now_s()).standing, Standing::kReleased);
  EXPECT_FALSE(t.alpha.Tick(t.now, t.now_s() + 10).has_value());
  EXPECT_TRUE(Ask(t.bravo, t.vehicle, t.now));
  t.Tell(t.alpha);
  EXPECT_EQ(t.alpha.Status(t.now_s()).holder.substr(0, 5), "bravo");
}

TEST(Session, AnExplicitTakeOverWinsAndBothAreTold) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  t.Tell(t.bravo);
  EXPECT_EQ(t.vehicle.Take(Wish(t.bravo, Kind::kTakeOver, t.now), t.now),
            VehicleAuthority::Answer::kGranted);
  t.Tell(t.bravo);
  EXPECT_TRUE(t.bravo.Holds());
  // What is sealed with another's key anybody could have sent: it counts when nothing surer does.
  t.Tell(t.alpha);
  EXPECT_TRUE(t.alpha.Holds());
  t.now = AddSeconds(t.now, StationSession::kSure_s);
  t.Tell(t.alpha);
  EXPECT_EQ(t.alpha.Status(t.now_s()).why_not, "Station \"bravo\" commands this vehicle");
}

TEST(Session, AVehicleThatStartedAnewIsAskedAnewAndNothingIsInherited) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  const Approval before = Sealed(t.alpha, GoodApproval());
  VehicleAuthority restarted(VehicleOf({t.key}, kBoot + 1, 5));
  t.now = AddSeconds(t.now, StationSession::kSure_s + 0.1);
  t.alpha.Hear(restarted.Report(t.now), t.now_s());
  EXPECT_EQ(t.alpha.Status(t.now_s()).standing, Standing::kAsking);
  EXPECT_TRUE(Ask(t.alpha, restarted, t.now));
  ApprovalVerifier verifier(restarted);
  EXPECT_EQ(verifier.Verify(before, Hovering()), "Seal does not match");
}

// What was recorded grants nothing: neither on the same start nor on another.
TEST(Session, RecordedRequestsGrantNothing) {
  TwoStations t;
  t.now = AddSeconds(t.now, 1);
  t.alpha.Hear(t.vehicle.Report(t.now), t.now_s());
  const SessionRequest recorded = *t.alpha.Tick(t.now, t.now_s());
  ASSERT_EQ(t.vehicle.Take(recorded, t.now), VehicleAuthority::Answer::kGranted);
  EXPECT_EQ(t.vehicle.Take(recorded, t.now), VehicleAuthority::Answer::kKept) << "a mere copy";
  t.Tell(t.alpha);
  t.vehicle.Take(Wish(t.alpha, Kind::kRelease, t.now), t.now);
  EXPECT_EQ(t.vehicle.Take(recorded, t.now), VehicleAuthority::Answer::kRefused);
  EXPECT_EQ(t.vehicle.Report(t.now).refusal, "The request is an old one");
  VehicleAuthority restarted(VehicleOf({t.key}, kBoot + 1, 5));
  EXPECT_EQ(restarted.Take(recorded, t.now), VehicleAuthority::Answer::kRefused);
  EXPECT_EQ(restarted.Report(t.now).refusal, "Asked of another start of this vehicle");
}

TEST(Session, RequestsAreRefusedWithTheReason) {
  struct Row {
    const char* why;
    void (*change)(SessionRequest&);
  };
  const Row rows[] = {
      {"The request is not sealed by its key", [](SessionRequest& r) { r.seal.mac[0] ^= 1; }},
      {"The request is not sealed by its key", [](SessionRequest& r) { r.station_name += "x"; }},
      {"The request is not sealed by its key", [](SessionRequest& r) { r.nonce ^= 1; }},
      {"The request is not sealed by its key", [](SessionRequest& r) { r.kind = Kind::kTakeOver; }},
      {"This vehicle has no key 0000-0000-0000-0007", [](SessionRequest& r) { r.key_id = 7; }},
  };
  for (const Row& row : rows) {
    TwoStations t;
    t.Tell(t.alpha);
    SessionRequest request = *t.alpha.Tick(t.now, t.now_s());
    row.change(request);
    EXPECT_EQ(t.vehicle.Take(request, t.now), VehicleAuthority::Answer::kRefused);
    EXPECT_EQ(t.vehicle.Report(t.now).refusal, row.why);
    EXPECT_EQ(t.vehicle.Report(t.now).session_id, 0u);
  }
}

TEST(Session, WithoutAKeyAStationMayOnlyLook) {
  TwoStations t;
  StationSession keyless(StationOf(std::nullopt, "charlie", 3));
  t.Tell(keyless);
  EXPECT_FALSE(keyless.Tick(t.now, t.now_s()).has_value());
  EXPECT_EQ(keyless.Status(t.now_s()).standing, Standing::kNoKey);
  EXPECT_EQ(keyless.Status(t.now_s()).why_not, "No key");
  EXPECT_FALSE(keyless.Status(t.now_s()).can_ask);
  EXPECT_EQ(Sealed(keyless, GoodApproval()).seal.session_id, 0u);
}

TEST(Session, AVehicleThatNeverReportsGrantsNothing) {
  StationSession alpha(StationOf(SecretKey::FromSeed(1), "alpha", 1));
  alpha.HearVehicle(0);
  EXPECT_EQ(alpha.Status(4).standing, Standing::kNoGrant);
  EXPECT_EQ(alpha.Status(4).why_not, "The vehicle grants no session");
}

// F32, F33: own messages are known as they come back; others', and own ones played later, are not.
TEST(Session, TellsItsOwnMessagesFromOthers) {
  TwoStations t;
  ASSERT_TRUE(Ask(t.alpha, t.vehicle, t.now));
  t.Tell(t.bravo);
  const HoldRequest hold = Sealed(t.alpha, HoldRequest{4, "x", {}});
  EXPECT_TRUE(t.alpha.IsOwn(hold, 10));
  EXPECT_TRUE(t.alpha.IsOwn(hold, 10.5)) << "a network may deliver twice";
  EXPECT_FALSE(t.alpha.IsOwn(hold, 12)) << "played later";
  HoldRequest forged = Sealed(t.alpha, HoldRequest{4, "x", {}});
  forged.command_id = 5;
  EXPECT_FALSE(t.alpha.IsOwn(forged, 12));
  EXPECT_FALSE(t.alpha.IsOwn(GoodApproval(), 12));
  EXPECT_FALSE(t.alpha.IsOfHolder(GoodApproval()));
  EXPECT_TRUE(t.bravo.IsOfHolder(hold)) << "bravo knows that alpha commands";
  EXPECT_FALSE(t.bravo.IsOfHolder(GoodApproval()));
}

/// A network that loses, delays, repeats and reorders.
template <typename Message>
class Network {
 public:
  explicit Network(RandomStream& random) : random_(random) {}
  void Send(const Message& message) {
    for (int copies = random_.Index(4); copies > 0; --copies) {
      if (under_way_.size() > 4) {
        under_way_.pop_back();
      }
      under_way_.insert(under_way_.begin() + random_.Index(static_cast<int>(under_way_.size()) + 1),
                        message);
    }
  }
  std::optional<Message> Deliver() {
    if (under_way_.empty() || random_.Index(2) == 0) {
      return std::nullopt;
    }
    Message message = under_way_.front();
    under_way_.pop_front();
    return message;
  }

 private:
  RandomStream& random_;
  std::deque<Message> under_way_;
};

// I10: at no moment does the vehicle take commands of two stations, whatever the network does, who
// asks, gives back, falls silent or takes over, and however often the vehicle starts anew.
TEST(Session, NeverTwoHolders) {
  const char* given = std::getenv("PALACE_SEED");
  const std::uint64_t first = given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
  const std::uint64_t last = given != nullptr ? first : 40;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE("PALACE_SEED=" + std::to_string(seed));
    RandomStream random(seed, "authority");
    const SecretKey shared = SecretKey::FromSeed(1), other = SecretKey::FromSeed(2);
    VehicleAuthority vehicle(VehicleOf({shared, other}, 1, seed));
    std::vector<StationSession> stations;
    for (std::uint64_t i = 0; i < 3; ++i) {
      stations.emplace_back(
          StationOf(i == 2 ? other : shared, std::string(1, char('a' + i)), i + 1));
    }
    Network<SessionRequest> up(random);
    std::vector<Network<AuthorityReport>> down(3, Network<AuthorityReport>(random));
    Timestamp now = kNow;
    int commands_taken = 0;
    std::uint64_t boots = 1;
    for (int step = 0; step < 400; ++step) {
      now = AddSeconds(now, random.Uniform(0.01, 1.0));
      const double now_s = SecondsBetween(kNow, now);
      if (random.Index(100) == 0) {
        ++boots;
        vehicle = VehicleAuthority(VehicleOf({shared, other}, boots, seed + 1000 * boots));
      }
      for (std::size_t i = 0; i < stations.size(); ++i) {
        down[i].Send(vehicle.Report(now));
        if (const auto report = down[i].Deliver()) {
          stations[i].Hear(*report, now_s);
        }
        if (const auto request = stations[i].Tick(now, now_s)) {
          up.Send(*request);
        }
        if (random.Index(25) == 0) {
          up.Send(Wish(stations[i], static_cast<Kind>(random.Index(4)), now));
        }
      }
      while (const auto request = up.Deliver()) {
        vehicle.Take(*request, now);
      }
      int taken = 0;
      for (StationSession& station : stations) {
        const HoldRequest hold = Sealed(station, HoldRequest{1, "x", {}});
        taken += vehicle.WhyRefused(SealedChannel::kCommand, SealedBytes(hold), hold.seal).empty();
      }
      ASSERT_LE(taken, 1) << "step " << step;
      commands_taken += taken;
    }
    EXPECT_GT(commands_taken, 20) << "somebody commands most of the time";
  }
}

}  // namespace
}  // namespace palace
