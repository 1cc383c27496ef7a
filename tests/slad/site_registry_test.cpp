// Letters and ids that stay with their places.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/sites/site_selection.h"

namespace palace {
namespace {

TEST(SiteRegistry, LettersStayWithTheirPlaces) {
  SiteRegistry registry;
  const auto sites_at = [](std::vector<double> norths) {
    SiteSelection selection;
    for (const double north : norths) {
      LandingSite site;
      site.p_WS = {north, 0, 0};
      selection.sites.push_back(site);
    }
    return selection;
  };
  SiteSelection first = sites_at({0, 10, 20});
  registry.Assign(first);
  EXPECT_EQ(first.sites[0].letter, 'A');
  EXPECT_EQ(first.sites[2].letter, 'C');
  SiteSelection second = sites_at({20.6, 30, 0.5});
  registry.Assign(second);
  EXPECT_EQ(second.sites[0].letter, 'C');
  EXPECT_EQ(second.sites[0].id, first.sites[2].id);
  EXPECT_EQ(second.sites[1].letter, 'D');
  EXPECT_EQ(second.sites[2].letter, 'A');
  // Once the alphabet is spent, new places take the letters unused longest, with new ids.
  std::vector<double> rest;
  for (int i = 0; i < 22; ++i) {
    rest.push_back(100 + 10 * i);
  }
  SiteSelection many = sites_at(rest);
  registry.Assign(many);
  SiteSelection next = sites_at({500});
  registry.Assign(next);
  EXPECT_EQ(next.sites[0].letter, 'B');
  EXPECT_GT(next.sites[0].id, many.sites[21].id);
}

// The best place of a map moves a little with every frame: a letter that followed it would end up
// on another place than the one the operator was shown.
TEST(SiteRegistry, ASiteThatCreepsAwayLeavesItsLetterBehind) {
  SiteRegistry registry;
  for (const double north : {0.0, 1.0, 2.0, 3.0}) {
    SiteSelection selection;
    selection.sites.resize(1);
    selection.sites[0].p_WS = {north, 0, 0};
    registry.Assign(selection);
    EXPECT_EQ(selection.sites[0].letter, north < 1.5 ? 'A' : 'B') << north;
  }
}

}  // namespace
}  // namespace palace
