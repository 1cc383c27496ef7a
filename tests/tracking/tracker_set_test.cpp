// Several trackers side by side through what comes between camera and ground: each says that it is
// LOST, its sigma grows, it is re-acquired within 5 px; the thesis's template drifts beside them
// and is named. Pictures are rendered of a plane; on relief and with real lenses they cannot show
// it.
#include "engine/tracking/tracker_set.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

const PinholeCamera kCamera{640, 480, 772.548, 772.548, 319.5, 239.5};
constexpr int kSecond = 30;             // pictures
constexpr int kFrom = 3 * kSecond / 2;  // when something comes between
constexpr int kPictures = 4 * kSecond;
constexpr Timestamp At(int i) { return {33'333 * i}; }

/// Down a slope of 45 degrees, 15 m to 3 m, with the turning of a hovering helicopter.
RigidTransform CameraAt(int i) {
  const double t = i / 30.0, height_m = 15 - 12.0 * i / (kPictures - 1);
  RigidTransform X_WC;
  X_WC.R = RotationFromEuler({Rad(1.5 * std::sin(1.9 * t)), Rad(1.2 * std::sin(2.3 * t + 1)),
                              Rad(2 * std::sin(0.7 * t))}) *
           CameraRotationFromTilt(Rad(-45));
  X_WC.p = {-height_m, 0.05 * std::sin(1.3 * t), -height_m};
  return X_WC;
}

/// A position that drifts like GPS, an attitude that is a tenth of a degree off.
RigidTransform Predicted(const RigidTransform& X_WC, int i) {
  const double t = i / 30.0;
  RigidTransform predicted = X_WC;
  predicted.p +=
      Eigen::Vector3d(0.5 * std::sin(0.3 * t), -0.4 * std::sin(0.23 * t), 0.3 * std::sin(0.2 * t));
  predicted.R = RotationFromEuler({Rad(0.1 * std::sin(0.5 * t)), Rad(0.1 * std::sin(0.4 * t)),
                                   Rad(0.1 * std::sin(0.31 * t))}) *
                predicted.R;
  return predicted;
}

/// What lies between camera and ground in picture i, where the site is seen at `site`.
using Between = std::function<void(ImageU8&, int, const Eigen::Vector2d& site)>;

void Nothing(ImageU8&, int, const Eigen::Vector2d&) {}

void PaintDisc(ImageU8& picture, const Eigen::Vector2d& centre, double radius) {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if ((Eigen::Vector2d(x, y) - centre).norm() < radius) {
        picture.at(x, y) = static_cast<std::uint8_t>(25 + (x * 7 + y * 13) % 9);
      }
    }
  }
}

/// Crosses the site within a second.
void Bird(ImageU8& picture, int i, const Eigen::Vector2d& site) {
  if (i >= kFrom && i < kFrom + kSecond) {
    PaintDisc(picture, site + Eigen::Vector2d(-260 + 18 * (i - kFrom), 0), 70);
  }
}

/// Out of focus, comes in from the left, covers all, and goes, in a second.
void Hand(ImageU8& picture, int i, const Eigen::Vector2d&) {
  const int into = i - kFrom, left = kFrom + kSecond - i;
  RandomStream noise(11, "hand");
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width() && x < 130 * std::min(into, left); ++x) {
      const double shade = 95 + 40 * std::sin(x / 150.0 + 1) * std::cos(y / 190.0);
      picture.at(x, y) = static_cast<std::uint8_t>(shade + 2 * noise.Normal());
    }
  }
}

/// A band of less than half the light passes in a second.
void Shadow(ImageU8& picture, int i, const Eigen::Vector2d& site) {
  for (int y = 0; y < picture.height() && i >= kFrom && i < kFrom + kSecond; ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (std::abs(x - (site.x() - 300 + 20 * (i - kFrom))) < 110) {
        picture.at(x, y) = static_cast<std::uint8_t>(0.45 * picture.at(x, y));
      }
    }
  }
}

void Black(ImageU8& picture, int i, const Eigen::Vector2d&) {
  if (i >= kFrom && i < kFrom + kSecond / 2) {
    picture = ImageU8(picture.width(), picture.height());
  }
}

struct Flight {
  std::vector<TrackerSetStatus> told;
  std::vector<Eigen::Vector2d> truth;
  double ms_a_picture = 0;

