// A stretch that is played again and again: when it turns back, and when it leaves the replay
// alone.
#include "gui/panels/review/loop_range.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

SourceStatus At(double position_s, std::uint64_t jumps = 0) {
  SourceStatus source;
  source.can_seek = true;
  source.duration_s = 60;
  source.position_s = position_s;
  source.jumps = jumps;
  return source;
}

/// Where it is told to go; NaN: nowhere.
double TurnsTo(const Intents& intents) {
  if (intents.size() != 2) {
    return NAN;
  }
  const auto& seek = std::get<PlaybackControl>(intents[0]);
  EXPECT_EQ(seek.kind, PlaybackControl::Kind::kSeek);
  EXPECT_EQ(std::get<PlaybackControl>(intents[1]).kind, PlaybackControl::Kind::kPlay);
  return seek.value;
}

TEST(LoopRange, TurnsBackAtItsEndOnceAJump) {
  LoopRange loop;
  loop.Set(LoopEdge::kIn, 10);
  loop.Set(LoopEdge::kOut, 20);
  EXPECT_TRUE(loop.Follow(At(20.1)).empty()) << "its ends are set, it is off";
  EXPECT_EQ(loop.Shown(60), std::pair(10.0, 20.0)) << "and are shown";
  loop.Toggle();
  EXPECT_TRUE(loop.Follow(At(19.9)).empty());
  EXPECT_EQ(TurnsTo(loop.Follow(At(20.1))), 10);
  EXPECT_TRUE(loop.Follow(At(20.2)).empty()) << "it is on its way";
  EXPECT_TRUE(loop.Follow(At(10, 1)).empty());
  EXPECT_EQ(TurnsTo(loop.Follow(At(20, 1))), 10);
}

TEST(LoopRange, LeavesAPausedReplayAndOneBeforeTheStretchAlone) {
  LoopRange loop;
  loop.Set(LoopEdge::kIn, 10);
  loop.Set(LoopEdge::kOut, 20);
  loop.Toggle();
  SourceStatus paused = At(25);
  paused.paused = true;
  EXPECT_TRUE(loop.Follow(paused).empty());
  EXPECT_TRUE(loop.Follow(At(3)).empty());
  loop.Toggle();
  EXPECT_TRUE(loop.Follow(At(25)).empty());
  loop.Toggle();
  EXPECT_EQ(TurnsTo(loop.Follow(At(25))), 10);
}

TEST(LoopRange, WithoutEndsItIsTheWholeFlight) {
  LoopRange loop;
  EXPECT_FALSE(loop.Shown(60));
  loop.Toggle();
  EXPECT_EQ(loop.Shown(60), std::pair(0.0, 60.0));
  EXPECT_TRUE(loop.Follow(At(59.9)).empty());
  SourceStatus ended = At(60);
  ended.ended = ended.paused = true;
  EXPECT_EQ(TurnsTo(loop.Follow(ended)), 0);
}

TEST(LoopRange, AnEndOnTheWrongSideTakesTheOtherAway) {
  LoopRange loop;
  loop.Set(LoopEdge::kIn, 30);
  loop.Set(LoopEdge::kOut, 20);
  EXPECT_EQ(loop.Shown(60), std::pair(0.0, 20.0));
  loop.Set(LoopEdge::kIn, 25);
  EXPECT_EQ(loop.Shown(60), std::pair(25.0, 60.0));
}

TEST(LoopRange, ASourceThatCannotJumpIsNotAsked) {
  LoopRange loop;
  loop.Set(LoopEdge::kOut, 20);
  loop.Toggle();
  SourceStatus source = At(25);
  source.can_seek = false;
  EXPECT_TRUE(loop.Follow(source).empty());
}

}  // namespace
}  // namespace palace
