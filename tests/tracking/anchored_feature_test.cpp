// One anchored feature: what it is taken up again for, and what not.
#include "engine/tracking/anchored_feature.h"

#include <gtest/gtest.h>

#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
constexpr int kBlock_px = 50;  // half of what is copied around the feature

RigidTransform CameraBefore() {
  RigidTransform X_WC;
  X_WC.R = CameraRotationFromTilt(Rad(-45));
  X_WC.p = {-10, 0, -10};
  return X_WC;
}

/// The ground around `from` laid at `to`, all of a picture that shows nothing else.
void Lay(const ImageU8& picture, const Eigen::Vector2i& from, const Eigen::Vector2i& to,
         ImageU8& out) {
  for (int y = -kBlock_px; y <= kBlock_px; ++y) {
    for (int x = -kBlock_px; x <= kBlock_px; ++x) {
      out.at(to.x() + x, to.y() + y) = picture.at(from.x() + x, from.y() + y);
    }
  }
}

struct Ending {
  TrackerMember member;
  double off_px = 0;  ///< from where the feature was laid
};

/// Lost in the dark, then to be found 52 px from where it is expected; `twice`: the same ground
/// lies on the other side, too.
Ending LostAndLookedFor(std::uint64_t seed, bool twice) {
  GroundWorld world(seed);
  const RigidTransform X_WC = CameraBefore();
  const ImageU8 before = world.Render(kCamera, X_WC, 1);
  const Eigen::Vector2i at(320, 240);
  const Eigen::Vector2d pixel = at.cast<double>();
  const GroundPlane plane;
  TrackingSettings settings;
  const auto view = [&](const ImageU8& picture, int i) {
    return SiteView{picture, kCamera, X_WC, nullptr, settings, {33'333 * i}};
  };
  const auto predicted = [&](int i) { return PredictedPixel{pixel, 54, 0.03, {33'333 * i}}; };
  const FeatureHint hint{.site_pixel = {}, .may_look_wide = true};
  AnchoredFeature feature(1, {std::make_shared<const ImageU8>(before), X_WC, pixel}, pixel,
                          predicted(0));
  const ImageU8 dark(kCamera.width, kCamera.height);
  for (int i = 1; i <= 3; ++i) {
    feature.Follow(view(dark, i), plane, predicted(i), hint);
    EXPECT_EQ(feature.member().state, FollowState::kLost);
  }
  ImageU8 after = GroundWorld(seed + 100).Render(kCamera, X_WC, 1);
  const Eigen::Vector2i there = at + Eigen::Vector2i(52, 0);
  Lay(before, at, there, after);
  if (twice) {
    Lay(before, at, at - Eigen::Vector2i(52, 0), after);
  }
  feature.Follow(view(after, 4), plane, predicted(4), hint);
  return {feature.member(), (feature.member().pixel - there.cast<double>()).norm()};
}

TEST(AnchoredFeature, IsFoundFarFromWhereItIsExpected) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Ending found = LostAndLookedFor(seed, false);
    EXPECT_EQ(found.member.state, FollowState::kReacquired) << found.member.why_lost;
    EXPECT_LT(found.off_px, 1);
  }
}

// The closer look that settles a wide search sees one place only.
TEST(AnchoredFeature, StaysLostWhereTheWideSearchSawTwoPlacesAlike) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Ending lost = LostAndLookedFor(seed, true);
    EXPECT_EQ(lost.member.state, FollowState::kLost);
    EXPECT_EQ(lost.member.why_lost, "two places are alike");
  }
}

}  // namespace
}  // namespace palace