  const TrackerMember* Find(int i, const std::string& name) const {
    for (const TrackerMember& member : told[static_cast<std::size_t>(i)].members) {
      if (member.name == name) {
        return &member;
      }
    }
    return nullptr;
  }
  double Error(int i, const Eigen::Vector2d& pixel) const {
    return (pixel - truth[static_cast<std::size_t>(i)]).norm();
  }
  void Print(const char* what) const {
    std::map<std::string, std::array<double, 3>> members;  // lost, worst error, error at the end
    for (int i = 0; i < static_cast<int>(told.size()); ++i) {
      for (const TrackerMember& member : told[static_cast<std::size_t>(i)].members) {
        auto& [lost, worst, last] = members[member.name];
        last = Error(i, member.site_pixel);
        lost += member.followed() ? 0 : 1;
        worst = member.followed() ? std::max(worst, last) : worst;
      }
    }
    std::printf("%s: %.2f ms of processor a picture\n", what, ms_a_picture);
    for (const auto& [name, row] : members) {
      std::printf("  %-10s LOST in %3.0f pictures, worst error %6.2f px, last %6.2f px\n",
                  name.c_str(), row[0], row[1], row[2]);
    }
  }
};

Flight Fly(const Between& between, std::uint64_t seed, const TrackingSettings& settings = {}) {
  GroundWorld world(seed);
  SiteTracker tracker;
  Flight flight;
  std::clock_t spent = 0;
  for (int i = 0; i < kPictures; ++i) {
    const RigidTransform X_WC = CameraAt(i), predicted = Predicted(X_WC, i);
    flight.truth.push_back(*PixelFromWorldPoint(kCamera, X_WC, Eigen::Vector3d::Zero()));
    ImageU8 picture = world.Render(kCamera, X_WC, 2.5F);
    between(picture, i, flight.truth.back());
    const std::clock_t start = std::clock();
    if (i == 0) {
      LandingSite site;
      site.p_WS.setZero();
      tracker.Lock(picture, kCamera, X_WC, nullptr, site, settings, At(i));
    }
    flight.told.push_back(tracker.Track(picture, kCamera, predicted, nullptr, settings, At(i)).set);
    spent += std::clock() - start;
  }
  flight.ms_a_picture = 1e3 * static_cast<double>(spent) / CLOCKS_PER_SEC / kPictures;
  return flight;
}

class TrackerSetTest : public testing::Test {
 protected:
  void SetUp() override { cv::setNumThreads(1); }

  /// Plane and features whenever they are followed, and the consensus whenever it is trusted.
  static void ExpectNear(const Flight& flight, double limit_px) {
    for (int i = 0; i < kPictures; ++i) {
      const TrackerSetStatus& told = flight.told[static_cast<std::size_t>(i)];
      for (const TrackerMember& member : told.members) {
        if (member.kind != TrackerMember::Kind::kTemplate && member.followed()) {
          EXPECT_LT(flight.Error(i, member.site_pixel), limit_px) << i << " " << member.name;
          EXPECT_FALSE(member.drifts) << i << " " << member.name;
        }
      }
      if (told.consensus.trusted) {
        EXPECT_LT(flight.Error(i, told.consensus.site_pixel), limit_px) << i;
      }
    }
  }
  /// Each is LOST within `pictures` of the beginning of what covers all, with growing sigma.
  static void ExpectLost(const Flight& flight, int pictures, int until) {
    for (const char* name : {"Plane", "Template", "Feature 1", "Feature 2", "Feature 3"}) {
      double sigma_px = 0;
      for (int i = kFrom + pictures; i < until; ++i) {
        const TrackerMember* member = flight.Find(i, name);
        ASSERT_NE(member, nullptr) << name;
        EXPECT_EQ(member->state, FollowState::kLost) << i << " " << name;
        EXPECT_NE(member->why_lost, "") << i << " " << name;
        EXPECT_EQ(member->weight, 0) << i << " " << name;
        EXPECT_GT(member->sigma_px, sigma_px) << i << " " << name;
        // What the position and attitude of the prediction err by since then.
        EXPECT_LT(flight.Error(i, member->site_pixel), 5 + 3 * member->sigma_px) << i << name;
        sigma_px = member->sigma_px;
      }
    }
  }
};

