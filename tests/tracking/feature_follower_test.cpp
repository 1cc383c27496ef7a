// The follower on pictures whose motion is known: it finds the feature, says when it does not, and
// what it takes up again is the feature. That real lenses, blur and moving light suit it, these
// pictures cannot show.
#include "engine/tracking/feature_follower.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
constexpr float kNoise_grey = 2.5F;
constexpr int kSecond = 30;  // pictures

/// Where the camera is at picture i; the feature is the ground at the origin.
using Motion = std::function<RigidTransform(int)>;
using Paint = std::function<void(ImageU8&, int)>;

RigidTransform Above(double height_m, double right_m, double ahead_m, double turn_deg = 0) {
  RigidTransform X_WC;
  X_WC.R = RotationFromEuler({0, 0, Rad(turn_deg)}) * CameraRotationFromTilt(Rad(-90));
  X_WC.p = {ahead_m, right_m, -height_m};
  return X_WC;
}

struct Followed {
  std::vector<FollowedFeature> told;
  std::vector<Eigen::Vector2d> truth;
  double ms_a_picture = 0;

  double WorstError() const {
    double worst = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      if (told[i].state != FollowState::kLost) {
        worst = std::max(worst, (told[i].pixel - truth[i]).norm());
      }
    }
    return worst;
  }
  int Count(FollowState state) const {
    int count = 0;
    for (const FollowedFeature& picture : told) {
      count += picture.state == state ? 1 : 0;
    }
    return count;
  }
  double LeastCoherence() const {
    double least = 1;
    for (const FollowedFeature& picture : told) {
      least = std::min(least, picture.coherence);
    }
    return least;
  }
  void Print(const char* what) const {
    std::printf(
        "%s: %zu pictures, lost %d, re-acquired %d, worst error %.2f px, least coherence "
        "%.2f, anchors %d, %.2f ms a picture\n",
        what, told.size(), Count(FollowState::kLost), Count(FollowState::kReacquired), WorstError(),
        LeastCoherence(), told.back().anchors, ms_a_picture);
  }
};

/// The first picture's feature is that of the ground at the origin.
Followed Follow(int pictures, const Motion& motion, const Paint& paint = {},
                const FollowerOptions& options = {}, std::uint64_t seed = 7) {
  GroundWorld world(seed);
  std::optional<FeatureFollower> follower;
  Followed followed;
  std::clock_t spent = 0;
  for (int i = 0; i < pictures; ++i) {
    const RigidTransform X_WC = motion(i);
    ImageU8 picture = world.Render(kCamera, X_WC, kNoise_grey);
    if (paint) {
      paint(picture, i);
    }
    const auto truth = PixelFromWorldPoint(kCamera, X_WC, Eigen::Vector3d::Zero());
    followed.truth.push_back(*truth);
    const std::clock_t start = std::clock();
    if (!follower) {
      auto started = FeatureFollower::Start(picture, *truth, options);
      EXPECT_TRUE(started.ok()) << started.error().message;
      follower = std::move(started).value();
      followed.told.push_back(follower->first());
    } else {
      followed.told.push_back(follower->Follow(picture));
    }
    spent += std::clock() - start;
  }
  followed.ms_a_picture = 1e3 * static_cast<double>(spent) / CLOCKS_PER_SEC / pictures;
  return followed;
}

class FeatureFollowerTest : public testing::Test {
 protected:
  void SetUp() override { cv::setNumThreads(1); }
};

TEST_F(FeatureFollowerTest, FollowsAShift) {
  // 6 px a picture to the side, up to 5 px along.
  const Followed followed =
      Follow(2 * kSecond, [](int i) { return Above(10, 0.08 * i - 2.4, 0.6 * std::sin(0.1 * i)); });
  followed.Print("shift");
  EXPECT_EQ(followed.Count(FollowState::kFollowed), 2 * kSecond);
  EXPECT_LT(followed.WorstError(), 0.3);
  EXPECT_GT(followed.LeastCoherence(), 0.9);
}

TEST_F(FeatureFollowerTest, FollowsTheDescentOfTheMission) {
  for (const std::uint64_t seed : {1, 2}) {
    Descent descent;
    descent.frames = 120;
    const Followed followed = Follow(
        descent.frames, [&](int i) { return descent.CameraAt(i); }, {}, {}, seed);
    followed.Print("45 degree descent 15 m to 1.5 m");
    EXPECT_EQ(followed.Count(FollowState::kLost), 0) << seed;
    EXPECT_LT(followed.WorstError(), 6) << seed;
    EXPECT_NEAR(followed.told.back().scale, 10, 1) << seed;
  }
}

