#include "engine/slad/hazards/explanation.h"

#include <gtest/gtest.h>

#include "engine/slad/sites/rank_reasons.h"
#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::Flat;
using testing::Height;
using testing::MakeMap;
using testing::Slope;
using testing::WithBox;
using testing::WithMode;

const ExplainedTerm* Decided(const CellExplanation& e) {
  const ExplainedTerm* found = nullptr;
  for (const ExplainedTerm& term : e.terms) {
    if (term.decided) {
      EXPECT_EQ(found, nullptr) << "two terms decide";
      found = &term;
    }
  }
  return found;
}

CellExplanation Explain(const ElevationMap& map, Cell cell, const SladSettings& settings = {}) {
  return ExplainCell(map, EvaluateHazards(map, settings), settings, cell);
}

/// A hole of 2x2 m nothing was measured in, about the origin.
Height WithHole(Height ground) {
  return [=](double n, double e) {
    return std::abs(n) < 1 && std::abs(e) < 1 ? std::nan("") : ground(n, e);
  };
}

struct Row {
  const char* name;
  Height world;
  Cell cell;
  std::optional<CellTerm> decided;
  const char* verdict;  // its beginning
};

class CellVerdict : public ::testing::TestWithParam<Row> {};

TEST_P(CellVerdict, NamesWhatDecided) {
  const Row& row = GetParam();
  const CellExplanation e = Explain(MakeMap(101, 101, 0.15, row.world), row.cell);
  const ExplainedTerm* decided = Decided(e);
  EXPECT_EQ(decided != nullptr, row.decided.has_value()) << e.verdict;
  if (decided != nullptr && row.decided) {
    EXPECT_EQ(decided->term, *row.decided);
    EXPECT_TRUE(decided->over);
  }
  EXPECT_EQ(e.verdict.rfind(row.verdict, 0), 0u) << e.verdict;
}

INSTANTIATE_TEST_SUITE_P(
    , CellVerdict,
    ::testing::Values(
        Row{"Safe", Flat(2), {50, 50}, {}, "Safe; nearest hazard: map edge, 7.6 m"},
        Row{"NearTheEdge",
            Flat(2),
            {50, 4},
            CellTerm::kHazardDistance,
            "Clear radius 0.7 m, min 2.3 m; map edge, 0.8 m west"},
        Row{"Steep", Slope(Rad(14), 0), {50, 50}, CellTerm::kSlope, "Slope 14.0°, max 10°"},
        Row{"OnABox",
            WithBox(Flat(), 0, 0, 0.45, 0.6),
            {50, 50},
            CellTerm::kRoughness,
            "Roughness here"},
        Row{"BesideABox",
            WithBox(Flat(), 0, 0, 0.45, 0.6),
            {40, 50},
            CellTerm::kHazardDistance,
            "Clear radius 1."},
        Row{"InAHole", WithHole(Flat()), {50, 50}, {}, "Never measured"}),
    [](const auto& row) { return row.param.name; });

// Seeds 1-40: the explanation says exactly what the maps decided, for every cell.
TEST(CellExplanation, AgreesWithTheMapsEverywhere) {
  for (const SladMode mode : {SladMode::kThesis, SladMode::kModern}) {
    const SladSettings settings = WithMode(mode);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed);
      const ElevationMap map = testing::RandomGround(60, 50, 0.15, seed);
      const HazardMaps hazards = EvaluateHazards(map, settings);
      RejectedCells counted;
      int safe = 0;
      for (int r = 0; r < 60; ++r) {
        for (int c = 0; c < 50; ++c) {
          const CellExplanation e = ExplainCell(map, hazards, settings, {r, c});
          ASSERT_FALSE(e.verdict.empty());
          const ExplainedTerm* decided = Decided(e);
          safe += e.can_bear ? 1 : 0;
          if (e.reasons == kHazardNone && !e.can_bear) {
            ++counted.footprint;
            ASSERT_NE(decided, nullptr) << e.verdict;
          } else if (decided != nullptr) {
            counted.slope += decided->term == CellTerm::kSlope ? 1 : 0;
            const bool doubted = decided->term == CellTerm::kProbability;
            counted.doubtful += doubted ? 1 : 0;
            counted.roughness += decided->term != CellTerm::kSlope && !doubted ? 1 : 0;
          } else {
            counted.unknown += e.can_bear ? 0 : 1;
          }
        }
      }
      EXPECT_EQ(safe, hazards.safe_cells);
      EXPECT_EQ(counted.slope, hazards.rejected.slope);
      EXPECT_EQ(counted.roughness, hazards.rejected.roughness);
      EXPECT_EQ(counted.unknown, hazards.rejected.unknown);
      EXPECT_EQ(counted.doubtful, hazards.rejected.doubtful);
      EXPECT_EQ(counted.footprint, hazards.rejected.footprint);
    }
  }
}

