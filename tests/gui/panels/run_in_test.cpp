// Going to a moment with a map built up by then: where it jumps, when it stops, what ends it.
#include "gui/panels/review/run_in.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

using Kind = PlaybackControl::Kind;

SourceStatus At(double position_s, std::uint64_t jumps) {
  SourceStatus source;
  source.can_seek = true;
  source.position_s = position_s;
  source.jumps = jumps;
  return source;
}

TEST(RunIn, JumpsToShortlyBeforePlaysAndStopsThere) {
  RunIn run;
  const Intents begin = run.Begin(At(50, 3), 20);
  ASSERT_EQ(begin.size(), 2u);
  EXPECT_EQ(std::get<PlaybackControl>(begin[0]).kind, Kind::kSeek);
  EXPECT_EQ(std::get<PlaybackControl>(begin[0]).value, 18);
  EXPECT_EQ(std::get<PlaybackControl>(begin[1]).kind, Kind::kPlay);
  EXPECT_TRUE(run.Follow(At(50.1, 3)).empty()) << "the jump is not on the screen yet";
  EXPECT_TRUE(run.Follow(At(18, 4)).empty());
  EXPECT_TRUE(run.Follow(At(19.9, 4)).empty());
  const Intents end = run.Follow(At(20, 4));
  ASSERT_EQ(end.size(), 1u);
  EXPECT_EQ(std::get<PlaybackControl>(end[0]).kind, Kind::kPause);
  EXPECT_FALSE(run.running());
  EXPECT_TRUE(run.Follow(At(20.5, 4)).empty());
}

TEST(RunIn, APauseOrAJumpOfSomebodyElseEndsIt) {
  for (const bool paused : {true, false}) {
    RunIn run;
    run.Begin(At(50, 3), 20);
    run.Follow(At(18, 4));
    SourceStatus other = At(paused ? 18.5 : 40, paused ? 4 : 5);
    other.paused = paused;
    EXPECT_TRUE(run.Follow(other).empty());
    EXPECT_FALSE(run.running());
  }
}

TEST(RunIn, NearTheStartItPlaysFromTheStart) {
  RunIn run;
  EXPECT_EQ(std::get<PlaybackControl>(run.Begin(At(50, 0), 1)[0]).value, 0);
}

}  // namespace
}  // namespace palace
