// Tracker and navigation results of one frame.
#pragma once

#include <cmath>
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
  std::string mode;      ///< "Plane" or "Template"
  double coherence = 0;  ///< 0..1 against the anchor
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
};

}  // namespace palace