/// Every cell looked at.
NearestHazard SlowNearest(const HazardMaps& hazards, Cell from) {
  const GridGeometry& g = hazards.geometry;
  double best = HUGE_VAL;
  NearestHazard found;
  for (int r = -1; r <= g.rows; ++r) {
    for (int c = -1; c <= g.cols; ++c) {
      const bool inside = g.Contains({r, c});
      const double d = std::hypot(r - from.row, c - from.col);
      if ((!inside || hazards.reasons.at(r, c) != kHazardNone) && d < best - 1e-9) {
        best = d;
        found.cell = inside ? std::optional(Cell{r, c}) : std::nullopt;
      }
    }
  }
  found.distance_m = best * g.cell_m;
  return found;
}

TEST(CellExplanation, NearestHazardIsTheNearest) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const ElevationMap map = testing::RandomGround(40, 60, 0.15, seed);
    const SladSettings settings;
    const HazardMaps hazards = EvaluateHazards(map, settings);
    for (int r = 0; r < 40; r += 3) {
      for (int c = 0; c < 60; c += 3) {
        const CellExplanation e = ExplainCell(map, hazards, settings, {r, c});
        if (e.nearest) {
          const NearestHazard slow = SlowNearest(hazards, {r, c});
          EXPECT_NEAR(e.nearest->distance_m, slow.distance_m, 1e-9) << "seed " << seed;
          EXPECT_EQ(e.nearest->cell, slow.cell) << "seed " << seed;
        }
      }
    }
  }
}

TEST(CellExplanation, SaysFramesAgeAndHeight) {
  ElevationMap map = MakeMap(101, 101, 0.15, Flat(2), 0.01);
  map.frame_count.at(50, 50) = 7;
  const CellExplanation one_frame = Explain(map, {50, 50});
  EXPECT_EQ(one_frame.age_s, 0);
  map.age_s = GridF(101, 101, 0.3F);
  const CellExplanation e = Explain(map, {50, 50});
  EXPECT_EQ(e.frames, 7);
  EXPECT_NEAR(e.age_s, 0.3, 1e-6);
  EXPECT_NEAR(e.height_m.value, 2, 0.05);
  EXPECT_NEAR(e.height_m.three_sigma, 0.03, 1e-6);
  map.frame_count.at(50, 50) = 0;
  EXPECT_TRUE(std::isnan(Explain(map, {50, 50}).age_s));
}