TEST_F(FeatureFollowerTest, FollowsATurn) {
  const Followed followed = Follow(90, [](int i) { return Above(10, 0.5, 0.3, 2.0 * i); });
  followed.Print("turn of 180 degrees");
  EXPECT_EQ(followed.Count(FollowState::kLost), 0);
  EXPECT_LT(followed.WorstError(), 1);
  EXPECT_NEAR(std::abs(Deg(followed.told.back().angle_rad)), 178, 1);
}

TEST_F(FeatureFollowerTest, FollowsThroughASlowChangeOfView) {
  const auto round = [](int i) {  // from straight above to 30 degrees above the ground, 10 m off
    const double tilt = Rad(90 - 0.5 * i);
    RigidTransform X_WC;
    X_WC.R = CameraRotationFromTilt(-tilt);
    X_WC.p = {-10 * std::cos(tilt), 0, -10 * std::sin(tilt)};
    return X_WC;
  };
  const Followed followed = Follow(120, round);
  followed.Print("view from 90 to 30 degrees");
  EXPECT_EQ(followed.Count(FollowState::kLost), 0);
  EXPECT_GT(followed.told.back().anchors, 1);
  EXPECT_LT(followed.WorstError(), 3);
  FollowerOptions fixed;
  fixed.update = false;
  EXPECT_LT(Follow(120, round, {}, fixed).LeastCoherence(), followed.LeastCoherence());
}

// ---- what comes between ----

/// Something out of focus, with its own soft shade and noise, that covers the columns before
/// `edge`.
void CoverTo(ImageU8& picture, double edge) {
  RandomStream noise(11, "hand");
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width() && x < edge; ++x) {
      const double shade = 95 + 40 * std::sin(x / 150.0 + 1) * std::cos(y / 190.0);
      picture.at(x, y) = static_cast<std::uint8_t>(shade + 2 * noise.Normal());
    }
  }
}

/// A hand comes in from the left within a sixth of a second, stays for a second in all, and goes.
void HandOverTheLens(ImageU8& picture, int i) {
  const int into = i - kSecond, left = 2 * kSecond - i;
  if (into >= 0 && left > 0) {
    CoverTo(picture, 130.0 * std::min(into, left));
  }
}

RigidTransform Drift(int i) { return Above(10, 0.01 * i - 0.5, 0.3 * std::sin(0.05 * i)); }

TEST_F(FeatureFollowerTest, AHandOverTheLensIsToldAndTheFeatureTakenUpAgain) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Followed followed = Follow(3 * kSecond, Drift, HandOverTheLens, {}, seed);
    followed.Print("hand for a second");
    EXPECT_EQ(followed.Count(FollowState::kReacquired), 1) << seed;
    EXPECT_LT(followed.WorstError(), 2) << seed;  // its edge pulls before the coherence is low
    for (int i = kSecond + 5; i <= 2 * kSecond - 5; ++i) {
      EXPECT_EQ(followed.told[i].state, FollowState::kLost) << seed << ", picture " << i;
      EXPECT_LT(followed.told[i].coherence, 0.7);
      EXPECT_NE(followed.told[i].why_lost, "");
    }
    for (int i = 2 * kSecond + 1; i < 3 * kSecond; ++i) {
      EXPECT_NE(followed.told[i].state, FollowState::kLost) << seed << ", picture " << i;
    }
    EXPECT_EQ(followed.told[2 * kSecond - 6].pictures_lost,
              followed.told[2 * kSecond - 7].pictures_lost + 1);
  }
}

// An edge that comes slowly covers a part of the template in many pictures: what is still seen of
// it holds the place, until too little agrees.
TEST_F(FeatureFollowerTest, WhatCoversAPartDrawsNothingAlong) {
  for (const double speed_px : {1.0, 2.0, 5.0, -2.0}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const auto truth_x = [](int i) {
        return PixelFromWorldPoint(kCamera, Drift(i), Eigen::Vector3d::Zero())->x();
      };
      const auto edge = [&](ImageU8& picture, int i) {
        if (i > 0) {
          CoverTo(picture, truth_x(i) - 30 + std::abs(speed_px) * (speed_px > 0 ? i : 60 - i));
        }
      };
      const Followed followed = Follow(60, Drift, edge, {}, seed);
      followed.Print("covered slowly");
      EXPECT_GT(followed.Count(FollowState::kLost), 0) << speed_px << ", " << seed;
      EXPECT_LT(followed.WorstError(), 1) << speed_px << ", " << seed;
    }
  }
}

