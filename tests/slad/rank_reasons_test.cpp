// Order and reasons of a list agree: where the order is not what figures suggest, the reason says
// it.
#include "engine/slad/sites/rank_reasons.h"

#include <limits>

#include <gtest/gtest.h>

#include "engine/model/site_standing.h"
#include "engine/slad/sites/site_candidates.h"

namespace palace {
namespace {

LandingSite Of(const char* letter, double safe_distance_m, bool confirmed = true,
               bool straight = true) {
  LandingSite site;
  site.letter = letter;
  site.safe_distance_m = safe_distance_m;
  site.confirmed = confirmed;
  site.corridor_clear = straight;
  return site;
}

SiteSelection Reasoned(std::vector<LandingSite> sites) {
  SiteSelection selection;
  selection.sites = std::move(sites);
  GiveReasons(SiteRanking::kFarthest, 0.15, selection);
  return selection;
}

TEST(RankReasons, AConfirmedSiteBelowAProvisionalOneSaysThatRoomRanks) {
  const SiteSelection list = Reasoned({Of("A", 4.8, false), Of("B", 4.2), Of("C", 4.0, false)});
  EXPECT_EQ(list.sites[1].reason, "0.6 m less clear than the best, though confirmed");
  EXPECT_EQ(list.sites[2].reason, "0.8 m less clear than the best");
}

TEST(RankReasons, AWiderSiteBelowANarrowerOneSaysWhyItDoesNotPassIt) {
  const SiteSelection list = Reasoned({Of("A", 4.8), Of("B", 4.0), Of("C", 4.4), Of("D", 4.42)});
  EXPECT_EQ(list.sites[1].reason, "0.8 m less clear than the best");
  EXPECT_EQ(list.sites[2].reason, "0.4 m less clear than the best; better than B (noise, or new)");
  EXPECT_EQ(list.sites[3].reason, "0.4 m less clear than the best");
}

TEST(RankReasons, TheOnlyClearApproachIsTheOnlyOneOfTheList) {
  EXPECT_EQ(Reasoned({Of("A", 4), Of("B", 5, true, false)}).sites[0].reason,
            "The only straight approach that is clear");
  EXPECT_NE(Reasoned({Of("A", 4), Of("B", 5, true, false), Of("C", 3)}).sites[0].reason,
            "The only straight approach that is clear");
}

TEST(RankReasons, WideGroundWhereThingsMayHideGoesBelowAndSaysSo) {
  std::vector<LandingSite> sites = {Of("A", 4.8), Of("B", 6.0, false), Of("C", 4.0)};
  sites[0].hidden_things = 0.004;
  sites[1].hidden_things = 0.12;
  sites[2].hidden_things = 0.01;
  for (LandingSite& site : sites) {
    site.clear_radius_m = 2.3;
  }
  const SiteSelection list = Reasoned(sites);
  EXPECT_EQ(list.sites[0].reason, "Leads: 0.004 rocks or holes may hide, at the next 0.12");
  EXPECT_EQ(list.sites[1].reason, "0.12 rocks or holes may hide, at the best 0.004");
  EXPECT_EQ(list.sites[2].reason.rfind("0.8 m less clear than the best", 0), 0U)
      << list.sites[2].reason;
  sites[1].flags = kFlagUnexplained;
  EXPECT_EQ(Reasoned(sites).sites[1].reason, "0.12 things may hide, at the best 0.004");
}

TEST(RankReasons, ATightSiteBelowARoomyOneSaysByHowMuchItIsTight) {
  std::vector<LandingSite> sites = {Of("A", 3.2), Of("B", 2.34), Of("C", 2.6)};
  for (LandingSite& site : sites) {
    site.clear_radius_m = 2.3;
    site.clearance_m = site.safe_distance_m - site.clear_radius_m;
  }
  const SiteSelection list = Reasoned(sites);
  EXPECT_EQ(list.sites[1].reason, "0.04 m beyond the clear radius, at the best 0.90 m");
  EXPECT_EQ(list.sites[2].reason, "0.6 m less clear than the best; better than B (noise, or new)");
}

TEST(RankReasons, RoomCountsAboutAClearRadiusLessForEachTenfoldThatMayHide) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const double sure : {0.0, 1e-9, unknown}) {
    EXPECT_NEAR(RankedRoom(3.0, sure, 2.3), 3.0, 1e-6) << sure;
  }
  EXPECT_NEAR(RankedRoom(3.0, 9 * kMostHidden, 2.3), 0.7, 1e-12);
  EXPECT_NEAR(RankedRoom(3.0, 99 * kMostHidden, 2.3), -1.6, 1e-12);
}

}  // namespace
}  // namespace palace
