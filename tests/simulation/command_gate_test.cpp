// The simulated vehicle's gate: what it can fly, told to nobody but the station itself.
#include "engine/simulation/command_gate.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "tests/trust/pair.h"

namespace palace {
namespace {

TEST(CommandGate, ASealComesBeforeEverythingAndFlightAfterSense) {
  const SecretKey key = SecretKey::FromSeed(1);
  CommandGate gate(VehicleOf({key}), DefaultVehicle().limits);
  StationSession station(StationOf(key, "alpha", 1));
  Timestamp now = kNow;
  ASSERT_TRUE(Ask(station, gate.authority(), now));
  const auto with = [&](double slope_rad, double rate_mps, double north_m = 10) {
    Approval approval = GoodApproval();
    approval.glide_slope_rad = slope_rad;
    approval.descent_rate_mps = rate_mps;
    approval.p_WS.x() = north_m;
    return approval;
  };
  EXPECT_EQ(gate.Admit(with(0.1, 1), Hovering()), "Not sealed");
  EXPECT_EQ(gate.Admit(Sealed(station, with(0.1, 1)), Hovering()),
            "The glide slope is outside 15 to 90 degrees");
  EXPECT_EQ(gate.Admit(Sealed(station, with(0.7, 2)), Hovering()),
            "The descent rate is outside 0.1 to 1.5 m/s");
  EXPECT_EQ(gate.Admit(Sealed(station, with(0.7, 1, 500)), Hovering()),
            "The site is more than 100 m away");
  // What was refused is spent, whatever spoke against it.
  const Approval late = Sealed(station, with(0.7, 1));
  EXPECT_EQ(gate.Admit(late, Hovering(), "the vehicle is not in hover"),
            "the vehicle is not in hover");
  EXPECT_EQ(gate.Admit(late, Hovering()), "the vehicle is not in hover");
  EXPECT_FALSE(gate.IsRepeat(late));
  const Approval good = Sealed(station, with(0.7, 1));
  EXPECT_FALSE(gate.IsRepeat(good));
  EXPECT_EQ(gate.Admit(good, Hovering()), "");
  EXPECT_TRUE(gate.IsRepeat(good));
}

}  // namespace
}  // namespace palace
