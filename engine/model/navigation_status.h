// Tracker and navigation results of one frame.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/image.h"
#include "engine/model/vehicle_message.h"

namespace palace {

struct TrackedFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool inlier = true;
};

struct TrackerStatus {
  Timestamp time;
  bool locked = false;
  std::string why_not_locked;  ///< with value and limit; empty while locked, and of no picture yet
  std::string mode;            ///< "Plane" or "Template"
  double coherence = 0;        ///< 0..1 against the anchor
  Eigen::Vector2d site_pixel =
      Eigen::Vector2d::Zero();  ///< where the site is now; may lie outside the picture
  bool site_in_picture = false;
  std::vector<TrackedFeature> features;
  Eigen::Vector2d window_centre =
      Eigen::Vector2d::Zero();  ///< search window of the site's own feature
  double window_side_px = 0;
  int inliers = 0;
  int keyframes = 0;
  std::shared_ptr<const ImageU8> anchor_patch;  ///< all three of one size; null before lock
  std::shared_ptr<const ImageU8> current_patch;
  std::shared_ptr<const ImageU8> difference_patch;  ///< 128 = equal
  double anchor_height_m = 0;  ///< height above the site when the anchor was cut
};

/// State of one position filter.
struct FilterStatus {
  bool running = false;
  PositionEstimate estimate;
  double residual_sigma = 0;  ///< sqrt(innovation' S^-1 innovation / dof) of the last measurement
  double max_residual_sigma = NAN;  ///< beyond it a measurement is refused
  int rejected_in_row = 0;
  /// Since the last measurement that it took: so long the estimate is carried on by inertia alone,
  /// and its sigma grows. NaN: not running.
  double coasting_s = NAN;
  /// Carried on for so long that a figure made of it would mislead: it counts as unknown.
  bool IsUnknown() const { return coasting_s > kUnknownAfter_s; }
  static constexpr double kUnknownAfter_s = 5;
};

/// Stamps of one camera's pictures against those of the attitude, by the motion of both
/// (navigation/image_time.h).
struct ImageTime {
  enum class State : std::uint8_t {
    kNotObservable,  ///< too little turning to tell
    kAgrees,
    kOff,
  };
  State state = State::kNotObservable;
  double offset_s = NAN;  ///< positive: pictures are late
  double sigma_s = NAN;
  static constexpr double kLimit_s = 0.035;  ///< off beyond it

  bool off() const { return state == State::kOff; }
};

/// GPS against its own velocity and the inertial prediction (navigation/gps_watch.h).
struct GpsAgreement {
  bool off = false;
  bool drifts = false;  ///< against its own velocity, rather than stands elsewhere
  double off_m = NAN;   ///< of the newest fix from the prediction; NaN before two fixes
  static constexpr double kJump_m = 1;     ///< off beyond it ...
  static constexpr double kDrift_m = 0.3;  ///< ... or by so much in five seconds
  static constexpr int kFineFixes = 5;     ///< in a row, and it is off no more
};

/// Attitude and accelerometer against GPS velocities (navigation/gravity_watch.h).
struct GravityAgreement {
  bool off = false;
  double tilt_deg = NAN;                     ///< by which they part; NaN: not known now
  static constexpr double kLimit_deg = 1.5;  ///< off beyond it
  static constexpr int kFineFixes = 5;       ///< in a row, and it is off no more
};

/// The laser range finder against motion and stereo (navigation/laser_watch.h).
struct LaserHealth {
  enum class State : std::uint8_t {
    kNever,  ///< no return was ever heard
    kFine,
    kLost,
    kStuck,  ///< the same range while noise or motion should change it
    kWrong,  ///< stepped, and neither motion nor stereo did; or scaled by the same witnesses
  };
  State state = State::kNever;
  double since_s = NAN;  ///< lost, stuck: for so long
  double ratio = NAN;    ///< wrong: range over what it should be
  static constexpr double kLost_s = 0.5;
  static constexpr double kStuck_s = 0.8;
  static constexpr double kWrong = 0.15;  ///< share of the height
  static constexpr double kAgrees = 0.1;  ///< nearer than that to stereo ...
  static constexpr int kFinePairs = 5;    ///< ... so often in a row, and it is wrong no more

  /// Of no use for heights, whatever it reads.
  bool lies() const { return state == State::kStuck || state == State::kWrong; }
};

struct NavigationStatus {
  FilterStatus gps;
  FilterStatus vision;
  bool vision_measured = false;  ///< a raw vision position exists for this frame
  Eigen::Vector3d vision_p_WB = Eigen::Vector3d::Zero();  ///< raw, before the filter
  enum class Handover : std::uint8_t { kGps, kSettling, kReady, kVision };
  Handover handover = Handover::kGps;
  bool OnVision() const { return handover == Handover::kVision; }
  /// The filter whose estimate the vehicle flies on.
  const FilterStatus& InForce() const { return OnVision() ? vision : gps; }
  std::string handover_reason;  ///< what it waits for
  double offset_m = 0;          ///< |vision - GPS| at the switch
  ImageTime image_time_left, image_time_right;
  /// Of the camera that is off by more; null while none is off.
  const ImageTime* WrongImageTime() const {
    const ImageTime &l = image_time_left, &r = image_time_right;
    const bool right = r.off() && !(l.off() && std::abs(l.offset_s) >= std::abs(r.offset_s));
    return right ? &r : l.off() ? &l : nullptr;
  }
  GpsAgreement gps_agreement;
  GravityAgreement gravity;
  LaserHealth laser;
};

}  // namespace palace