TEST_F(FeatureFollowerTest, HalfASecondOfBlackIsLostAtOnceAndCoastedThrough) {
  const int from = kSecond, to = kSecond + kSecond / 2;
  const auto black = [&](ImageU8& picture, int i) {
    if (i >= from && i < to) {
      picture = ImageU8(picture.width(), picture.height());
    }
  };
  const Followed followed = Follow(
      2 * kSecond, [](int i) { return Above(10, 0.03 * i - 0.9, 0); }, black);
  followed.Print("black for half a second");
  EXPECT_EQ(followed.Count(FollowState::kLost), to - from);
  EXPECT_EQ(followed.told[to].state, FollowState::kReacquired);
  EXPECT_LT(followed.WorstError(), 0.3);
  for (int i = from; i < to; ++i) {
    EXPECT_EQ(followed.told[i].coherence, 0) << i;
    EXPECT_EQ(followed.told[i].why_lost, "coherence 0.00, limit 0.70");
    // The motion was even: coasting knows it.
    EXPECT_LT((followed.told[i].pixel - followed.truth[i]).norm(), 2) << i;
    EXPECT_EQ(followed.told[i].window_side_px, 41 + 2 * (32 + 8 * (i - from)));
  }
}

// Behind a hand the ground becomes larger or smaller by a fifth: sought as it was seen last it was
// not found again.
TEST_F(FeatureFollowerTest, WhatComesNearerOrGoesAwayMeanwhileIsTakenUpAgain) {
  const struct { double from_m, a_picture_m; } table[] = {{20, -0.1}, {14, 0.1}};
  const int from = kSecond, to = 2 * kSecond;
  const auto covered = [&](ImageU8& picture, int i) {
    if (i >= from && i < to) {
      CoverTo(picture, picture.width());
    }
  };
  for (const auto& row : table) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Followed followed = Follow(
          to + 10, [&](int i) { return Above(row.from_m + row.a_picture_m * i, 0.3, 0.2); },
          covered, {}, seed);
      followed.Print("nearer or farther behind a hand");
      EXPECT_EQ(followed.Count(FollowState::kReacquired), 1) << row.from_m << ", " << seed;
      EXPECT_LE(followed.Count(FollowState::kLost), to - from + 3) << row.from_m << ", " << seed;
      EXPECT_LT(followed.WorstError(), 1) << row.from_m << ", " << seed;
      EXPECT_NEAR(followed.told.back().scale,
                  row.from_m / (row.from_m + row.a_picture_m * (to + 9)), 0.02);
    }
  }
}

TEST_F(FeatureFollowerTest, AfterALongLossItIsSoughtInTheWholePicture) {
  const auto motion = [](int i) {
    return i < 10 ? Above(10, -2.5, -1.5) : Above(10, 2.5, 1.5);  // 450 px away
  };
  const auto black = [](ImageU8& picture, int i) {
    if (i >= 10 && i < 90) {
      picture = ImageU8(picture.width(), picture.height());
    }
  };
  const Followed followed = Follow(95, motion, black);
  followed.Print("elsewhere after black");
  EXPECT_EQ(followed.told[90].state, FollowState::kReacquired);
  EXPECT_LT(followed.WorstError(), 0.3);
}

TEST_F(FeatureFollowerTest, AnotherSceneIsNotTakenForTheFeature) {
  int taken = 0;
  for (const std::uint64_t seed : {4, 14}) {
    GroundWorld world(seed), other(seed + 100);
    auto follower = FeatureFollower::Start(world.Render(kCamera, Drift(0), kNoise_grey),
                                           Eigen::Vector2d(300, 200), {});
    ASSERT_TRUE(follower.ok());
    for (int i = 0; i < 2 * kSecond; ++i) {
      const FollowedFeature told =
          follower->Follow(other.Render(kCamera, Drift(2 * i), kNoise_grey));
      taken += told.state == FollowState::kLost ? 0 : 1;
    }
  }
  std::printf("another scene: taken for the feature in %d of %d pictures\n", taken, 4 * kSecond);
  EXPECT_EQ(taken, 0);
}

