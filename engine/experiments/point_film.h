// PointFilm: a flight over level ground towards one point of it, drawn picture by picture, with the
// point's true pixel in each. What the experiments on trackers share.
//
//   descent: from 45.7 m (150 ft) to 4 m down a slope of 45 degrees towards the point, 240 pictures
//            at 30 Hz: everything becomes 11.4 times as large
//   hover:   the same attitude motion at 15.24 m (50 ft)
//
// The camera looks 45 degrees down and is 45 degrees wide, 640 x 480 pixels. Attitude moves by sums
// of sines of 0.5 to 1.2 Hz, so that the point moves by `motion_px` a picture in the mean. The
// point is the one that the station's own selection calls best to follow (template_selection.h)
// among some pixels about the middle of the slope's end; where it refuses all, that end itself.
//
// What the vehicle believes differs from the truth: its position drifts against the first picture
// by some 0.5 m, its attitude by 0.1 degrees, and the point's range is known to 0.5 % (1 sigma).
// Same options and seed: same bits.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/experiments/ground_pyramid.h"
#include "engine/model/image.h"
#include "engine/model/rig.h"

namespace palace {

inline constexpr int kFilmPictures = 240;
inline constexpr double kFilmRate_hz = 30;
inline constexpr double kFilmNoise_grey = 2.5;

enum class FilmFlight : std::uint8_t { kDescent, kHover };
/// "descent", "hover".
const char* NameOf(FilmFlight flight);

struct FilmOptions {
  FilmFlight flight = FilmFlight::kDescent;
  double start_m = 45.72;  ///< height of the camera; a hover stays at 15.24 m
  double end_m = 4;
  int pictures = kFilmPictures;
  int width_px = 640;
  int height_px = 480;
};

class PointFilm {
 public:
  /// `ground` must outlive the film.
  PointFilm(const GroundPyramid& ground, const FilmOptions& options, std::uint64_t seed);

  int pictures() const { return static_cast<int>(X_WCs_.size()); }
  const PinholeCamera& camera() const { return camera_; }
  double motion_px() const { return motion_px_; }
  /// Nothing was fit to be followed; the point is where the slope ends.
  bool selection_refused() const { return selection_refused_; }

  /// Without noise.
  ImageF Grey(int picture) const;
  /// Of the sensor, the same for one picture whatever is painted into it.
  ImageF Noise(int picture) const;
  /// The point's pixel.
  Eigen::Vector2d Truth(int picture) const;
  /// Pose as the vehicle believes it.
  const RigidTransform& Believed(int picture) const;
  /// The point where the believed pose of the first picture and its range put it.
  const Eigen::Vector3d& believed_point() const { return believed_p_WP_; }

 private:
  const GroundPyramid& ground_;
  PinholeCamera camera_;
  std::uint64_t seed_;
  Eigen::Vector3d p_WP_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d believed_p_WP_ = Eigen::Vector3d::Zero();
  std::vector<RigidTransform> X_WCs_;
  std::vector<RigidTransform> believed_X_WCs_;
  double motion_px_ = 0;
  bool selection_refused_ = false;
};

/// Levels 0..255 of a picture with its noise.
ImageU8 Exposed(const ImageF& grey, const ImageF& noise);

}  // namespace palace
