// Seals: every field of every message is under them; nothing of another vehicle, station, session,
// start or channel passes, and nothing passes twice.
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/trust/pair.h"

namespace palace {
namespace {

HoldRequest GoodHold() { return {500, "operator", {}}; }
PositionEstimate GoodEstimate() {
  PositionEstimate e;
  e.time = kNow;
  e.source = EstimateSource::kVision;
  e.healthy = true;
  e.approval_id = 71;
  e.p_WB = {1, 2, -15};
  e.sigma_p_m = {0.1, 0.1, 0.1};
  return e;
}

template <typename Message>
constexpr SealedChannel ChannelOf() {
  return std::is_same_v<Message, PositionEstimate> ? SealedChannel::kEstimate
                                                   : SealedChannel::kCommand;
}

template <typename Message>
std::string WhyRefused(const VehicleAuthority& vehicle, const Message& message) {
  return vehicle.WhyRefused(ChannelOf<Message>(), SealedBytes(message), message.seal);
}
template <typename Message>
std::string Check(VehicleAuthority& vehicle, const Message& message) {
  return vehicle.Check(ChannelOf<Message>(), SealedBytes(message), message.seal, kNow);
}

/// Each change of one field is noticed.
template <typename Message>
void ExpectEveryFieldSealed(const Message& good,
                            const std::vector<std::function<void(Message&)>>& changes) {
  Pair pair;
  const Message sealed = Sealed(pair.station, good);
  ASSERT_EQ(WhyRefused(pair.vehicle, sealed), "");
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Message changed = sealed;
    changes[i](changed);
    EXPECT_EQ(WhyRefused(pair.vehicle, changed), "Seal does not match") << "change " << i;
  }
  for (std::size_t bit = 0; bit < 8 * sealed.seal.mac.size(); ++bit) {
    Message changed = sealed;
    changed.seal.mac[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    EXPECT_EQ(WhyRefused(pair.vehicle, changed), "Seal does not match") << "bit " << bit;
  }
}

TEST(Seal, CoversEveryFieldOfAnApproval) {
  using A = Approval;
  ExpectEveryFieldSealed<A>(GoodApproval(), {[](A& a) { a.id ^= 1; },
                                             [](A& a) { a.site_id ^= 1; },
                                             [](A& a) { a.map_hash ^= 1; },
                                             [](A& a) { a.settings_hash ^= 1; },
                                             [](A& a) { a.calibration_hash ^= 1; },
                                             [](A& a) { a.vehicle_boot_id ^= 1; },
                                             [](A& a) { a.approved_at.us ^= 1; },
                                             [](A& a) { a.expires_at.us ^= 1; },
                                             [](A& a) { a.provisional = !a.provisional; },
                                             [](A& a) { a.p_WS.x() += 1e-12; },
                                             [](A& a) { a.p_WS.y() += 1e-12; },
                                             [](A& a) { a.p_WS.z() += 1e-12; },
                                             [](A& a) { a.approach_heading_rad += 1e-12; },
                                             [](A& a) { a.glide_slope_rad += 1e-12; },
                                             [](A& a) { a.descent_rate_mps += 1e-12; },
                                             [](A& a) { a.clear_radius_m += 1e-12; },
                                             [](A& a) { a.stop_height_m += 1e-12; },
                                             [](A& a) { a.seal.sent_at.us ^= 1; },
                                             [](A& a) { a.seal.session_id ^= 1; },
                                             [](A& a) { ++a.seal.counter; }});
}

TEST(Seal, CoversEveryFieldOfAHold) {
  using H = HoldRequest;
  ExpectEveryFieldSealed<H>(GoodHold(),
                            {[](H& h) { h.command_id ^= 1; }, [](H& h) { h.reason += "!"; },
                             [](H& h) { h.reason.clear(); }, [](H& h) { h.seal.sent_at.us ^= 1; },
                             [](H& h) { h.seal.session_id ^= 1; }, [](H& h) { ++h.seal.counter; }});
}

TEST(Seal, CoversEveryFieldOfAWayToAnotherHover) {
  using G = GoRequest;
  ExpectEveryFieldSealed<G>(
      {500, 7, {9}, {1, 2, -15}, 0.5, {}},
      {[](G& g) { g.command_id ^= 1; }, [](G& g) { g.vehicle_boot_id ^= 1; },
       [](G& g) { g.expires_at.us ^= 1; }, [](G& g) { g.p_WB.x() += 1e-12; },
       [](G& g) { g.p_WB.y() += 1e-12; }, [](G& g) { g.p_WB.z() += 1e-12; },
       [](G& g) { g.heading_rad += 1e-12; }, [](G& g) { g.seal.sent_at.us ^= 1; },
       [](G& g) { g.seal.session_id ^= 1; }, [](G& g) { ++g.seal.counter; }});
}

TEST(Seal, CoversEveryFieldOfAnEstimate) {
  using E = PositionEstimate;
  std::vector<std::function<void(E&)>> changes = {
      [](E& e) { e.time.us ^= 1; },         [](E& e) { e.source = EstimateSource::kGps; },
      [](E& e) { e.healthy = false; },      [](E& e) { e.approval_id ^= 1; },
      [](E& e) { e.seal.session_id ^= 1; }, [](E& e) { ++e.seal.counter; }};
  for (int i = 0; i < 3; ++i) {
    changes.push_back([i](E& e) { e.p_WB[i] += 1e-12; });
    changes.push_back([i](E& e) { e.v_WB[i] += 1e-12; });
    changes.push_back([i](E& e) { e.sigma_p_m[i] += 1e-12; });
    changes.push_back([i](E& e) { e.sigma_v_mps[i] += 1e-12; });
  }
  ExpectEveryFieldSealed<E>(GoodEstimate(), changes);
}

// An approval cannot be turned into a hold, nor either into an estimate, by the channel it is on.
TEST(Seal, IsOfOneKindOfMessageAndOneChannel) {
  Pair pair;
  const Approval approval = Sealed(pair.station, GoodApproval());
  HoldRequest hold = GoodHold();
  hold.seal = approval.seal;
  PositionEstimate estimate = GoodEstimate();
  estimate.seal = approval.seal;
  EXPECT_EQ(WhyRefused(pair.vehicle, hold), "Seal does not match");
  EXPECT_EQ(WhyRefused(pair.vehicle, estimate), "Seal does not match");
  EXPECT_NE(SealedBytes(hold), SealedBytes(approval));
}

TEST(Seal, NothingPassesTwiceOrOutOfOrder) {
  Pair pair;
  std::vector<HoldRequest> sent;
  for (int i = 0; i < 4; ++i) {
    sent.push_back(Sealed(pair.station, GoodHold()));
  }
  EXPECT_EQ(Check(pair.vehicle, sent[0]), "");
  EXPECT_EQ(Check(pair.vehicle, sent[0]), "Counter 1 was already used");
  EXPECT_EQ(Check(pair.vehicle, sent[2]), "");
  EXPECT_EQ(Check(pair.vehicle, sent[1]), "Counter 2 was already used");
  EXPECT_EQ(Check(pair.vehicle, sent[3]), "");
  // Estimates have a count of their own: a command overtaken by one is not lost.
  const PositionEstimate estimate = Sealed(pair.station, GoodEstimate());
  EXPECT_EQ(estimate.seal.counter, 1u);
  EXPECT_EQ(Check(pair.vehicle, estimate), "");
}

TEST(Seal, NothingOfAnotherVehicleStartSessionOrStationPasses) {
  Pair pair(1), another_key(2), another_start(1, kBoot + 1);
  ASSERT_TRUE(pair.commands && another_key.commands && another_start.commands);
  const std::string no = "Seal does not match";
  EXPECT_EQ(Check(pair.vehicle, Sealed(another_key.station, GoodHold())), no);
  EXPECT_EQ(Check(pair.vehicle, Sealed(another_start.station, GoodHold())), no);
  // The same pair, an earlier session.
  const HoldRequest old = Sealed(pair.station, GoodHold());
  StationSession restarted(StationOf(pair.key, "alpha", 777));
  VehicleMessage take = RequestOf(SessionRequest::Kind::kTakeOver);
  restarted.Hear(pair.vehicle.Report(AddSeconds(kNow, 20)), 20);
  restarted.Seal(take, kNow, 20);
  using Answer = VehicleAuthority::Answer;
  ASSERT_EQ(pair.vehicle.Take(std::get<SessionRequest>(take), kNow), Answer::kGranted);
  EXPECT_EQ(Check(pair.vehicle, old), no);
  EXPECT_EQ(Check(pair.vehicle, Sealed(pair.station, GoodHold())), no);
  restarted.Hear(pair.vehicle.Report(AddSeconds(kNow, 21)), 21);
  EXPECT_EQ(Check(pair.vehicle, Sealed(restarted, GoodHold())), "");
  // What nobody sealed, and where nobody commands.
  EXPECT_EQ(Check(pair.vehicle, GoodHold()), "Not sealed");
  VehicleAuthority fresh(VehicleOf({pair.key}));
  EXPECT_EQ(Check(fresh, Sealed(restarted, GoodHold())),
            "No station commands this vehicle; ask for command first");
}

}  // namespace
}  // namespace palace
