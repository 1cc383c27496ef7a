// Bundles that reach their reader as one lose nothing but older pictures.
#include "engine/model/frame_bundle.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr int kTrials = 200;

struct Kinds {
  std::vector<Timestamp> poses, imu, gps, laser, truth, acks;
  std::vector<std::string> commands;
  friend bool operator==(const Kinds&, const Kinds&) = default;
};

void AddTo(Kinds& kinds, const FrameBundle& bundle) {
  const auto add = [](std::vector<Timestamp>& times, const auto& samples) {
    for (const auto& sample : samples) {
      times.push_back(sample.time);
    }
  };
  add(kinds.poses, bundle.poses);
  add(kinds.imu, bundle.imu);
  add(kinds.gps, bundle.gps);
  add(kinds.laser, bundle.laser);
  add(kinds.truth, bundle.truth);
  add(kinds.acks, bundle.acks);
  for (const EngineCommand& command : bundle.recorded_commands) {
    kinds.commands.push_back(std::get<AddBookmark>(command.action).note);
  }
}

/// A tenth of a second of samples, each kind of its own number.
FrameBundle RandomBundle(RandomStream& random, std::uint64_t number) {
  FrameBundle bundle;
  bundle.sequence = number;
  bundle.time = {static_cast<std::int64_t>(number) * 100'000};
  const auto fill = [&](auto& samples) {
    const int count = static_cast<int>(random.Uniform(0, 12));
    for (int i = 0; i < count; ++i) {
      samples.emplace_back();
      samples.back().time = {bundle.time.us - 90'000 + 7'000 * i};
    }
  };
  fill(bundle.poses);
  fill(bundle.imu);
  fill(bundle.gps);
  fill(bundle.laser);
  fill(bundle.truth);
  fill(bundle.acks);
  if (random.Uniform(0, 1) < 0.5) {
    bundle.recorded_commands = {
        {CommandOrigin::kOperator, AddBookmark{"before " + std::to_string(number)}}};
  }
  if (random.Uniform(0, 1) < 0.7) {
    bundle.stereo = std::make_shared<StereoFrame>(StereoFrame{{bundle.time.us - 30'000}, {}, {}});
    bundle.pose_at_exposure.emplace().time = bundle.stereo->time;
  }
  if (random.Uniform(0, 1) < 0.5) {
    bundle.status.emplace().time = bundle.time;
  }
  if (random.Uniform(0, 1) < 0.3) {
    bundle.rig = std::make_shared<StereoRig>();
  }
  return bundle;
}

int OvertakenOf(const FrameBundle& bundle, ChannelId channel) {
  return bundle.arrival.overtaken[static_cast<std::size_t>(channel)];
}

TEST(Join, EverySampleOfEveryBundleIsKeptInOrder) {
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    Kinds sent;
    FrameBundle first = RandomBundle(random, 1);
    AddTo(sent, first);
    auto joined = std::make_shared<const FrameBundle>(first);
    auto stereo = first.stereo;
    auto exposure = first.pose_at_exposure;
    auto status = first.status;
    auto rig = first.rig;
    std::uint64_t pairs = first.stereo ? 1 : 0, replaced = 0;
    int statuses = first.status ? 1 : 0;
    for (std::uint64_t number = 2; number < 6; ++number) {
      const FrameBundle next = RandomBundle(random, number);
      AddTo(sent, next);
      pairs += next.stereo ? 1 : 0;
      statuses += next.status ? 1 : 0;
      stereo = next.stereo ? next.stereo : stereo;
      exposure = next.stereo ? next.pose_at_exposure : exposure;
      status = next.status ? next.status : status;
      rig = next.rig ? next.rig : rig;
      JoinedBundle result = Join(*joined, next);
      EXPECT_EQ(result.samples_dropped, 0u);
      replaced += result.pair_replaced ? 1 : 0;
      joined = std::move(result.bundle);
    }
    Kinds got;
    AddTo(got, *joined);
    EXPECT_EQ(got, sent);
    EXPECT_TRUE(std::is_sorted(got.imu.begin(), got.imu.end()));
    EXPECT_EQ(joined->sequence, 5u);
    EXPECT_EQ(joined->time.us, 500'000);
    EXPECT_EQ(joined->stereo, stereo);
    EXPECT_EQ(joined->pose_at_exposure.has_value(), exposure.has_value());
    if (exposure && joined->pose_at_exposure) {
      EXPECT_EQ(joined->pose_at_exposure->time, exposure->time);
    }
    EXPECT_EQ(joined->status.has_value(), status.has_value());
    if (status && joined->status) {
      EXPECT_EQ(joined->status->time, status->time);
    }
    EXPECT_EQ(joined->rig, rig);
    EXPECT_EQ(replaced + (stereo ? 1 : 0), pairs);
    EXPECT_EQ(OvertakenOf(*joined, ChannelId::kCameraLeft), static_cast<int>(replaced));
    EXPECT_EQ(OvertakenOf(*joined, ChannelId::kCameraRight), static_cast<int>(replaced));
    EXPECT_EQ(OvertakenOf(*joined, ChannelId::kVehicleStatus), std::max(statuses - 1, 0));
    EXPECT_EQ(OvertakenOf(*joined, ChannelId::kImu), 0);
  }
}

TEST(Join, ADiscontinuityOfEitherSurvives) {
  for (const bool older : {false, true}) {
    for (const bool newer : {false, true}) {
      FrameBundle a, b;
      a.discontinuity = older;
      b.discontinuity = newer;
      EXPECT_EQ(Join(a, b).bundle->discontinuity, older || newer);
    }
  }
}

TEST(Join, AfterAJumpOnlyAnswersAndCommandsOfTheOldTimeCount) {
  FrameBundle older, newer;
  older.time = {900'000'000};
  older.imu.resize(3);
  older.poses.resize(2);
  older.status.emplace();
  older.acks.resize(1);
  older.recorded_commands = {{CommandOrigin::kOperator, WaveOff{}}};
  older.stereo = std::make_shared<StereoFrame>();
  older.rig = std::make_shared<StereoRig>();
  newer.time = {1'000};
  newer.discontinuity = true;
  newer.imu.resize(1);
  const JoinedBundle joined = Join(older, newer);
  EXPECT_EQ(joined.bundle->imu.size(), 1u);
  EXPECT_TRUE(joined.bundle->poses.empty());
  EXPECT_FALSE(joined.bundle->status.has_value());
  EXPECT_EQ(joined.bundle->stereo, nullptr);
  EXPECT_TRUE(joined.pair_replaced);
  EXPECT_EQ(OvertakenOf(*joined.bundle, ChannelId::kCameraLeft), 0)
      << "of a time that is forgotten";
  EXPECT_EQ(joined.bundle->acks.size(), 1u);
  EXPECT_EQ(joined.bundle->recorded_commands.size(), 1u);
  EXPECT_EQ(joined.bundle->rig, older.rig);
}

TEST(Join, AStallIsBoundedAndCounted) {
  FrameBundle older, newer;
  older.imu.resize(kMostSamplesInBundle);
  older.imu.front().time = {1};
  older.imu.back().time = {2};
  newer.imu.resize(3);
  const JoinedBundle joined = Join(older, newer);
  EXPECT_EQ(joined.bundle->imu.size(), kMostSamplesInBundle);
  EXPECT_EQ(joined.samples_dropped, 3u);
  EXPECT_EQ(OvertakenOf(*joined.bundle, ChannelId::kImu), 3);
  EXPECT_NE(joined.bundle->imu.front().time, Timestamp{1});
  EXPECT_EQ(joined.bundle->imu[kMostSamplesInBundle - 4].time, Timestamp{2});
}

}  // namespace
}  // namespace palace
