// After a jump in a record the inputs are as old as the record says, not unheard.
#include <gtest/gtest.h>

#include "engine/mission/watch/input_watch.h"

namespace palace {
namespace {

ChannelHealth Heard(ChannelId id, double age_s) {
  ChannelHealth channel;
  channel.id = id;
  channel.state = ChannelHealth::State::kStale;
  channel.age_s = age_s;
  return channel;
}

TEST(InputWatch, AfterAJumpInARecordAgesAreThoseOfTheRecord) {
  const Timestamp now{100'000'000};
  const std::vector<ChannelHealth> channels = {Heard(ChannelId::kCameraLeft, 3.2),
                                               Heard(ChannelId::kCameraRight, 0.5),
                                               Heard(ChannelId::kVehicleStatus, 2.0)};
  FrameBundle bundle;
  InputWatch watch = InputWatch::AsHeard(channels, bundle, now);
  watch.Update(bundle, channels, now);
  EXPECT_NEAR(watch.LeftCameraAge(now), 3.2, 1e-6);
  EXPECT_NEAR(watch.RightCameraAge(now), 0.5, 1e-6);
  EXPECT_NEAR(watch.PairAge(now), 3.2, 1e-6);
  EXPECT_NEAR(watch.LinkAge(now), 2.0, 1e-6);
  EXPECT_TRUE(std::isnan(watch.PoseAge(now))) << "the record never heard one";
}

TEST(InputWatch, TheFirstStatusAfterAJumpIsTaken) {
  const Timestamp now{100'000'000};
  const std::vector<ChannelHealth> channels = {Heard(ChannelId::kVehicleStatus, 0)};
  FrameBundle bundle;
  bundle.status.emplace();
  bundle.status->time = now;
  bundle.status->boot_id = 9;
  InputWatch watch = InputWatch::AsHeard(channels, bundle, now);
  watch.Update(bundle, channels, now);
  ASSERT_TRUE(watch.vehicle().has_value());
  EXPECT_EQ(watch.boot_id(), 9U);
  EXPECT_FALSE(watch.rebooted());
}

}  // namespace
}  // namespace palace