TEST(CellExplanation, CellsNotMeasuredAndFlaggedOnesSayWhy) {
  const SladSettings settings;
  ElevationMap map = MakeMap(101, 101, 0.15, Flat());
  map.state.at(50, 50) = CellState::kFilled;
  map.state.at(20, 20) = CellState::kBorder;
  HazardMaps hazards = EvaluateHazards(map, settings);
  EXPECT_EQ(ExplainCell(map, hazards, settings, {50, 50}).verdict, "A filled hole, not measured");
  EXPECT_EQ(ExplainCell(map, hazards, settings, {20, 20}).verdict, "A filled rim, not measured");
  hazards.flags = Grid<std::uint8_t>(101, 101, std::uint8_t{kFlagNone});
  hazards.flags.at(80, 80) = kFlagMotion | kFlagShadow;
  hazards.reasons.at(80, 80) = kHazardFlagged;
  const CellExplanation flagged = ExplainCell(map, hazards, settings, {80, 80});
  EXPECT_EQ(flagged.verdict, "Flagged: deep shadow, motion");
  EXPECT_FALSE(flagged.can_bear);
  EXPECT_EQ(WhereWords(NearestHazard{Cell{1, 1}, 1.9, Rad(180), kHazardFlagged, kFlagMotion}),
            "motion, 1.9 m south");
  EXPECT_EQ(WhereWords(NearestHazard{Cell{1, 1}, 1.1, Rad(220), kHazardRoughness | kHazardStep, 0}),
            "roughness, 1.1 m south-west");
}

TEST(CellExplanation, BadPlacesAreNeverSafe) {
  const SladSettings settings;
  const ElevationMap map = MakeMap(20, 30, 0.15, Flat());
  const HazardMaps hazards = EvaluateHazards(map, settings);
  for (const Cell cell : {Cell{-1, 0}, Cell{0, -1}, Cell{20, 0}, Cell{0, 30}, Cell{1 << 30, 5}}) {
    const CellExplanation e = ExplainCell(map, hazards, settings, cell);
    EXPECT_FALSE(e.can_bear);
    EXPECT_EQ(e.verdict, "Outside the map");
  }
  const auto nothing = [](double, double) { return std::nan(""); };
  for (const int size : {0, 1, 9}) {
    const CellExplanation e = Explain(MakeMap(size, size, 0.15, nothing), {0, 0});
    EXPECT_FALSE(e.can_bear);
    EXPECT_FALSE(e.verdict.empty());
  }
}

TEST(TermWords, WhatBreaksItsLimitIsNeverToldAsThatLimit) {
  const struct {
    CellTerm term;
    double value, limit;
    const char *words, *limit_words;
  } table[] = {{CellTerm::kHazardDistance, 2.279, 2.286, "2.2 m", "min 2.3 m"},
               {CellTerm::kHazardDistance, 1.9, 2.286, "1.9 m", "min 2.3 m"},
               {CellTerm::kSlope, Rad(10.004), Rad(10), "10.1°", "max 10°"},
               {CellTerm::kSlope, Rad(12), Rad(10), "12.0°", "max 10°"},
               {CellTerm::kRoughness, 0.1002, 0.1, "10.1 cm", "max 10 cm"},
               {CellTerm::kProbability, 0.8999, 0.9, "0.899", "min 0.900"}};
  for (const auto& row : table) {
    const TermWords over = WordsOf({row.term, {row.value, 0}, row.limit, true, false});
    EXPECT_EQ(over.value, row.words);
    EXPECT_EQ(over.limit, row.limit_words);
  }
  EXPECT_EQ(WordsOf({CellTerm::kSlope, {Rad(9.996), 0}, Rad(10), false, false}).value, "10.0°");
}

TEST(TermWords, EveryNumberHasItsUnit) {
  const auto words = [](CellTerm term, double value, double three_sigma, double limit) {
    const TermWords w = WordsOf({term, {value, three_sigma}, limit, false, false});
    return w.name + "|" + w.value + "|" + w.spread + "|" + w.limit;
  };
  EXPECT_EQ(words(CellTerm::kSlope, Rad(2.14), Rad(0.3), Rad(10)), "Slope|2.1°|± 0.3°|max 10°");
  EXPECT_EQ(words(CellTerm::kRoughness, 0.055, 0.018, 0.125),
            "Roughness|5.5 cm|± 1.8 cm|max 12.5 cm");
  EXPECT_EQ(words(CellTerm::kStep, std::nan(""), 0.1, 0.15), "Step|––||max 15 cm");
  EXPECT_EQ(words(CellTerm::kProbability, 0.9984, 0, 0.99), "Safe as seen|0.998||min 0.990");
  EXPECT_EQ(words(CellTerm::kHazardDistance, 4.8, 0, 2.3), "Clear radius|4.8 m||min 2.3 m");
}