TEST_F(TrackerSetTest, HoldsTheSiteTogetherAndNamesTheTemplateThatDrifts) {
  bool named = false;
  for (const std::uint64_t seed : {1, 2}) {
    const Flight flight = Fly(Nothing, seed);
    flight.Print("clear");
    ExpectNear(flight, 3);
    for (int i = 0; i < kPictures; ++i) {
      const TrackerSetStatus& told = flight.told[static_cast<std::size_t>(i)];
      EXPECT_TRUE(told.consensus.trusted) << i << " " << told.consensus.why_not_trusted;
      double weights = 0;
      for (const TrackerMember& member : told.members) {
        weights += member.weight;
      }
      EXPECT_NEAR(weights, 1, 1e-9);
      const TrackerMember* thesis = flight.Find(i, "Template");
      const double off_px = flight.Error(i, thesis->site_pixel);
      if (thesis->drifts) {
        named = true;
        EXPECT_GT(off_px, 3) << i;
        EXPECT_GT(thesis->own_score, 0.9) << "successive pictures see no drift";
        EXPECT_EQ(thesis->weight, 0);
        EXPECT_EQ(told.disagreement.rfind("Template ", 0), 0U) << told.disagreement;
      }
    }
  }
  EXPECT_TRUE(named);
}

TEST_F(TrackerSetTest, AHandForASecondIsToldByAllAndAllAreTakenUpAgain) {
  for (const std::uint64_t seed : {1, 2}) {
    const Flight flight = Fly(Hand, seed);
    flight.Print("hand for a second");
    ExpectNear(flight, 5);
    ExpectLost(flight, 5, kFrom + kSecond - 4);
    for (int i = kFrom + kSecond + 4; i < kPictures; ++i) {
      EXPECT_TRUE(flight.told[static_cast<std::size_t>(i)].consensus.trusted) << seed << " " << i;
    }
    EXPECT_TRUE(flight.Find(kFrom + kSecond + 4, "Plane")->followed());
  }
}

TEST_F(TrackerSetTest, HalfASecondOfBlackIsToldAtOnce) {
  for (const std::uint64_t seed : {1, 2}) {
    const Flight flight = Fly(Black, seed);
    flight.Print("black for half a second");
    ExpectNear(flight, 5);
    ExpectLost(flight, 0, kFrom + kSecond / 2);
    EXPECT_EQ(flight.told[kFrom].consensus.why_not_trusted, "no tracker holds the ground");
    const int after = kFrom + kSecond / 2;
    EXPECT_EQ(flight.Find(after, "Plane")->state, FollowState::kReacquired);
    EXPECT_TRUE(flight.told[after + 2].consensus.trusted);
  }
}

TEST_F(TrackerSetTest, ABirdAndAShadowMoveNoFeature) {
  for (const std::uint64_t seed : {1, 2}) {
    for (const auto& [name, between] : {std::pair<const char*, Between>{"bird", Bird},
                                        std::pair<const char*, Between>{"shadow", Shadow}}) {
      const Flight flight = Fly(between, seed);
      flight.Print(name);
      ExpectNear(flight, 5);
      int lost = 0;
      for (int i = kFrom; i < kFrom + kSecond; ++i) {
        for (const TrackerMember& member : flight.told[static_cast<std::size_t>(i)].members) {
          lost += member.followed() ? 0 : 1;
        }
      }
      EXPECT_GT(lost, 0) << name << " " << seed;
      EXPECT_TRUE(flight.told.back().consensus.trusted) << name << " " << seed;
    }
  }
}

// The pipeline knows that a picture is none of now (a frozen camera) before any tracker looks.
TEST_F(TrackerSetTest, WithoutAPictureAllAreLostForThatReason) {
  GroundWorld world(4);
  SiteTracker tracker;
  EXPECT_TRUE(tracker.Coast(kCamera, CameraAt(0), {}, "why", At(0)).members.empty());
  LandingSite site;
  for (int i = 0; i < 5; ++i) {
    const ImageU8 picture = world.Render(kCamera, CameraAt(i), 2);
    if (i == 0) {
      tracker.Lock(picture, kCamera, CameraAt(i), nullptr, site, {}, At(i));
    }
    tracker.Track(picture, kCamera, CameraAt(i), nullptr, {}, At(i));
  }
  const auto truth = PixelFromWorldPoint(kCamera, CameraAt(8), Eigen::Vector3d::Zero());
  const TrackerSetStatus told =
      tracker.Coast(kCamera, CameraAt(8), {}, "the camera repeats its picture", At(8));
  ASSERT_GE(told.members.size(), 4U);
  for (const TrackerMember& member : told.members) {
    EXPECT_EQ(member.state, FollowState::kLost) << member.name;
    EXPECT_EQ(member.why_lost, "the camera repeats its picture");
    EXPECT_NEAR(member.lost_s, 4 * 0.033333, 1e-9);
    EXPECT_LT((member.site_pixel - *truth).norm(), 2) << "carried on by the prediction";
  }
  EXPECT_FALSE(told.consensus.trusted);
  EXPECT_LT((told.consensus.site_pixel - *truth).norm(), 2);
}

