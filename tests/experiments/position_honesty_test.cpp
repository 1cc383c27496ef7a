// Approaches of `evaluate position-estimate` without pictures: the simulator's vehicle, sensors and
// attitudes, and landmarks that are points of the ground where a tracker would see them. So many
// can be flown: do positions err as they are stated to, with each quality of attitude? What
// pictures and keyframes err by is not in them (site_tracker_test.cpp asks that).
#include <cstdio>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/median.h"
#include "engine/core/random.h"
#include "engine/experiments/cone_approach.h"
#include "engine/experiments/position_estimators.h"
#include "engine/tracking/view_geometry.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPixelNoise_px = 0.08, kHeightNoise_m = 0.001;
constexpr int kLandmarks = 400;  // over 12 m, so that some are seen to the end
constexpr double kAround_m = 6;

struct Sums {
  double nees = 0, nees_north = 0, max_m = 0;
  int flights = 0;
};

/// One navigator on one approach. The site is told as `evaluate position-estimate` tells it.
class PointRun {
 public:
  PointRun(AttitudeQuality quality, const VehicleDescription& vehicle, std::uint64_t seed)
      : vehicle_(vehicle), random_(seed, "points") {
    navigator_.SetAttitudeErrors(StatedErrors(quality, vehicle.sensors.attitude));
    navigator_.AllowVision(true);
  }

  void Add(const FrameBundle& bundle, const RigidTransform& X_WB, const Vector3d& p_W_cone,
           bool tell) {
    navigator_.AddSensors(bundle);
    const RigidTransform X_BC = vehicle_.rig.X_BC(), X_WC = X_WB * X_BC;
    const RigidTransform X_WC_told = navigator_.PredictBodyPose(bundle.time) * X_BC;
    const Vector3d cone_C = X_WC.Inverse() * p_W_cone;
    if (!tell || count_ == 0) {
      site_sum_ += X_WC_told * cone_C;
      ++count_;
      return;
    }
    if (marks_.empty()) {
      site_.id = 1;
      site_.p_WS = site_sum_ / count_;
      site_.frames_fused = count_;
      Place(X_WC, X_WC_told, p_W_cone);
      navigator_.StartVision(site_, bundle.time);
    }
    navigator_.AddVision(Track(bundle.time, X_WC), Camera(), vehicle_.rig, bundle, {});
    if (const auto filter = navigator_.VisionFilterAt(bundle.time)) {
      const PositionError error{filter->p_WB - site_.p_WS - (X_WB.p - p_W_cone),
                                filter->p_covariance_m2};
      nees_ += error.NeesPerDof();
      nees_north_ += error.NeesOfAxes().x();
      max_m_ = std::max(max_m_, error.e_m.norm());
      ++judged_;
    }
  }

  void Close(Sums& sums) const {
    ASSERT_GT(judged_, 100);
    sums.nees += nees_ / judged_;
    sums.nees_north += nees_north_ / judged_;
    sums.max_m = std::max(sums.max_m, max_m_);
    ++sums.flights;
  }

 private:
  struct Mark {
    Vector3d true_W, placed_W;
  };
  const PinholeCamera& Camera() const { return vehicle_.rig.left.pinhole; }

  /// By ranges and the told pose, from the height above the site that ranges measure.
  void Place(const RigidTransform& X_WC, const RigidTransform& X_WC_told,
             const Vector3d& p_W_cone) {
    Vector3d from_W = X_WC_told.p;
    const Vector3d cone_W = X_WC_told * (X_WC.Inverse() * p_W_cone);
    from_W.z() += site_.p_WS.z() - cone_W.z() + kHeightNoise_m * random_.Normal();
    while (static_cast<int>(marks_.size()) < kLandmarks) {
      const Vector3d aside(random_.Uniform(-kAround_m, kAround_m),
                           random_.Uniform(-kAround_m, kAround_m), 0);
      const Vector3d p_W = p_W_cone + aside / (1 + marks_.size() % 4);
      marks_.push_back({p_W, from_W + X_WC_told.R * X_WC.R.transpose() * (p_W - X_WC.p)});
    }
  }

  TrackResult Track(Timestamp time, const RigidTransform& X_WC) {
    TrackResult track;
    track.time = time;
    track.status.locked = true;
    track.status.coherence = 1;
    for (const Mark& mark : marks_) {
      const auto pixel = PixelFromWorldPoint(Camera(), X_WC, mark.true_W);
      const Vector2d noise_px(kPixelNoise_px * random_.Normal(), kPixelNoise_px * random_.Normal());
      if (pixel && InPicture(Camera(), *pixel, 8) && track.landmarks.size() < 120) {
        track.landmarks.push_back({mark.placed_W, *pixel + noise_px, 0.3, 0.04});
      }
    }
    return track;
  }

  const VehicleDescription& vehicle_;
  RandomStream random_;
  Navigator navigator_;
  LandingSite site_;
  Vector3d site_sum_ = Vector3d::Zero();
  int count_ = 0, judged_ = 0;
  std::vector<Mark> marks_;
  double nees_ = 0, nees_north_ = 0, max_m_ = 0;
};

void Fly(std::uint64_t seed, Sums (&sums)[3]) {
  const VehicleDescription& vehicle = DefaultVehicle();
  Result<ConeApproach> approach =
      ConeApproach::Make({.vehicle = vehicle, .seed = seed, .render = false}, nullptr);
  ASSERT_TRUE(approach) << approach.error().message;
  std::vector<AttitudeOf> attitudes;
  std::vector<std::unique_ptr<PointRun>> runs;
  for (const AttitudeQuality quality : kAttitudeQualities) {
    attitudes.emplace_back(quality, seed);
    runs.push_back(std::make_unique<PointRun>(quality, vehicle, seed));
  }
  while (true) {
    const auto next = approach->Next();
    ASSERT_TRUE(next) << next.error().message;
    if (!*next) {
      break;
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs[i]->Add(*attitudes[i].Told((*next)->bundle, *approach), (*next)->X_WB,
                   approach->p_W_cone(), (*next)->approved);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i]->Close(sums[i]);
  }
}

TEST(PositionHonesty, VisionErrsAsItStatesWithEachQualityOfAttitude) {
  constexpr std::uint64_t kFirst = 8100;
  constexpr int kFlights = 24;
  Sums sums[3];
  for (int i = 0; i < kFlights; ++i) {
    Fly(kFirst + static_cast<std::uint64_t>(i), sums);
  }
  const double most_m[] = {0.06, 0.17, 0.30};
  for (const AttitudeQuality quality : kAttitudeQualities) {
    const Sums& sum = sums[static_cast<std::size_t>(quality)];
    ASSERT_EQ(sum.flights, kFlights);
    const double nees = sum.nees / kFlights, north = sum.nees_north / kFlights;
    std::printf("[ measured ] attitude %s, %d flights: NEES/dof %.2f, north %.2f; at most %.3f m\n",
                NameOf(quality), kFlights, nees, north, sum.max_m);
    EXPECT_GT(nees, 0.6) << NameOf(quality);
    EXPECT_LT(nees, 1.4) << NameOf(quality);
    EXPECT_LT(north, 1.7) << NameOf(quality);
    EXPECT_LT(sum.max_m, most_m[static_cast<std::size_t>(quality)]) << NameOf(quality);
  }
}

}  // namespace
}  // namespace palace