TEST_F(FeatureFollowerTest, WhatLeavesThePictureIsLostAndFoundWhenItReturns) {
  const Followed followed =
      Follow(4 * kSecond, [](int i) { return Above(10, -5.5 * std::sin(Rad(1.5 * i)), 0); });
  followed.Print("out of the picture and back");
  EXPECT_EQ(followed.told[2 * kSecond].state, FollowState::kLost);
  EXPECT_EQ(followed.told.back().state, FollowState::kFollowed);
  EXPECT_LT(followed.WorstError(), 1);
}

TEST_F(FeatureFollowerTest, ExposureIsNoChange) {
  const auto darker = [](ImageU8& picture, int i) {
    for (std::uint8_t& pixel : picture.pixels()) {
      pixel = static_cast<std::uint8_t>(pixel * (1 - 0.5 * i / 60.0) + 20);
    }
  };
  const Followed followed = Follow(2 * kSecond, Drift, darker);
  followed.Print("exposure halved");
  EXPECT_EQ(followed.Count(FollowState::kFollowed), 2 * kSecond);
  EXPECT_LT(followed.WorstError(), 0.3);
}

// ---- options ----

TEST_F(FeatureFollowerTest, WithoutUpdateTheFirstTemplateStays) {
  FollowerOptions options;
  options.update = false;
  const Followed followed = Follow(
      90, [](int i) { return Above(15 * std::pow(0.1, i / 89.0), 0.2, 0.1); }, {}, options);
  followed.Print("tenfold scale, first template");
  EXPECT_EQ(followed.told.back().anchors, 1);
  EXPECT_GT(followed.Count(FollowState::kLost), 0);
  EXPECT_LT(followed.WorstError(), 3);
}

TEST_F(FeatureFollowerTest, TheSamePicturesGiveTheSameBits) {
  const Followed a = Follow(kSecond, Drift), b = Follow(kSecond, Drift);
  for (int i = 0; i < kSecond; ++i) {
    EXPECT_EQ(a.told[i].pixel, b.told[i].pixel) << i;
    EXPECT_EQ(a.told[i].coherence, b.told[i].coherence) << i;
  }
}

TEST_F(FeatureFollowerTest, WhatCannotBeFollowedIsRefusedWithValueAndLimit) {
  GroundWorld world(3);
  const ImageU8 picture = world.Render(kCamera, Drift(0), kNoise_grey);
  const Eigen::Vector2d middle(320, 240);
  struct Row {
    FollowerOptions options;
    Eigen::Vector2d pixel;
    ImageU8 picture;
    const char* said;
  };
  ImageU8 edge(640, 480, 40);
  for (int y = 0; y < 480; ++y) {
    std::fill(edge.row(y) + 320, edge.row(y) + 640, 180);
  }
  const Row rows[] = {
      {{40, 32, 0.7, true}, middle, picture, "template 40 px: must be odd, 11 to 101 px"},
      {{9, 32, 0.7, true}, middle, picture, "template 9 px: must be odd, 11 to 101 px"},
      {{41, 3, 0.7, true}, middle, picture, "search 3 px: must be 4 to 128 px"},
      {{41, 32, 1.5, true}, middle, picture, "least coherence 1.5: must be 0.1 to 0.99"},
      {{41, 32, NAN, true}, middle, picture, "must be 0.1 to 0.99"},
      {{},
       {19, 240},
       picture,
       "feature 19,240: a template of 41 px needs x 20 to 619 px, y 20 to 459 px in a picture of "
       "640 x 480 px"},
      {{}, {320, NAN}, picture, "a template of 41 px needs"},
      {{}, {5, 5}, ImageU8(30, 30), "template 41 px: does not fit into a picture of 30 x 30 px"},
      {{}, middle, ImageU8(640, 480, 90), "the picture is too even there"},
      {{}, middle, edge, "choose a place that changes in both directions"}};
  for (const Row& row : rows) {
    const auto follower = FeatureFollower::Start(row.picture, row.pixel, row.options);
    ASSERT_FALSE(follower.ok()) << row.said;
    EXPECT_EQ(follower.error().code, ErrorCode::kUsage);
    EXPECT_THAT(follower.error().message, testing::HasSubstr(row.said));
  }
}

}  // namespace
}  // namespace palace
