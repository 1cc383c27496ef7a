// The vehicle's check: each approval once, in time, for itself only; with and without a key.
#include "engine/trust/approval_verifier.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr std::uint64_t kBoot = 9;
constexpr Timestamp kInTime{2'000'000};

const ApprovalSigner& Signer() {
  static const ApprovalSigner signer = ApprovalSigner::FromSeed(1);
  return signer;
}

Approval Good(std::uint64_t counter = 1, std::uint64_t session = 5) {
  Approval a;
  a.id = 0x500000000 | counter;
  a.session_id = session;
  a.counter = counter;
  a.site_id = 101;
  a.vehicle_boot_id = kBoot;
  a.approved_at = {1'000'000};
  a.expires_at = {31'000'000};
  a.p_WS = {1, 2, 3};
  a.approach_heading_rad = 0.5;
  a.glide_slope_rad = 0.7;
  a.clear_radius_m = 2.3;
  Signer().Sign(a);
  return a;
}

ApprovalVerifier WithKey() { return {kBoot, Signer().public_key()}; }
ApprovalVerifier WithoutKey() { return {kBoot, std::nullopt}; }

struct Row {
  const char* name;
  std::function<void(Approval&)> change;  ///< before it is signed
  Timestamp now;
  const char* why;  ///< empty: accepted
};

TEST(ApprovalVerifier, TakesWhatIsForThisVehicleNowAndNothingElse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Row> rows = {
      {"good", [](Approval&) {}, kInTime, ""},
      {"a microsecond before the end", [](Approval&) {}, {30'999'999}, ""},
      {"at the end", [](Approval&) {}, {31'000'000}, "Expired"},
      {"after the end", [](Approval&) {}, {31'000'001}, "Expired"},
      {"ends as it begins", [](Approval& a) { a.expires_at = a.approved_at; }, {0}, "Expired"},
      {"no id", [](Approval& a) { a.id = 0; }, kInTime, "The approval has no id"},
      {"counter 0", [](Approval& a) { a.counter = 0; }, kInTime, ""},
      {"another boot", [](Approval& a) { a.vehicle_boot_id += 1; }, kInTime,
       "Given for another start of this vehicle"},
      {"north", [=](Approval& a) { a.p_WS.x() = nan; }, kInTime, "A value is not finite"},
      {"heading", [=](Approval& a) { a.approach_heading_rad = nan; }, kInTime,
       "A value is not finite"},
      {"glide", [=](Approval& a) { a.glide_slope_rad = 1 / 0.0; }, kInTime,
       "A value is not finite"},
      {"radius", [=](Approval& a) { a.clear_radius_m = nan; }, kInTime, "A value is not finite"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    Approval a = Good();
    row.change(a);
    Signer().Sign(a);
    for (ApprovalVerifier verifier : {WithKey(), WithoutKey()}) {
      EXPECT_EQ(verifier.Verify(a, row.now), row.why);
      EXPECT_EQ(verifier.refused(), row.why[0] == 0 ? 0U : 1U);
      EXPECT_EQ(verifier.IsRepeat(a), row.why[0] == 0);
    }
  }
}

TEST(ApprovalVerifier, AsksForTheStationsSignatureWhereItHasAKey) {
  Approval a = Good();
  a.p_WS.x() += 1e-12;
  ApprovalVerifier vehicle = WithKey(), stranger(kBoot, ApprovalSigner::FromSeed(2).public_key());
  EXPECT_EQ(vehicle.Verify(a, kInTime), "Signature does not match");
  EXPECT_EQ(stranger.Verify(Good(), kInTime), "Signature does not match");
  EXPECT_EQ(WithoutKey().Verify(a, kInTime), "");
  // A refused one spends no counter and binds no session.
  EXPECT_EQ(vehicle.Verify(Good(1, 6), kInTime), "");
}

TEST(ApprovalVerifier, EveryCounterOnceAndRising) {
  for (ApprovalVerifier verifier : {WithKey(), WithoutKey()}) {
    EXPECT_EQ(verifier.Verify(Good(1), kInTime), "");
    EXPECT_EQ(verifier.Verify(Good(1), kInTime), "Counter 1 was already used");
    EXPECT_EQ(verifier.Verify(Good(3), kInTime), "");
    EXPECT_EQ(verifier.Verify(Good(2), kInTime), "Counter 2 was already used");
    EXPECT_EQ(verifier.refused(), 2U);
  }
}

TEST(ApprovalVerifier, TheFirstSessionHoldsUntilTheVehicleStartsAnew) {
  ApprovalVerifier signed_only = WithKey(), bench = WithoutKey();
  EXPECT_EQ(signed_only.Verify(Good(1, 5), kInTime), "");
  EXPECT_EQ(signed_only.Verify(Good(2, 6), kInTime), "Given by another session");
  // Unsigned, nothing tells who speaks; each session still has its own rising counter.
  EXPECT_EQ(bench.Verify(Good(4, 5), kInTime), "");
  EXPECT_EQ(bench.Verify(Good(1, 6), kInTime), "");
  EXPECT_EQ(bench.Verify(Good(4, 5), kInTime), "Counter 4 was already used");
}

// The acknowledgement was lost: another copy is answered, any other approval is none.
TEST(ApprovalVerifier, KnowsTheLastAcceptedAgainToTheByte) {
  ApprovalVerifier verifier = WithKey();
  EXPECT_FALSE(verifier.IsRepeat(Good(1)));
  ASSERT_EQ(verifier.Verify(Good(1), kInTime), "");
  EXPECT_TRUE(verifier.IsRepeat(Good(1)));
  Approval forged = Good(1);
  forged.signature[3] ^= 1;
  EXPECT_FALSE(verifier.IsRepeat(forged));
  Approval changed = Good(1);
  changed.clear_radius_m += 1;
  EXPECT_FALSE(verifier.IsRepeat(changed));
  ASSERT_NE(verifier.Verify(changed, kInTime), "");
  EXPECT_TRUE(verifier.IsRepeat(Good(1)));  // a refused one is not remembered
  ASSERT_EQ(verifier.Verify(Good(2), kInTime), "");
  EXPECT_FALSE(verifier.IsRepeat(Good(1)));
}

// I8, I9: of any stream with copies, gaps and reorderings, accepted counters rise and never recur.
TEST(ApprovalVerifier, AcceptsEachAtMostOnceInAnyOrder) {
  constexpr std::uint64_t kSeed = 12;
  SCOPED_TRACE("seed 12");
  RandomStream random(kSeed, "approvals");
  for (int trial = 0; trial < 20; ++trial) {
    ApprovalVerifier verifier = trial % 2 == 0 ? WithKey() : WithoutKey();
    std::uint64_t highest = 0;
    for (int i = 0; i < 40; ++i) {
      const Approval a = Good(static_cast<std::uint64_t>(1 + random.Index(30)));
      const bool accepted = verifier.Verify(a, kInTime).empty();
      EXPECT_EQ(accepted, a.counter > highest);
      highest = accepted ? a.counter : highest;
    }
  }
}

}  // namespace
}  // namespace palace
