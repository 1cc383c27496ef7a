// How long flags take to come and to go, as tables of what each map found.
#include "engine/slad/pictures/flag_memory.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace palace {
namespace {

const GridGeometry kGeometry{4, 4, 0.5, 0, 0};

/// One letter a map: x found, . looked at without, - not looked at; F: motion is forgotten. Returns
/// what was in force after each: x or a dot.
std::string InForce(TerrainFlag flag, const std::string& maps) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  std::string answer;
  for (const char map : maps) {
    Grid<std::uint8_t> seen(4, 4, map == '-' ? std::uint8_t{0} : std::uint8_t{flag});
    Grid<std::uint8_t> found(4, 4, map == 'x' ? std::uint8_t{flag} : std::uint8_t{0});
    map == 'F' ? memory.ForgetMotion() : memory.Add(seen, found);
    answer += (memory.Flags().at(1, 2) & flag) != 0 ? 'x' : '.';
  }
  return answer;
}

struct Row {
  const char* name;
  TerrainFlag flag;
  const char* maps;
  const char* in_force;
};

class FlagMemoryTable : public testing::TestWithParam<Row> {};

TEST_P(FlagMemoryTable, AnswersAsWritten) {
  EXPECT_EQ(InForce(GetParam().flag, GetParam().maps), GetParam().in_force);
}

INSTANTIATE_TEST_SUITE_P(
    All, FlagMemoryTable,
    testing::Values(Row{"OneMapAloneWarnsAtOnce", kFlagNoTexture, "x", "x"},
                    Row{"ButGoesWhenTheNextDoesNotAgree", kFlagNoTexture, "x.", "x."},
                    Row{"ASingleLaterMapIsAFlicker", kFlagNoTexture, "..x..", "....."},
                    Row{"TwoOfThreeRaise", kFlagNoTexture, "..x.x", "....x"},
                    Row{"TwoOfFourDoNot", kFlagNoTexture, "..x..x", "......"},
                    Row{"NoTextureStaysFiveMaps", kFlagNoTexture, "xx......", "xxxxxx.."},
                    Row{"ShadowStaysThree", kFlagShadow, "xx......", "xxxx...."},
                    Row{"OutOfViewItIsKept", kFlagNoTexture, "xx-------", "xxxxxxxxx"},
                    Row{"MotionNeedsTwo", kFlagMotion, "x.xx", "..xx"},
                    Row{"MotionFadesOutOfViewToo", kFlagMotion, "xx----------------------",
                        ".xxxxxxxxxxxxxxxxxxxx..."},
                    Row{"MotionSeenInDoubtfulViewsIsForgotten", kFlagMotion, "xxF.x.xxx",
                        ".x....xxx"},
                    Row{"NothingElseIs", kFlagThinStructure, "xxF.", "xxxx"},
                    Row{"WiresStayTwenty", kFlagThinStructure, "xx......................",
                        "xxxxxxxxxxxxxxxxxxxxx..."}),
    [](const auto& row) { return row.param.name; });

TEST(FlagMemory, MovesWithTheMapByWholeCellsAndForgetsWhatLeaves) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  Grid<std::uint8_t> seen(4, 4, kFlagNoTexture), found(4, 4, kFlagNone);
  found.at(1, 2) = kFlagNoTexture;
  memory.Add(seen, found);
  // A cell to the north and one to the east: the same ground is a row lower and a column before.
  memory.MoveTo({4, 4, 0.5, 0.5, 0.5});
  EXPECT_EQ(memory.Flags().at(2, 1), kFlagNoTexture);
  EXPECT_EQ(memory.Flags().at(1, 2), kFlagNone);
  memory.MoveTo({4, 4, 0.5, 10, 0});
  memory.MoveTo(kGeometry);
  EXPECT_EQ(memory.Flags().at(1, 2), kFlagNone);
}

/// One map that finds a wire over one cell (top 6.3 m, running east), or looks in vain.
void LookForWire(FlagMemory& memory, bool is_found, double baseline_bearing_rad) {
  Grid<std::uint8_t> seen(4, 4, kFlagThinStructure), found(4, 4, kFlagNone);
  ThinSights thin{Grid<ThinSight>(4, 4), baseline_bearing_rad};
  if (is_found) {
    found.at(1, 2) = kFlagThinStructure;
    thin.cells.at(1, 2) = {6.3F, static_cast<float>(M_PI / 2)};
  }
  memory.Add(seen, found, thin);
}

// Cameras side by side along the wire see nothing of it: 200 such maps forget nothing. Turned by 30
// degrees they would see it: 20 maps and it is gone, its height too.
TEST(FlagMemory, AWireAlongTheBaselineIsNotForgottenForBeingUnseen) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  LookForWire(memory, true, 1.0);
  LookForWire(memory, true, 1.0);
  EXPECT_EQ(memory.ThinTops().at(1, 2), 6.3F);
  EXPECT_TRUE(std::isnan(memory.ThinTops().at(1, 1)));
  for (int map = 0; map < 200; ++map) {
    LookForWire(memory, false, map % 2 == 0 ? M_PI / 2 + 0.1 : -M_PI / 2 - 0.1);
  }
  EXPECT_EQ(memory.ThinTops().at(1, 2), 6.3F);
  for (int map = 0; map < 20; ++map) {
    LookForWire(memory, false, M_PI / 2 + 0.5);
  }
  EXPECT_TRUE(memory.ThinTops().empty());
  EXPECT_EQ(memory.Flags().at(1, 2), kFlagNone);
}

