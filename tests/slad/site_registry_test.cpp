// Sites over the maps of a flight: letters, places and ranks that stand, and what ends them.
#include "engine/slad/sites/site_registry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/slad/hazards/hazard_maps.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::WithBox;

constexpr double kPeriod_s = 0.1;

/// A hover above the middle of a map of 15 m by 15 m, a map every 0.1 s.
class Hover {
 public:
  SiteSelection See(const Height& ground, double north_m = 0, double sigma_m = 0) {
    ElevationMap map = MakeMap(100, 100, 0.15, ground, sigma_m, ++maps_);
    map.geometry.north_min_m += north_m;
    map.time = {static_cast<std::int64_t>(maps_ * 100'000)};
    return Judge(map, registry_);
  }
  SiteSelection Judge(const ElevationMap& map, SiteRegistry& registry) {
    SiteContext context;
    context.p_WB = {0, 0, -15};
    context.time = map.time;
    return registry.Select(map, EvaluateHazards(map, settings), settings, context);
  }
  /// What the last of so many maps of the same ground shows.
  SiteSelection SeeOften(int maps, const Height& ground) {
    SiteSelection selection;
    for (int i = 0; i < maps; ++i) {
      selection = See(ground);
    }
    return selection;
  }

  SladSettings settings;
  SiteRegistry registry_;

 private:
  std::uint64_t maps_ = 0;
};

std::string LettersOf(const SiteSelection& selection) {
  std::string letters;
  for (const LandingSite& site : selection.sites) {
    letters += site.letter;
  }
  return letters;
}

const LandingSite* Find(const SiteSelection& selection, const std::string& letter) {
  for (const LandingSite& site : selection.sites) {
    if (site.letter == letter) {
      return &site;
    }
  }
  return nullptr;
}

TEST(SiteLetters, GoOnAfterTheAlphabet) {
  const std::map<std::size_t, std::string> letters = {{0, "A"},   {8, "J"},       {13, "P"},
                                                      {23, "Z"},  {24, "A2"},     {47, "Z2"},
                                                      {48, "A3"}, {24 * 9, "A10"}};
  for (const auto& [n, letter] : letters) {
    EXPECT_EQ(SiteLetter(n), letter);
  }
}

// What each of the first frames adds moves places about: none of them is named before all that will
// be remembered is. A folder's one picture is listed at once.
TEST(SiteRegistry, AFlightListsOnceItsMapsRememberAllTheyWill) {
  Hover hover;
  hover.settings.fusion.frames_fused = 6;
  hover.registry_.WaitForMemory(true);
  SiteSelection list = hover.SeeOften(5, WithBox(Flat(), 0, 0, 0.5, 0.6));
  EXPECT_TRUE(list.sites.empty());
  EXPECT_TRUE(list.waits);
  EXPECT_EQ(list.none_reason, "places are listed once 6 pictures are fused, now 5");
  list = hover.See(WithBox(Flat(), 0, 0, 0.5, 0.6));
  ASSERT_FALSE(list.sites.empty());
  EXPECT_FALSE(list.waits);
  EXPECT_EQ(list.sites.front().letter, "A");
  hover.settings.fusion.frames_fused = 50;  // what was listed stays
  EXPECT_FALSE(hover.See(WithBox(Flat(), 0, 0, 0.5, 0.6)).sites.empty());
  hover.registry_.Reset(SiteNames::kGoOn);
  EXPECT_TRUE(hover.See(WithBox(Flat(), 0, 0, 0.5, 0.6)).sites.empty());
  hover.registry_.GoOnWith({}, hover.settings);  // its record lists none yet either
  EXPECT_TRUE(hover.See(WithBox(Flat(), 0, 0, 0.5, 0.6)).waits);

  Hover folder;
  EXPECT_FALSE(folder.See(WithBox(Flat(), 0, 0, 0.5, 0.6)).sites.empty());
}

// The wide north is seen with little of its air, and from here no way down shows more.
TEST(SiteRegistry, WhatCannotBeApprovedForItsAirComesAfterWhatCan) {
  Hover hover;
  SiteSelection list;
  for (std::uint64_t i = 1; i <= 6; ++i) {
    ElevationMap map = MakeMap(100, 100, 0.15, WithBox(Flat(), -3, 0, 0.5, 0.6), 0, i);
    map.time = {static_cast<std::int64_t>(i * 100'000)};
    map.air_seen_to_m = GridF(100, 100, 3.0F);
    for (int r = 50; r < 100; ++r) {
      std::fill_n(map.air_seen_to_m.row(r), 100, 9.0F);
    }
    list = hover.Judge(map, hover.registry_);
  }
  ASSERT_GE(list.sites.size(), 2u);
  EXPECT_GE(list.sites.front().air_seen_m, kLeastAirSeen_m);
  const auto low = std::find_if(list.sites.begin(), list.sites.end(),
                                [](const LandingSite& site) { return !IsAirShown(site); });
  ASSERT_NE(low, list.sites.end());
  EXPECT_GT(low->safe_distance_m, list.sites.front().safe_distance_m);
  EXPECT_EQ(low->reason, "Too little of the air over it is seen from here");
  EXPECT_TRUE(std::all_of(low, list.sites.end(),
                          [](const LandingSite& site) { return !IsAirShown(site); }));
}

TEST(SiteRegistry, ALetterStaysWithItsPlaceAndIsNeverGivenTwice) {
  Hover hover;
  std::map<std::string, Eigen::Vector2d> places;
  // Out for 300 m in strides as wide as the map, and back: more places than letters.
  std::set<std::uint64_t> ids;
  for (int stride = -40; stride <= 40; ++stride) {
    const double north_m = 7.5 * (40 - std::abs(stride));
    for (int map = 0; map < 4; ++map) {
      for (const LandingSite& site : hover.See(Flat(), north_m).sites) {
        const auto [known, is_new] = places.try_emplace(site.letter, site.p_WS.head<2>());
        ASSERT_LT((known->second - site.p_WS.head<2>()).norm(), hover.settings.choice.spacing_m / 4)
            << site.letter;
        ids.insert(site.id);
      }
    }
  }
  EXPECT_EQ(ids.size(), places.size());
  EXPECT_TRUE(places.count("A2"));
}

// Another frame of positions is no new flight: what A was no other place becomes.
TEST(SiteRegistry, LettersGoOnAfterTheMapsBegunAnewAndStartAgainInAnotherFlight) {
  Hover hover;
  const SiteSelection before = hover.SeeOften(4, Flat());
  const std::string last = SiteLetter(static_cast<std::size_t>(before.named));
  hover.registry_.Reset(SiteNames::kGoOn);
  EXPECT_EQ(hover.See(Flat()).sites.front().letter, last);
  SiteRegistry restarted;
  restarted.GoOnNaming(before.named);
  std::swap(restarted, hover.registry_);
  const SiteSelection after = hover.See(Flat());
  EXPECT_EQ(after.sites.front().letter, last);
  for (const LandingSite& site : before.sites) {
    EXPECT_NE(after.sites.front().id, site.id);
  }
  hover.registry_.Reset(SiteNames::kAnew);
  EXPECT_EQ(hover.See(Flat()).sites.front().letter, "A");
}

// The best point of a map moves a little with every frame.
TEST(SiteRegistry, OverStillGroundNothingMoves) {
  Hover hover;
  const Height ground = WithBox(WithBox(Flat(), 3, 4, 0.8, 0.6), -4, -2, 0.8, 0.6);
  const SiteSelection first = hover.See(ground, 0, 0.01);
  for (int i = 0; i < 100; ++i) {
    const SiteSelection now = hover.See(ground, 0, 0.01);
    ASSERT_EQ(now.sites.front().letter, "A") << i;
    for (const LandingSite& site : first.sites) {
      const LandingSite* same = Find(now, site.letter);
      ASSERT_TRUE(same == nullptr || same->p_WS.head<2>() == site.p_WS.head<2>()) << site.letter;
    }
  }
}

TEST(SiteRegistry, WhatOneMapCallsUnsafeLeavesWithItAndStandsBehindTheOthersForAWhile) {
  Hover hover;
  const SiteSelection before = hover.SeeOften(5, Flat());
  ASSERT_GE(before.sites.size(), 3u);
  ASSERT_EQ(before.sites[0].letter, "A");
  const Eigen::Vector3d p_WS = before.sites[0].p_WS;
  const Height false_cell = WithBox(Flat(), p_WS.x(), p_WS.y(), 0.2, 0.6);
  EXPECT_EQ(Find(hover.See(false_cell), "A"), nullptr) << "at once";
  EXPECT_EQ(Find(hover.SeeOften(2, Flat()), "A"), nullptr);
  SiteSelection after = hover.See(Flat());
  ASSERT_NE(Find(after, "A"), nullptr) << "after 3 maps";
  EXPECT_EQ(Find(after, "A")->id, before.sites[0].id);
  EXPECT_NE(after.sites[0].letter, "A") << "though it is the widest again";
  EXPECT_EQ(Find(after, "A")->reason, "Called unsafe 0 s before, ranks as 2.3 m narrower");
  EXPECT_EQ(after.sites[0].reason.find("Widest"), std::string::npos) << after.sites[0].reason;
  EXPECT_NE(hover.SeeOften(290, Flat()).sites[0].letter, "A");
  EXPECT_EQ(hover.SeeOften(10, Flat()).sites[0].letter, "A") << "30 s later";
}

TEST(SiteRegistry, GroundThatIsOutOfViewStandsBehindWhatIsSeen) {
  // Two clear halves; what was best is not seen any more.
  Hover hover;
  const Height ground = WithBox(WithBox(Flat(), 0, 0, 0.6, 0.8), -6.9, 0, 0.6, 0.8);
  const std::string best = hover.SeeOften(30, ground).sites.at(0).letter;
  const auto seen = [&](double unseen_s) {
    ElevationMap map = MakeMap(100, 100, 0.15, ground);
    map.time = {static_cast<std::int64_t>(4'000'000 + unseen_s * 1e6)};
    const LandingSite* site = nullptr;
    const SiteSelection before = hover.See(ground);
    site = Find(before, best);
    map.age_s = GridF(100, 100, 0.0F);
    for (int r = 0; r < 100; ++r) {
      for (int c = 0; c < 100; ++c) {
        const double off_m = std::hypot(map.geometry.NorthOfRow(r) - site->p_WS.x(),
                                        map.geometry.EastOfCol(c) - site->p_WS.y());
        map.age_s.at(r, c) = off_m < 2.5 ? static_cast<float>(unseen_s) : 0.0F;
      }
    }
    return hover.Judge(map, hover.registry_);
  };
  EXPECT_EQ(seen(1.5).sites.at(0).letter, best) << "younger than an approval asks for";
  const SiteSelection old = seen(30);
  EXPECT_NE(old.sites.at(0).letter, best);
  ASSERT_NE(Find(old, best), nullptr) << "it is listed all the same";
  EXPECT_EQ(Find(old, best)->reason, "Ground last measured 30 s ago");
}

TEST(SiteRegistry, OneFramesBlunderInTheFusedMapChangesNoRank) {
  Hover hover;
  const SiteSelection before = hover.SeeOften(30, Flat());
  const std::string letters = LettersOf(before);
  // Takes room from the best site, but leaves it its clear radius.
  const Eigen::Vector3d at = before.sites[0].p_WS + Eigen::Vector3d(0, 2.7, 0);
  const Height false_cell = WithBox(Flat(), at.x(), at.y(), 0.2, 0.6);
  for (int map = 0; map < kWorseAfter_maps - 2; ++map) {
    const SiteSelection now = hover.See(false_cell);
    ASSERT_EQ(now.sites[0].letter, "A") << map;
    ASSERT_LT(now.sites[0].safe_distance_m, 3) << "the figure is that of the newest map";
  }
  EXPECT_EQ(hover.SeeOften(3, Flat()).sites[0].letter, "A");
  // What stays counts.
  EXPECT_NE(hover.SeeOften(kWorseAfter_maps + kBetterAfter_maps, false_cell).sites[0].letter, "A");
}

TEST(SiteRegistry, ABetterPointReplacesAPlaceUnlessItIsSelected) {
  for (const bool selected : {false, true}) {
    Hover hover;
    // Between two walls the middle is best; then one of them turns out to be none.
    const Height walls = WithBox(WithBox(Flat(), 9.5, 0, 12, 1), -9.5, 0, 12, 1);
    const Height one_wall = WithBox(Flat(), -9.5, 0, 12, 1);
    const LandingSite a = hover.SeeOften(kBetterAfter_maps, walls).sites[0];
    ASSERT_EQ(a.letter, "A");
    hover.registry_.Keep(selected ? a.id : 0);
    EXPECT_NE(Find(hover.SeeOften(kBetterAfter_maps - 1, one_wall), "A"), nullptr);
    const SiteSelection after = hover.SeeOften(2, one_wall);
    ASSERT_FALSE(after.sites.empty());
    if (selected) {
      EXPECT_NE(Find(after, "A"), nullptr);
    } else {
      EXPECT_NE(after.sites[0].letter, "A") << "the better point is listed at once";
      EXPECT_GT(after.sites[0].safe_distance_m, a.safe_distance_m + 1);
    }
  }
}

// Half a metre beside where it was, it is the same place to everybody who looks.
TEST(SiteRegistry, APlaceWhoseBestPointMovesALittleKeepsItsLetterUnlessItIsSelected) {
  for (const bool selected : {false, true}) {
    Hover hover;
    const Height before = WithBox(WithBox(Flat(), 9.5, 0, 12, 1), -9.5, 0, 12, 1);
    const Height after = WithBox(WithBox(Flat(), 10.7, 0, 12, 1), -9.5, 0, 12, 1);
    const LandingSite a = hover.SeeOften(kBetterAfter_maps, before).sites[0];
    ASSERT_EQ(a.letter, "A");
    hover.registry_.Keep(selected ? a.id : 0);
    const SiteSelection list = hover.SeeOften(2 * kBetterAfter_maps, after);
    const LandingSite* now = Find(list, "A");
    ASSERT_NE(now, nullptr);
    EXPECT_EQ(now->id, a.id);
    const double moved_m = (now->p_WS - a.p_WS).head<2>().norm();
    if (selected) {
      EXPECT_EQ(moved_m, 0) << "what was selected stays where it is";
    } else {
      EXPECT_GT(moved_m, 0.3);
      EXPECT_LT(moved_m, hover.settings.choice.spacing_m / 4);
      EXPECT_GT(now->safe_distance_m, a.safe_distance_m + 0.3);
    }
  }
}

TEST(SiteRegistry, APlaceThatStoodShortFallsSoon) {
  const Height walls = WithBox(WithBox(Flat(), 9.5, 0, 12, 1), -9.5, 0, 12, 1);
  const Height one_wall = WithBox(Flat(), -9.5, 0, 12, 1);
  for (const int stood : {1, 2, 3}) {
    Hover hover;
    ASSERT_EQ(hover.SeeOften(stood, walls).sites.at(0).letter, "A");
    EXPECT_NE(Find(hover.SeeOften(std::max(2, stood) - 1, one_wall), "A"), nullptr) << stood;
    EXPECT_EQ(Find(hover.See(one_wall), "A"), nullptr) << stood;
  }
}

TEST(LastingClaim, HoldsAfterAsManyMapsAsStoodAgainstIt) {
  struct Row {
    int stood, holds_after;
  };
  for (const Row row : {Row{1, 2}, {2, 2}, {3, 3}, {10, 10}, {24, 24}, {90, 24}}) {
    LastingClaim claim;
    for (int map = 2; map <= row.stood; ++map) {
      EXPECT_FALSE(claim.Add(false, 24)) << row.stood;
    }
    for (int map = 1; map < row.holds_after; ++map) {
      EXPECT_FALSE(claim.Add(true, 24)) << row.stood << ' ' << map;
    }
    EXPECT_TRUE(claim.Add(true, 24)) << row.stood;
  }
  LastingClaim recorded(24);
  EXPECT_FALSE(recorded.Add(true, 24)) << "nobody says how long it has stood";
}

TEST(SiteRegistry, APlaceThatACellLessOfRoomWouldEndStandsBehindRoomyOnes) {
  // A lane of 4.8 m, level, opens to one of 5.8 m that climbs.
  const Height lane =
      WithBox(WithBox(WithBox(Flat(), -8.4, -1, 12, 1), 8.4, -7, 12, 1), 9.4, 7, 12, 1);
  const Height ground = [&](double north_m, double east_m) {
    return lane(north_m, east_m) + 0.03 * std::max(0.0, east_m);
  };
  Hover hover;
  hover.settings.choice.ranking = SiteRanking::kCost;
  const SiteSelection list = hover.SeeOften(5, ground);
  ASSERT_GE(list.sites.size(), 2U);
  const LandingSite& best = list.sites[0];
  EXPECT_GE(best.clearance_m, 0.15);
  const auto tight = std::find_if(list.sites.begin(), list.sites.end(),
                                  [](const LandingSite& s) { return s.clearance_m < 0.15; });
  ASSERT_NE(tight, list.sites.end());
  EXPECT_LT(tight->cost, best.cost) << "though it is the cheaper one";
}

TEST(SiteRegistry, ARecordedFlightGoesOnWithItsPlaces) {
  Hover hover;
  // Where no fresh list would put them, in an order that it would not have.
  const std::vector<RecordedPlace> places = {{9, "K", {-2.5, 3.1}}, {4, "D", {3.1, -2.5}}};
  hover.registry_.GoOnWith(places, hover.settings);
  const SiteSelection list = hover.See(Flat());
  for (const RecordedPlace& place : places) {
    const LandingSite* site = Find(list, place.letter);
    ASSERT_NE(site, nullptr) << place.letter;
    EXPECT_EQ(site->id, place.id);
    EXPECT_EQ(site->p_WS.head<2>(), place.north_east_m);
  }
  // Ground that cannot bear the lander bears it under no name.
  Hover blocked;
  blocked.registry_.GoOnWith(places, blocked.settings);
  EXPECT_EQ(Find(blocked.See(WithBox(Flat(), -2.5, 3.1, 0.6, 1)), "K"), nullptr);
}

TEST(SiteRegistry, WhatARecordDoesNotListGetsLettersAndIdsThatItDoesNotUse) {
  Hover hover;
  hover.registry_.GoOnWith({{2, "A", {-4, 3}}}, hover.settings);
  std::set<std::string> letters;
  std::set<std::uint64_t> ids;
  const SiteSelection list = hover.SeeOften(5, Flat());
  for (const LandingSite& site : list.sites) {
    EXPECT_TRUE(letters.insert(site.letter).second) << site.letter;
    EXPECT_TRUE(ids.insert(site.id).second) << site.id;
  }
  EXPECT_EQ(letters.count("A"), 1U);
  EXPECT_GE(letters.size(), 2U);
}

TEST(SiteRegistry, TheSameMapAgainAndOtherLimitsOnACopyChangeNothing) {
  Hover hover;
  const SiteSelection before = hover.SeeOften(5, Flat());
  ElevationMap map = MakeMap(100, 100, 0.15, Flat());
  map.time = {1'000'000};
  SiteRegistry copy = hover.registry_;
  const SiteSelection once = hover.Judge(map, copy);
  SiteRegistry again = copy;
  const SiteSelection twice = hover.Judge(map, again);
  EXPECT_EQ(LettersOf(once), LettersOf(twice));
  // Under other limits nothing waits: the preview shows what they would do.
  SiteRegistry other = hover.registry_;
  hover.settings.lander.nav_error_m = 2;
  const SiteSelection preview = hover.Judge(map, other);
  ASSERT_FALSE(preview.sites.empty());
  EXPECT_EQ(preview.sites[0].letter, before.sites[0].letter);
  hover.settings = {};
  EXPECT_EQ(LettersOf(hover.See(Flat())), LettersOf(before));
}

// A preview and a sweep ask what a limit does: what one map alone would change is no answer.
TEST(SiteRegistry, UnderOtherLimitsAPlaceKeepsItsRowWhileItHolds) {
  Hover hover;
  const Height walls = WithBox(WithBox(Flat(), 9.5, 0, 12, 1), -9.5, 0, 12, 1);
  const SiteSelection before = hover.SeeOften(30, walls);
  ASSERT_EQ(before.sites[0].letter, "A");
  // 0.6 m beside it there is 0.6 m more room on this map.
  ElevationMap map =
      MakeMap(100, 100, 0.15, WithBox(WithBox(Flat(), 10.7, 0, 12, 1), -9.5, 0, 12, 1));
  map.time = {10'000'000};
  const auto best = [&](double max_slope_deg, double nav_error_m) {
    SiteRegistry copy = hover.registry_;
    copy.GiveNoLetters();
    hover.settings = {};
    hover.settings.limits.max_slope_deg = max_slope_deg;
    hover.settings.lander.nav_error_m = nav_error_m;
    const SiteSelection list = hover.Judge(map, copy);
    return list.sites.empty() ? std::string() : list.sites[0].letter;
  };
  EXPECT_EQ(best(10, 0.5), "A");
  EXPECT_EQ(best(11, 0.5), "A") << "another limit, which decides nothing here";
  EXPECT_NE(best(10, 2.0), "A") << "there it does not hold";
}

// A preview lists places that the flight never listed: it must not call them by letters that the
// flight gives to others.
TEST(SiteRegistry, ACopyThatGivesNoLettersNamesNothingTheFlightDidNot) {
  Hover hover;
  const SiteSelection before = hover.SeeOften(5, Flat());
  ElevationMap moved = MakeMap(100, 100, 0.15, Flat());
  moved.geometry.north_min_m += 7.5;
  moved.time = {1'000'000};
  SiteRegistry copy = hover.registry_;
  copy.GiveNoLetters();
  hover.settings.lander.nav_error_m = 0.4;
  const SiteSelection preview = hover.Judge(moved, copy);
  hover.settings = {};
  int known = 0, unnamed = 0;
  for (const LandingSite& site : preview.sites) {
    const LandingSite* same = Find(before, site.letter);
    if (!IsNamedSite(site.id)) {
      EXPECT_EQ(site.letter, "+" + std::to_string(++unnamed));
      EXPECT_EQ(same, nullptr);
    } else {
      ++known;
      ASSERT_NE(same, nullptr) << site.letter;
      EXPECT_EQ(same->id, site.id);
      EXPECT_EQ(same->p_WS.head<2>(), site.p_WS.head<2>()) << site.letter;
    }
  }
  EXPECT_GT(unnamed, 0);
  EXPECT_EQ(preview.named, before.named) << "no letter is spent";
  EXPECT_EQ(hover.See(Flat(), 7.5).named >= before.named, true);
}

/// One letter a map: c confirmed, p provisional.
TEST(SteadyVerdict, WorseCountsSoonerThanBetter) {
  const std::pair<const char*, const char*> rows[] = {
      {"ccccccc", "ccccccc"},           // the first map decides alone
      {"ppccccc", "ppppppc"},           // five in a row
      {"ccpccpcc", "cccccccc"},         // single maps change nothing
      {"cccppccc", "cccccccc"},         // two
      {"ccpcpcpcccc", "ccccccpppppc"},  // three of five
  };
  for (const auto& [maps, said] : rows) {
    SteadyVerdict verdict;
    std::string heard;
    for (const char* map = maps; *map != 0; ++map) {
      verdict.Add(*map == 'c');
      heard += verdict.good() ? 'c' : 'p';
    }
    EXPECT_EQ(heard, std::string(said).substr(0, heard.size())) << maps;
  }
}

TEST(SteadyFigure, FollowsOnlyWhatLasts) {
  SteadyFigure figure;
  const auto add = [&](double value, int maps) {
    for (int i = 0; i < maps; ++i) {
      figure.Add(value, 0.3);
    }
    return figure.value();
  };
  EXPECT_EQ(add(4, 1), 4);
  EXPECT_EQ(add(4.25, 100), 4) << "noise";
  EXPECT_EQ(add(3, kWorseAfter_maps - 1), 4);
  EXPECT_EQ(add(4.1, 1), 4);
  EXPECT_EQ(add(3, kWorseAfter_maps), 3);
  EXPECT_EQ(add(4, kBetterAfter_maps - 1), 3);
  EXPECT_EQ(add(4, 1), 4);
}

}  // namespace
}  // namespace palace