TEST(DirectionWord, NamesTheNearestOfEight) {
  const char* words[] = {"north", "north-east", "east", "south-east",
                         "south", "south-west", "west", "north-west"};
  for (int deg = -720; deg <= 720; deg += 5) {
    const int sector = static_cast<int>(std::floor((deg + 22.5) / 45)) & 7;
    EXPECT_STREQ(DirectionWord(Rad(deg)), words[sector]) << deg;
  }
}

LandingSite SiteOf(double safe_distance_m, double cost, bool straight = true,
                   std::uint8_t approaches = 0xFF) {
  LandingSite site;
  site.safe_distance_m = safe_distance_m;
  site.cost = cost;
  site.corridor_clear = straight;
  site.clear_approaches = approaches;
  return site;
}

LandingSite CalledUnsafe(double since_s, LandingSite site) {
  site.called_unsafe_s = since_s;
  site.clear_radius_m = 2.3;
  return site;
}

TEST(RankReasons, SayWhatDecidedAndByHowMuch) {
  struct Case {
    SiteRanking choice;
    std::vector<LandingSite> sites;
    std::vector<const char*> reasons;
  };
  using enum SiteRanking;
  const Case cases[] = {
      {kFarthest, {SiteOf(4.8, 0.2)}, {"The only site"}},
      {kFarthest,
       {SiteOf(4.8, 0.2), SiteOf(4.2, 0.1), SiteOf(3.0, 0.1)},
       {"Widest: 0.6 m more clear than the next", "0.6 m less clear than the best",
        "1.8 m less clear than the best"}},
      {kFarthest,
       {SiteOf(4.80, 0.20), SiteOf(4.79, 0.32)},
       {"Widest: cost 0.12 less than the next", "Cost 0.12 more than the best"}},
      {kFarthest,
       {SiteOf(4.80, 0.20), SiteOf(4.80, 0.20)},
       {"As good as the next, nearer to the middle",
        "As good as the best, farther from the middle"}},
      {kCost,
       {SiteOf(3.0, 0.20), SiteOf(4.8, 0.25)},
       {"Cheapest: cost 0.05 less than the next", "Cost 0.05 more than the best"}},
      {kFarthest,
       {SiteOf(4.0, 0.2), SiteOf(4.8, 0.2, false, 0b00100000), SiteOf(5, 0.2, false, 0)},
       {"The only straight approach that is clear",
        "Straight approach blocked; clear from south-west", "Every approach blocked"}},
      {kFarthest,
       {SiteOf(4.0, 0.2), SiteOf(3.8, 0.2), CalledUnsafe(12.4, SiteOf(4.8, 0.2))},
       {"Leads: 0.2 m more clear than the next", "0.2 m less clear than the best",
        "Called unsafe 12 s before, ranks as 2.3 m narrower"}},
      {kCost,
       {SiteOf(3.0, 0.20), CalledUnsafe(12.4, SiteOf(4.8, 0.1))},
       {"Stays first, cost 0.10 more than the next (called unsafe)",
        "Called unsafe 12 s before, ranks behind"}},
      {kFarthest,
       {SiteOf(4.0, 0.2, false, 0b10000011)},
       {"Straight approach blocked; clear from 3 of 8 sides"}}};
  for (const Case& c : cases) {
    SiteSelection selection{c.sites, ""};
    GiveReasons(c.choice, 0, selection);
    for (std::size_t i = 0; i < c.reasons.size(); ++i) {
      EXPECT_EQ(selection.sites[i].reason, c.reasons[i]);
    }
  }
}

}  // namespace
}  // namespace palace
