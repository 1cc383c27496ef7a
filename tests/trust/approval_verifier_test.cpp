// The vehicle's check: each approval once, in time, of sense, for itself only.
#include "engine/trust/approval_verifier.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "tests/trust/pair.h"

namespace palace {
namespace {

struct Row {
  const char* name;
  std::function<void(Approval&)> change;
  const char* why;  ///< empty: accepted
};

// Signed nonsense is refused with the reason, NaN as well; the limits are met to both sides.
TEST(ApprovalVerifier, TakesWhatIsOfSenseAndNothingElse) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto at = [](double s) { return AddSeconds(kNow, s); };
  const Row rows[] = {
      {"good", [](Approval&) {}, ""},
      {"no id", [](Approval& a) { a.id = 0; }, "The approval has no id"},
      {"no site", [](Approval& a) { a.site_id = 0; }, "The approval names no site"},
      {"no map", [](Approval& a) { a.map_hash = 0; },
       "The approval names no map, limits or calibration"},
      {"no limits", [](Approval& a) { a.settings_hash = 0; },
       "The approval names no map, limits or calibration"},
      {"no rig", [](Approval& a) { a.calibration_hash = 0; },
       "The approval names no map, limits or calibration"},
      {"another boot", [](Approval& a) { a.vehicle_boot_id += 1; },
       "Given for another start of this vehicle"},
      {"over now", [&](Approval& a) { a.expires_at = at(1); }, "Expired"},
      {"over in a microsecond", [&](Approval& a) { a.expires_at = {at(1).us + 1}; }, ""},
      {"ends as it begins", [&](Approval& a) { a.expires_at = a.approved_at; }, "Expired"},
      {"120 s", [&](Approval& a) { a.expires_at = at(120); }, ""},
      {"121 s", [&](Approval& a) { a.expires_at = at(121); }, "Valid for longer than 120 s"},
      {"100 years", [&](Approval& a) { a.expires_at = at(3.15e9); }, "Valid for longer than 120 s"},
      {"0.9 s ahead", [&](Approval& a) { a.approved_at = at(1.9); }, ""},
      {"1.1 s ahead", [&](Approval& a) { a.approved_at = at(2.1); },
       "Given more than 1 s ahead of the vehicle's clock"},
      {"before time", [](Approval& a) { a.approved_at = {-1}; }, "Its times are out of range"},
      {"least stamp", [](Approval& a) { a.approved_at = {INT64_MIN}; },
       "Its times are out of range"},
      {"last stamp", [](Approval& a) { a.expires_at = {INT64_MAX}; }, "Its times are out of range"},
      {"north", [=](Approval& a) { a.p_WS.x() = nan; }, "The site's position is not a number"},
      {"down", [=](Approval& a) { a.p_WS.z() = -inf; }, "The site's position is not a number"},
      {"heading", [=](Approval& a) { a.approach_heading_rad = nan; },
       "The approach heading is not a number"},
      {"glide", [=](Approval& a) { a.glide_slope_rad = inf; }, "The glide slope is not a number"},
      {"rate", [=](Approval& a) { a.descent_rate_mps = nan; }, "The descent rate is not a number"},
      {"radius", [=](Approval& a) { a.clear_radius_m = nan; }, "The clear radius is not a number"},
      {"stop", [=](Approval& a) { a.stop_height_m = nan; },
       "The height to stop at is not a number"},
      {"99 m away",
       [](Approval& a) {
         a.p_WS = {99, 0, 0};
       },
       ""},
      {"101 m away",
       [](Approval& a) {
         a.p_WS = {0, 101, 0};
       },
       "The site is more than 100 m away"},
      {"above", [](Approval& a) { a.p_WS.z() = -15.1; }, "The site is above the vehicle"},
      {"50 m under ground", [](Approval& a) { a.p_WS.z() = 50; },
       "The site is not at the height of the ground"},
      {"in a hollow", [](Approval& a) { a.p_WS.z() = 8; }, ""},
      {"too deep", [](Approval& a) { a.p_WS.z() = 86; },
       "The site is more than 100 m below the vehicle"},
      {"many turns", [](Approval& a) { a.approach_heading_rad = 7; },
       "The approach heading is more than one turn"},
      {"level", [](Approval& a) { a.glide_slope_rad = 0; },
       "The glide slope is outside 0 to 90 degrees"},
      {"overhanging", [](Approval& a) { a.glide_slope_rad = 1.6; },
       "The glide slope is outside 0 to 90 degrees"},
      {"rising", [](Approval& a) { a.descent_rate_mps = -1; },
       "The descent rate is outside 0 to 5 m/s"},
      {"falling", [](Approval& a) { a.descent_rate_mps = 6; },
       "The descent rate is outside 0 to 5 m/s"},
      {"no radius", [](Approval& a) { a.clear_radius_m = 0; },
       "The clear radius that is asked for is outside 0.5 to 25 m"},
      {"wide", [](Approval& a) { a.clear_radius_m = 26; },
       "The clear radius that is asked for is outside 0.5 to 25 m"},
      {"a look", [](Approval& a) { a.stop_height_m = 12; }, ""},
      {"a look from the ground", [](Approval& a) { a.stop_height_m = 2.9; },
       "The height to stop at is below 3 m"},
      {"a look from below", [](Approval& a) { a.stop_height_m = -12; },
       "The height to stop at is below 3 m"},
      {"a look from above", [](Approval& a) { a.stop_height_m = 40; },
       "The height to stop at is above the vehicle"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    Pair pair;
    ASSERT_TRUE(pair.commands);
    Approval approval = GoodApproval();
    row.change(approval);
    approval = Sealed(pair.station, approval);
    EXPECT_EQ(pair.verifier.Verify(approval, Hovering()), row.why);
    EXPECT_EQ(pair.verifier.IsRepeat(approval), row.why[0] == 0);
    // The next has a counter of its own.
    EXPECT_EQ(pair.verifier.Verify(Sealed(pair.station, GoodApproval(72)), Hovering()), "");
  }
}

TEST(ApprovalVerifier, WithoutKnownGroundDepthAloneBoundsTheHeight) {
  Pair pair;
  VehicleSituation vehicle = Hovering();
  vehicle.ground_down_m = NAN;
  Approval approval = GoodApproval();
  approval.p_WS.z() = 50;
  EXPECT_EQ(pair.verifier.Verify(Sealed(pair.station, approval), vehicle), "");
}

// I8: the answer was lost. A copy, to the byte or sealed anew, is answered; anything else is none.
TEST(ApprovalVerifier, KnowsTheLastAcceptedAgain) {
  Pair pair;
  const Approval given = Sealed(pair.station, GoodApproval());
  EXPECT_FALSE(pair.verifier.IsRepeat(given));
  ASSERT_EQ(pair.verifier.Verify(given, Hovering()), "");
  EXPECT_TRUE(pair.verifier.IsRepeat(given));
  EXPECT_EQ(pair.verifier.Verify(given, Hovering()), "Counter 1 was already used");
  EXPECT_TRUE(pair.verifier.IsRepeat(Sealed(pair.station, GoodApproval())));
  Approval forged = given;
  forged.seal.mac[3] ^= 1;
  EXPECT_FALSE(pair.verifier.IsRepeat(forged));
  Approval moved = GoodApproval();
  moved.clear_radius_m += 1;
  EXPECT_FALSE(pair.verifier.IsRepeat(Sealed(pair.station, moved)));
  ASSERT_EQ(pair.verifier.Verify(Sealed(pair.station, GoodApproval(72)), Hovering()), "");
  EXPECT_FALSE(pair.verifier.IsRepeat(given));
}

// Refused while the vehicle could not fly it, played again when it could: recorded, it is worth
// nothing. A copy is refused with the words of the first answer, which may have been lost.
TEST(ApprovalVerifier, WhatWasRefusedIsRefusedForEver) {
  Pair pair;
  const Approval refused = Sealed(pair.station, GoodApproval());
  EXPECT_EQ(pair.verifier.Verify(refused, Hovering(), "climbing"), "climbing");
  EXPECT_EQ(pair.verifier.Verify(refused, Hovering()), "climbing");
  Approval forged = refused;
  forged.seal.mac[3] ^= 1;
  EXPECT_EQ(pair.verifier.Verify(forged, Hovering()), "Seal does not match");
  EXPECT_FALSE(pair.verifier.IsRepeat(refused));
  // Out of reach now, in reach later.
  VehicleSituation far = Hovering();
  far.p_WB.x() = 500;
  const Approval early = Sealed(pair.station, GoodApproval(72));
  EXPECT_EQ(pair.verifier.Verify(early, far), "The site is more than 100 m away");
  EXPECT_EQ(pair.verifier.Verify(early, Hovering()), "The site is more than 100 m away");
  EXPECT_EQ(pair.verifier.Verify(refused, Hovering()), "Counter 1 was already used");
  // The operator gives it anew: a counter of its own.
  EXPECT_EQ(pair.verifier.Verify(Sealed(pair.station, GoodApproval(72)), Hovering()), "");
}

TEST(ApprovalVerifier, OnABenchSensePassesWithoutASeal) {
  VehicleTrust trust = VehicleOf({});
  trust.takes_unsealed = true;
  VehicleAuthority bench(trust);
  ApprovalVerifier verifier(bench);
  EXPECT_EQ(verifier.Verify(GoodApproval(), Hovering()), "");
  EXPECT_TRUE(verifier.IsRepeat(GoodApproval()));
  Approval nonsense = GoodApproval(72);
  nonsense.p_WS.y() = NAN;
  EXPECT_EQ(verifier.Verify(nonsense, Hovering()), "The site's position is not a number");
}

}  // namespace
}  // namespace palace
