// When recorded pictures are due. That turns really wait is left to the screen: a test has no
// clock.
#include "engine/capture/playback_turns.h"

#include <gtest/gtest.h>

#include "engine/capture/picture_times.h"

namespace palace {
namespace {

TEST(PictureTimes, AnEvenRateNeverEnds) {
  const PictureTimes times(4);
  EXPECT_EQ(times.At(0), 0);
  EXPECT_EQ(times.At(1'000'000), 250'000);
  EXPECT_EQ(times.Gap(7), 0.25);
  EXPECT_EQ(times.Nearest(0), 0);
  EXPECT_EQ(times.Nearest(0.13), 1);
  EXPECT_EQ(times.Nearest(100), 400);
}

TEST(PictureTimes, ASurveyHasItsOwnTimesAndGoesOnAtItsRate) {
  const PictureTimes times({0, 1, 2, 20}, 0.5);
  const double at[] = {0, 1, 2, 20, 22, 24}, gaps[] = {1, 1, 18, 2, 2};
  for (std::int64_t i = 0; i < 6; ++i) {
    EXPECT_EQ(times.At(i), at[i]) << i;
    EXPECT_EQ(times.Nearest(at[i]), i) << i;
  }
  for (std::int64_t i = 0; i < 5; ++i) {
    EXPECT_EQ(times.Gap(i), gaps[i]) << i;
  }
  EXPECT_EQ(times.Nearest(10.9), 2);
  EXPECT_EQ(times.Nearest(11.1), 3);
  EXPECT_EQ(times.Nearest(20.9), 3);
}

TEST(PlaybackTurns, PositionDurationAndSeeksFollowTheTimes) {
  PlaybackTurns turns(PictureTimes({0, 1, 2, 20}, 0.5), 4, PlaybackTurns::AtEnd::kWait);
  turns.EndsAt(4);
  turns.Control({PlaybackControl::Kind::kSpeed, 0});
  const auto position = [&] {
    SourceStatus status;
    turns.FillStatus(status);
    EXPECT_EQ(status.duration_s, 22) << "the last picture is shown as long as the rate says";
    return status.position_s;
  };
  for (const double time_s : {0.0, 1.0, 2.0, 20.0}) {
    ASSERT_TRUE(turns.Wait({}).has_value());
    EXPECT_EQ(position(), time_s);
  }
  const struct {
    double asked_s;
    std::int64_t index;
  } seeks[] = {{2, 2}, {3, 2}, {-5, 0}, {19, 3}, {1000, 3}, {0.6, 1}};
  for (const auto& seek : seeks) {
    turns.Control({PlaybackControl::Kind::kSeek, seek.asked_s});
    EXPECT_EQ(turns.Wait({}), seek.index) << seek.asked_s;
  }
}

}  // namespace
}  // namespace palace
