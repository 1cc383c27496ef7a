// Order and reasons of a list agree: where the order is not what figures suggest, the reason says
// it.
#include <gtest/gtest.h>

#include "engine/slad/hazards/explanation.h"

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
  GiveReasons(SiteRanking::kFarthest, selection);
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
  EXPECT_EQ(list.sites[2].reason, "0.4 m less clear than the best; wider than B (noise, or new)");
  EXPECT_EQ(list.sites[3].reason, "0.4 m less clear than the best");
}

TEST(RankReasons, TheOnlyClearApproachIsTheOnlyOneOfTheList) {
  EXPECT_EQ(Reasoned({Of("A", 4), Of("B", 5, true, false)}).sites[0].reason,
            "The only straight approach that is clear");
  EXPECT_NE(Reasoned({Of("A", 4), Of("B", 5, true, false), Of("C", 3)}).sites[0].reason,
            "The only straight approach that is clear");
}

TEST(RankReasons, WideGroundThatIsNotSeenGoesBelowAndSaysSo) {
  std::vector<LandingSite> sites = {Of("A", 4.8), Of("B", 9.0, false), Of("C", 4.0)};
  sites[0].room_seen_m = 4.1;
  sites[1].room_seen_m = 2.2;
  const SiteSelection list = Reasoned(sites);
  EXPECT_EQ(list.sites[0].reason, "Leads: 1.9 m more seen than the next");
  EXPECT_EQ(list.sites[1].reason, "1.9 m less seen than the best");
  EXPECT_EQ(list.sites[2].reason.rfind("0.1 m less seen than the best", 0), 0U)
      << list.sites[2].reason;
}

}  // namespace
}  // namespace palace
