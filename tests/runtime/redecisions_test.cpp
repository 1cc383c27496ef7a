// What other limits decide is compared map for map, by place; nothing else is a difference.
#include "engine/runtime/redecisions.h"

#include <gtest/gtest.h>

#include "engine/runtime/recorded_names.h"

namespace palace {
namespace {

LandingSite SiteAt(const char* letter, double north_m, double east_m) {
  LandingSite site;
  site.id = static_cast<std::uint64_t>(letter[0]);
  site.letter = letter;
  site.p_WS = {north_m, east_m, 0};
  site.safe_distance_m = 4;
  site.reason = "0.6 m less clear than A";
  return site;
}

TerrainDecision Map(std::vector<LandingSite> sites) {
  TerrainDecision decision;
  decision.map_time = {1000};
  decision.selection.sites = std::move(sites);
  return decision;
}

TEST(Redecisions, ComparesPlacesNotLetters) {
  const struct {
    const char* what;
    std::vector<LandingSite> recorded, now;
    bool differs;
  } table[] = {{"the same", {SiteAt("A", 0, 0)}, {SiteAt("A", 0, 0)}, false},
               {"renamed", {SiteAt("A", 0, 0)}, {SiteAt("H", 0.4, 0)}, false},
               {"another place, one letter", {SiteAt("A", 0, 0)}, {SiteAt("A", 4, 0)}, true},
               {"lost", {SiteAt("A", 0, 0)}, {}, true},
               {"found", {}, {SiteAt("A", 0, 0)}, true},
               {"none either way", {}, {}, false}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.what);
    const RedecidedSample sample = CompareDecisions({7}, Map(row.recorded), Map(row.now));
    EXPECT_EQ(sample.differs, row.differs);
    EXPECT_EQ(sample.recorded, row.recorded.empty() ? "" : row.recorded[0].letter);
    EXPECT_EQ(sample.best_site, row.now.empty() ? "" : row.now[0].letter);
    EXPECT_EQ(sample.time.us, 7);
  }
}

TEST(Redecisions, OneSampleATimeInOrderHoweverTheLogWasPlayed) {
  Redecisions redecisions;
  EXPECT_EQ(redecisions.Publish(), nullptr);
  const auto add = [&](std::int64_t us, const char* letter) {
    RedecidedSample sample;
    sample.time = {us};
    sample.best_site = letter;
    redecisions.Add(sample, false);
  };
  add(50, "a");
  const auto published = redecisions.Publish();
  for (const int us : {70, 10, 30, 50}) {
    add(us, us == 50 ? "b" : "a");
  }
  EXPECT_EQ(published->size(), 1u) << "what is published never changes";
  const auto all = redecisions.Publish();
  ASSERT_EQ(all->size(), 4u);
  for (std::size_t i = 1; i < all->size(); ++i) {
    EXPECT_LT((*all)[i - 1].time, (*all)[i].time);
  }
  EXPECT_EQ((*all)[2].best_site, "b") << "judged again";
  redecisions.Forget();
  EXPECT_EQ(redecisions.Publish(), nullptr);
}

TEST(RecordedNames, SitesHaveTheLettersOfTheFlight) {
  const RecordedProposal proposal{{500}, {{7, "K", {0.2, 0}}, {3, "B", {5, 5}}}};
  const auto map = std::make_shared<const TerrainDecision>(
      Map({SiteAt("A", 0, 0), SiteAt("B", 9, 9), SiteAt("C", 5.3, 5)}));
  const auto named = NamedByRecord(map, proposal, /*limits_of_flight=*/false);
  const std::vector<LandingSite>& sites = named->selection.sites;
  EXPECT_EQ(sites[0].letter, "K");
  EXPECT_EQ(sites[0].id, 7u);
  EXPECT_EQ(sites[1].letter, "b") << "the record knows no place there";
  EXPECT_NE(sites[1].id, 3u);
  EXPECT_EQ(sites[2].letter, "B");
  EXPECT_EQ(sites[2].id, 3u);
  EXPECT_EQ(sites[2].reason, "0.6 m less clear than K");
}

// B led when the map began to favour A, and goes on leading: a map built anew cannot know that.
TEST(RecordedNames, UnderTheLimitsOfTheFlightTheSitesStandAsTheyStood) {
  const RecordedProposal proposal{{500}, {{3, "B", {5, 5}}, {7, "K", {0.2, 0}}}};
  const auto map = std::make_shared<const TerrainDecision>(
      Map({SiteAt("A", 0, 0), SiteAt("B", 9, 9), SiteAt("C", 5.3, 5)}));
  const auto letters = [&](bool limits_of_flight) {
    std::string all;
    const auto named = NamedByRecord(map, proposal, limits_of_flight);
    for (const LandingSite& site : named->selection.sites) {
      all += site.letter;
    }
    return all;
  };
  EXPECT_EQ(letters(false), "KbB");
  EXPECT_EQ(letters(true), "BKb");
}

TEST(Redecisions, WhatWasDecidedFromTheStartIsNotReplacedAfterAJump) {
  Redecisions redecisions;
  const auto add = [&](const char* letter, bool from_start) {
    RedecidedSample sample;
    sample.time = {50};
    sample.best_site = letter;
    redecisions.Add(sample, from_start);
    return redecisions.Publish()->front().best_site;
  };
  EXPECT_EQ(add("a", false), "a");
  EXPECT_EQ(add("b", false), "b");
  EXPECT_EQ(add("c", true), "c");
  EXPECT_EQ(add("d", false), "c");
  EXPECT_EQ(add("e", true), "e");
  redecisions.Forget();
  EXPECT_EQ(add("f", false), "f");
}

}  // namespace
}  // namespace palace
