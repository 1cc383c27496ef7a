// Approvals: every field is signed, and a vehicle takes each one once, in time, for itself only.
#include "engine/trust/approval.h"

#include <functional>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

namespace palace {
namespace {

constexpr std::uint64_t kBoot = 9;

Approval Good(const ApprovalSigner& signer, std::uint64_t counter = 1) {
  Approval a;
  a.id = 0x500000000 | counter;
  a.session_id = 5;
  a.counter = counter;
  a.site_id = 101;
  a.map_hash = 2;
  a.settings_hash = 3;
  a.calibration_hash = 4;
  a.vehicle_boot_id = kBoot;
  a.approved_at = {1'000'000};
  a.expires_at = {31'000'000};
  a.p_WS = {1, 2, 3};
  a.approach_heading_rad = 0.5;
  a.glide_slope_rad = 0.7;
  a.descent_rate_mps = 0.8;
  a.clear_radius_m = 2.3;
  signer.Sign(a);
  return a;
}

TEST(Approval, IsAcceptedOnceAndOnlyOnce) {
  const auto signer = ApprovalSigner::FromSeed(1);
  VerifierState state;
  const Approval a = Good(signer);
  EXPECT_EQ(VerifyApproval(a, signer.public_key(), state, {2'000'000}, kBoot), "");
  EXPECT_TRUE(IsRepeatOfAccepted(a, signer.public_key(), state));
  EXPECT_EQ(VerifyApproval(a, signer.public_key(), state, {2'000'000}, kBoot),
            "Counter 1 was already used");
  EXPECT_EQ(VerifyApproval(Good(signer, 3), signer.public_key(), state, {2'000'000}, kBoot), "");
  EXPECT_FALSE(IsRepeatOfAccepted(a, signer.public_key(), state));
  EXPECT_EQ(VerifyApproval(Good(signer, 2), signer.public_key(), state, {2'000'000}, kBoot),
            "Counter 2 was already used");
  EXPECT_EQ(state.refused, 2U);
}

TEST(Approval, AnyChangedFieldVoidsTheSignature) {
  const auto signer = ApprovalSigner::FromSeed(1);
  const std::vector<std::pair<const char*, std::function<void(Approval&)>>> tampers = {
      {"id", [](Approval& a) { a.id ^= 1; }},
      {"session", [](Approval& a) { a.session_id ^= 1; }},
      {"counter", [](Approval& a) { a.counter += 1; }},
      {"site", [](Approval& a) { a.site_id ^= 1; }},
      {"map", [](Approval& a) { a.map_hash ^= 1; }},
      {"settings", [](Approval& a) { a.settings_hash ^= 1; }},
      {"calibration", [](Approval& a) { a.calibration_hash ^= 1; }},
      {"boot", [](Approval& a) { a.vehicle_boot_id ^= 1; }},
      {"approved_at", [](Approval& a) { a.approved_at.us += 1; }},
      {"expires_at", [](Approval& a) { a.expires_at.us += 1; }},
      {"provisional", [](Approval& a) { a.provisional = !a.provisional; }},
      {"north", [](Approval& a) { a.p_WS.x() += 1e-12; }},
      {"east", [](Approval& a) { a.p_WS.y() += 1e-12; }},
      {"down", [](Approval& a) { a.p_WS.z() += 1e-12; }},
      {"heading", [](Approval& a) { a.approach_heading_rad += 1e-12; }},
      {"glide", [](Approval& a) { a.glide_slope_rad += 1e-12; }},
      {"descent rate", [](Approval& a) { a.descent_rate_mps += 1e-12; }},
      {"radius", [](Approval& a) { a.clear_radius_m += 1e-12; }},
      {"signature", [](Approval& a) { a.signature[17] ^= 1; }},
      {"short signature", [](Approval& a) { a.signature.pop_back(); }},
      {"no signature", [](Approval& a) { a.signature.clear(); }},
  };
  for (const auto& [name, tamper] : tampers) {
    SCOPED_TRACE(name);
    Approval a = Good(signer);
    tamper(a);
    VerifierState state;
    EXPECT_EQ(VerifyApproval(a, signer.public_key(), state, {2'000'000}, a.vehicle_boot_id),
              "Signature does not match");
    EXPECT_FALSE(state.session_id.has_value());
  }
}

TEST(Approval, WrongBootSessionKeyAndLateArrivalAreRefused) {
  const auto signer = ApprovalSigner::FromSeed(1);
  const PublicKey& key = signer.public_key();
  const Approval a = Good(signer);
  VerifierState fresh;
  EXPECT_EQ(VerifyApproval(a, key, fresh, {2'000'000}, kBoot + 1),
            "Given for another start of this vehicle");
  EXPECT_EQ(VerifyApproval(a, key, fresh, {31'000'000}, kBoot), "Expired");
  EXPECT_EQ(VerifyApproval(a, ApprovalSigner::FromSeed(2).public_key(), fresh, {2'000'000}, kBoot),
            "Signature does not match");
  VerifierState other;
  other.session_id = 6;
  EXPECT_EQ(VerifyApproval(a, key, other, {2'000'000}, kBoot), "Given by another session");
  EXPECT_EQ(VerifyApproval(a, key, fresh, {30'999'999}, kBoot), "");
}

TEST(Approval, NonFiniteIsRefusedEvenWhenSigned) {
  const auto signer = ApprovalSigner::FromSeed(1);
  Approval a = Good(signer);
  a.p_WS.y() = std::numeric_limits<double>::quiet_NaN();
  signer.Sign(a);
  VerifierState state;
  EXPECT_EQ(VerifyApproval(a, signer.public_key(), state, {2'000'000}, kBoot),
            "A value is not finite");
}

TEST(Approval, SeedGivesTheKeyRandomDoesNot) {
  EXPECT_EQ(ApprovalSigner::FromSeed(7).public_key(), ApprovalSigner::FromSeed(7).public_key());
  EXPECT_NE(ApprovalSigner::FromSeed(7).public_key(), ApprovalSigner::FromSeed(8).public_key());
  EXPECT_NE(ApprovalSigner::Random().public_key(), ApprovalSigner::Random().public_key());
  Approval a = Good(ApprovalSigner::FromSeed(7)), b = Good(ApprovalSigner::FromSeed(7));
  EXPECT_EQ(a.signature, b.signature);
}

}  // namespace
}  // namespace palace