// Found by one map alone it is a flicker, from wherever one looks.
TEST(FlagMemory, AWireThatOneMapAloneSawIsForgottenByTheNext) {
  for (const double baseline_bearing_rad : {M_PI / 2, 0.0}) {
    FlagMemory memory;
    memory.MoveTo(kGeometry);
    LookForWire(memory, true, baseline_bearing_rad);
    EXPECT_EQ(memory.Flags().at(1, 2), kFlagThinStructure);
    LookForWire(memory, false, baseline_bearing_rad);
    EXPECT_EQ(memory.Flags().at(1, 2), kFlagNone);
    EXPECT_TRUE(memory.ThinTops().empty());
  }
}

// Without a height it lies on the ground behind, which moves with the view: it fades as ever.
TEST(FlagMemory, AWireOfUnknownHeightFadesAlongTheBaselineToo) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  const Grid<std::uint8_t> all(4, 4, kFlagThinStructure), none(4, 4, kFlagNone);
  const ThinSights found{Grid<ThinSight>(4, 4, {std::numeric_limits<float>::infinity(), 0}), 0};
  memory.Add(all, all, found);
  memory.Add(all, all, found);
  for (int map = 0; map < 20; ++map) {
    EXPECT_TRUE(std::isinf(memory.ThinTops().at(0, 0))) << map;
    memory.Add(all, none, {Grid<ThinSight>(4, 4), 0});
  }
  EXPECT_TRUE(memory.ThinTops().empty());
}

/// One letter a map: ? a line of unknown height, 3 a wire 3 m up, g a line told to lie on the
/// ground, . nothing. Returns what was in force after each map: ?, 3 or a dot.
std::string LinesInForce(const std::string& maps) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  std::string answer;
  for (const char map : maps) {
    const Grid<std::uint8_t> seen(4, 4, std::uint8_t{kFlagThinStructure});
    const Grid<std::uint8_t> found(
        4, 4, map == '?' || map == '3' ? std::uint8_t{kFlagThinStructure} : std::uint8_t{0});
    ThinSights thin{Grid<ThinSight>(4, 4), M_PI / 2};
    if (map != '.') {
      thin.cells = Grid<ThinSight>(4, 4,
                                   ThinSight{map == '3'   ? 3
                                             : map == '?' ? kInfinity
                                                          : -kInfinity,
                                             M_PI / 2});
    }
    memory.Add(seen, found, thin);
    const bool in_force = (memory.Flags().at(1, 2) & kFlagThinStructure) != 0;
    answer += !in_force ? '.' : std::isinf(memory.ThinTops().at(1, 2)) ? '?' : '3';
  }
  return answer;
}

TEST(FlagMemory, ALineThatMotionTellsToLieOnTheGroundIsNoWireForTwentyMaps) {
  EXPECT_EQ(LinesInForce("???g"), "???.");
  EXPECT_EQ(LinesInForce("???g????"), "???.....");
  EXPECT_EQ(LinesInForce("g" + std::string(19, '?')), std::string(20, '.'));
  EXPECT_EQ(LinesInForce("g" + std::string(19, '.') + "??"), std::string(20, '.') + ".?");
}

TEST(FlagMemory, AHeightThatMotionTellsStandsForOneUnknownBeforeOrAfter) {
  EXPECT_EQ(LinesInForce("??3?"), "??33");
}

TEST(FlagMemory, AWireWhoseHeightIsKnownStaysTwentyMapsWhereALineLies) {
  EXPECT_EQ(LinesInForce("33g"), "333");
  EXPECT_EQ(LinesInForce("33" + std::string(30, '.')), std::string(32, '3'));
  EXPECT_EQ(LinesInForce("33" + std::string(20, 'g')), std::string(21, '3') + ".");
  EXPECT_EQ(LinesInForce("g33"), "..3");
}

TEST(FlagMemory, TheHighestTopCountsWhileItIsInForce) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  LookForWire(memory, true, 1.0);
  const Grid<std::uint8_t> all(4, 4, kFlagThinStructure);
  const auto find = [&](float top_m) {
    memory.Add(all, all, {Grid<ThinSight>(4, 4, {top_m, 0}), 1.0});
    return memory.ThinTops().at(1, 2);
  };
  EXPECT_EQ(find(0.4F), 6.3F);
  EXPECT_EQ(find(8.0F), 8.0F);
  EXPECT_EQ(find(0.4F), 8.0F);
}

TEST(FlagMemory, AnotherCellSizeStartsAfresh) {
  FlagMemory memory;
  memory.MoveTo(kGeometry);
  memory.Add(Grid<std::uint8_t>(4, 4, kFlagShadow), Grid<std::uint8_t>(4, 4, kFlagShadow));
  memory.MoveTo({4, 4, 1.0, 0, 0});
  EXPECT_EQ(memory.Flags().cells(), std::vector<std::uint8_t>(16, kFlagNone));
}

}  // namespace
}  // namespace palace
