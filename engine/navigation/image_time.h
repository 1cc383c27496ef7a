// Image time against attitude time: do the pictures move when the vehicle turns?
//
// Of two pictures d apart in time the middle moves by what the camera turned and travelled:
//
//   shift = f * integral over [t0 + s, t1 + s] of (-w_y, w_x) - k(t) / Z (v_x, v_y) dt
//
// with rates and velocity in C, Z the depth at the middle. Over the pictures of the last 2.2 s, and
// of the last 1.4 s for what has just begun, the s is sought at which this agrees best, each axis
// less a straight line (slow errors of v, Z and the gyro). The picture moves by the depth of all
// that it shows, not of its middle: k(t) = 1 + a + b t' (t' from -1 to 1 over the window) is found
// with s, a and b each 0 to within 0.3. Stamps that are right need s = 0;
// pictures that show the past need s < 0. Slow motion fits many an s by chance: the pairs must span
// 0.95 s, and an |s| over 0.2 s leave a quarter of what s = 0 leaves. Told is
//
//   offset = -s,   positive: pictures are late,   sigma = scatter / sqrt(n) over the slope by s
//
// Only turning that changes tells time: in calm air, or in a steady turn, nothing can be observed
// and nothing is said. Behind gusts of three sines an axis (0.2 to 1.1 Hz, each of 0.4 to 1 times a
// strength) an offset of 50 ms is told within 2 s in all of 200 runs at 3 deg/s, 98 % at 2, 85 % at
// 1, 23 % at 0.5 (tests/navigation/image_time_test.cpp). A fault is told after three pictures in a
// row that say so, and stands until five in a row say that times agree: without motion it is not
// over. Source: the fault of Ingenuity's sixth flight (NASA status, 27 May 2021).
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/model/navigation_status.h"
#include "engine/model/vehicle_state.h"

namespace palace {

/// How one camera's picture moved.
struct MotionSample {
  Timestamp from, to;
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
};

/// The motion that a pose predicts, per second: pixels at the middle of the picture.
struct MotionRate {
  Timestamp time;
  Eigen::Vector2d turn_px_per_s = Eigen::Vector2d::Zero();
  Eigen::Vector2d travel_px_per_s = Eigen::Vector2d::Zero();
};
/// `depth_m` along the axis, NaN: unknown, then travel is left out. `focal_px` of square pixels.
MotionRate PredictMotion(const VehiclePose& pose, const RigidTransform& X_BC, double focal_px,
                         double depth_m);

/// One camera. Any one thread, no clock.
class ImageTimeMonitor {
 public:
  /// In order of time; older ones are ignored.
  void AddRate(const MotionRate& rate);
  /// After the rates that came with the picture.
  void AddMotion(const MotionSample& motion);
  const ImageTime& status() const { return status_; }
  void Reset() { *this = ImageTimeMonitor(); }

  static constexpr double kLimit_s = 0.035;  ///< offsets beyond it are a fault
  static constexpr double kMostSearched_s = 0.6;

 private:
  struct Fit {
    double residual2_px2 = 0;  ///< mean
    int count = 0;
  };
  /// A column each: by turning, by travelling.
  using Motion = Eigen::Matrix2d;
  struct RatePoint {
    Timestamp time;
    Motion px_per_s, moved_px;
  };
  Motion MovedAt(double time_s) const;
  Motion MovedBetween(double from_s, double to_s) const;
  /// What one window of time says.
  struct Verdict {
    ImageTime::State state = ImageTime::State::kNotObservable;
    double offset_s = std::numeric_limits<double>::quiet_NaN();
    double sigma_s = std::numeric_limits<double>::quiet_NaN();
  };
  /// Over the pictures that rates are known for at both; two fits are compared over the same ones.
  std::optional<Fit> FitAt(double shift_s, double beside_s) const;
  std::optional<Fit> BestFit(double& shift_s) const;
  /// Mean square of what the two predictions differ by, lines removed.
  double DifferenceOf(double shift_a_s, double shift_b_s) const;
  Verdict JudgeWindow(double window_s);
  void Tell(const Verdict& verdict);

  std::size_t first_ = 0;  ///< motion of the window that is judged
  std::deque<RatePoint> rates_;
  std::deque<MotionSample> motions_;
  ImageTime status_;
  int off_run_ = 0, agrees_run_ = 0;
};

}  // namespace palace
