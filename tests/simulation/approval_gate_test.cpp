// The simulated vehicle's gate: what it can fly, told to nobody but the station itself.
#include "engine/simulation/approval_gate.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace palace {
namespace {

Approval Near(const ApprovalSigner& signer, double north_m) {
  Approval approval;
  approval.id = 5;
  approval.session_id = 3;
  approval.counter = 1;
  approval.vehicle_boot_id = 11;
  approval.approved_at = {1'000'000};
  approval.expires_at = {31'000'000};
  approval.p_WS = {north_m, 0, 0};
  approval.approach_heading_rad = 0;
  approval.glide_slope_rad = Rad(45);
  approval.descent_rate_mps = 1;
  approval.clear_radius_m = 2;
  signer.Sign(approval);
  return approval;
}

TEST(ApprovalGate, ASignatureComesBeforeEverything) {
  const ApprovalSigner station = ApprovalSigner::FromSeed(1),
                       stranger = ApprovalSigner::FromSeed(2);
  ApprovalGate gate(11, station.public_key());
  const Eigen::Vector3d p_WB(0, 0, -15);
  const Timestamp now{2'000'000};
  EXPECT_EQ(gate.Admit(Near(stranger, 500), now, p_WB), "Signature does not match");
  EXPECT_EQ(gate.Admit(Near(station, 500), now, p_WB), "The site is more than 100 m away");
  // The refusal spent no counter, and a copy of what was refused is no repeat.
  EXPECT_FALSE(gate.IsRepeat(Near(station, 500)));
  EXPECT_EQ(gate.Admit(Near(station, 10), now, p_WB), "");
  EXPECT_TRUE(gate.IsRepeat(Near(station, 10)));
}

}  // namespace
}  // namespace palace