/// The ranges that a camera has of the level ground.
RangeMap RangesOfGround(const RigidTransform& X_WC) {
  RangeMap range;
  range.camera = kCamera;
  range.depth_m = ImageF(kCamera.width, kCamera.height);
  range.depth_sigma_m = ImageF(kCamera.width, kCamera.height, 0.05F);
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) {
      range.depth_m.at(x, y) =
          static_cast<float>(PlaneDepth(kCamera, X_WC, {}, Eigen::Vector2d(x, y)).value_or(NAN));
    }
  }
  return range;
}

// The site's place is of a map that was made before the height drifted by 0.3 m; the ranges of now
// tell. Six pixels at 21 m: whoever had begun without them would be told to drift for good.
TEST_F(TrackerSetTest, AllBeginWhereTheRangesSayThatTheSiteIs) {
  for (const double drift_m : {0.3, -0.3, 1.0}) {
    GroundWorld world(7);
    SiteTracker tracker;
    for (int i = 0; i < 8; ++i) {
      const RigidTransform X_WC = CameraAt(i);
      RigidTransform drifted = X_WC;
      drifted.p.z() += drift_m;
      const ImageU8 picture = world.Render(kCamera, X_WC, 2);
      const RangeMap range = RangesOfGround(X_WC);
      if (i == 0) {
        tracker.Lock(picture, kCamera, drifted, &range, LandingSite{}, {}, At(i));
      }
      const TrackerSetStatus told = tracker.Track(picture, kCamera, drifted, &range, {}, At(i)).set;
      const auto truth = PixelFromWorldPoint(kCamera, X_WC, Eigen::Vector3d::Zero());
      ASSERT_GE(told.members.size(), 5U);
      for (const TrackerMember& member : told.members) {
        EXPECT_LT((member.site_pixel - *truth).norm(), 1.5) << i << " " << member.name;
        EXPECT_FALSE(member.drifts) << i << " " << member.name;
      }
      EXPECT_LT((told.consensus.site_pixel - *truth).norm(), 1) << i;
    }
  }
}

// A vehicle beside the site has the strongest corners, but stands off the plane.
TEST_F(TrackerSetTest, NoFeatureIsChosenOffTheLandingPlane) {
  GroundWorld world(6);
  const RigidTransform X_WC = CameraAt(0);
  const ImageU8 picture = world.Render(kCamera, X_WC, 2);
  RangeMap range = RangesOfGround(X_WC);
  const auto stands = [](const Eigen::Vector2d& pixel) { return pixel.x() > 310; };
  for (int y = 241; y < 480; ++y) {
    for (int x = 311; x < 640; ++x) {
      range.depth_m.at(x, y) -= 2;
    }
  }
  LandingSite site;
  SiteTracker tracker;
  tracker.Lock(picture, kCamera, X_WC, &range, site, {}, At(0));
  int features = 0;
  for (const TrackerMember& member :
       tracker.Track(picture, kCamera, X_WC, &range, {}, At(1)).set.members) {
    if (member.kind == TrackerMember::Kind::kFeature) {
      ++features;
      EXPECT_FALSE(stands(member.pixel) && member.pixel.y() > 241) << member.pixel.transpose();
    }
  }
  EXPECT_GE(features, 2);
}

TEST_F(TrackerSetTest, WhoIsInForceIsToldAndTheOthersRunBesideIt) {
  for (const TrackerMode mode : {TrackerMode::kPlane, TrackerMode::kTemplate}) {
    GroundWorld world(5);
    TrackingSettings settings;
    settings.mode = mode;
    SiteTracker tracker;
    const ImageU8 picture = world.Render(kCamera, CameraAt(0), 2);
    tracker.Lock(picture, kCamera, CameraAt(0), nullptr, LandingSite{}, settings, At(0));
    const TrackResult result =
        tracker.Track(picture, kCamera, CameraAt(0), nullptr, settings, At(1));
    ASSERT_GE(result.set.members.size(), 5U);
    EXPECT_EQ(result.set.members[0].in_force, mode == TrackerMode::kPlane);
    EXPECT_EQ(result.set.members[1].in_force, mode == TrackerMode::kTemplate);
    EXPECT_EQ(result.set.members[0].name, "Plane");
    EXPECT_EQ(result.set.members[1].name, "Template");
    EXPECT_EQ(result.status.mode, mode == TrackerMode::kPlane ? "Plane" : "Template");
    for (const TrackerMember& member : result.set.members) {
      EXPECT_TRUE(member.followed()) << member.name;
      EXPECT_LT(member.disagreement_px, 1) << member.name;
    }
  }
}

}  // namespace
}  // namespace palace
