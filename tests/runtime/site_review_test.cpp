// What Review says of a site, what the maps colour and what the selection may offer are one answer.
#include "engine/runtime/site_review.h"

#include <gtest/gtest.h>

#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/site_selection.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::MakeMap;
using testing::WithBox;

SiteContext AboveTheMap() {
  SiteContext context;
  context.p_WB = {0, 0, -15};
  return context;
}

LandingSite SiteAt(const GridGeometry& g, Cell cell) {
  LandingSite site;
  site.letter = 'A';
  site.p_WS = {g.NorthOfRow(cell.row), g.EastOfCol(cell.col), 0};
  site.confirmed = true;
  return site;
}

TEST(SiteReview, KeepsExactlyTheCellsThatCanBearTheLander) {
  for (const SladMode mode : {SladMode::kModern, SladMode::kThesis}) {
    SladSettings settings;
    settings.mode = mode;
    const auto world = WithBox(WithBox(testing::Slope(Rad(4), 1), 1, 1, 1, 0.5), -4, 3, 0.6, 0.2);
    const ElevationMap map = MakeMap(71, 71, 0.15, world, 0.01, 5);
    const HazardMaps hazards = EvaluateHazards(map, settings);
    int kept = 0;
    for (int r = 0; r < 71; ++r) {
      for (int c = 0; c < 71; ++c) {
        const LandingSite site = SiteAt(map.geometry, {r, c});
        const auto now = RecheckSite(map, hazards, settings, site, AboveTheMap());
        const SiteReview review = ReviewSite(site, now, settings);
        ASSERT_EQ(review.kept, CanBearLander(hazards, {r, c})) << r << "," << c << review.reason;
        kept += review.kept ? 1 : 0;
      }
    }
    EXPECT_EQ(kept, hazards.safe_cells);
    EXPECT_GT(kept, 0);
    EXPECT_LT(kept, 71 * 71);
  }
}

TEST(SiteReview, RoomAloneKeepsNoSite) {
  // Far from every hazard, but steeper than a limit moved in Review allows.
  SladSettings settings;
  const ElevationMap map = MakeMap(81, 81, 0.15, testing::Slope(Rad(6), 0), 0.004, 3);
  const LandingSite site = SiteAt(map.geometry, {40, 40});
  const auto review = [&] {
    const HazardMaps hazards = EvaluateHazards(map, settings);
    return ReviewSite(site, RecheckSite(map, hazards, settings, site, AboveTheMap()), settings);
  };
  EXPECT_TRUE(review().kept) << review().reason;
  settings.max_slope_deg = 5;
  EXPECT_FALSE(review().kept);
  EXPECT_NE(review().reason.find("Slope"), std::string::npos) << review().reason;
  EXPECT_NE(review().reason.find("max 5°"), std::string::npos) << review().reason;
}

TEST(SiteReview, NamesASiteThatLeftTheMap) {
  const SiteReview review = ReviewSite(SiteAt({}, {0, 0}), std::nullopt, SladSettings{});
  EXPECT_FALSE(review.kept);
  EXPECT_EQ(review.reason, "Site A is not on this map.");
}

}  // namespace
}  // namespace palace
